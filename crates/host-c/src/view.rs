//! The plan in C's words.

use sensedsl_diagnostics::visible;
use sensedsl_job::host::{BoardPlan, HostPlan, MessagePlan, Names, Scaling};
use sensedsl_wire::{Checksum, Direction, ScalarType};

use crate::names::{Prefixes, comment, literal};

/// A design.
pub(super) struct DesignView {
    pub(super) boards: Vec<BoardView>,
}

/// A board.
pub(super) struct BoardView {
    /// What stands before all its names.
    pub(super) own: String,
    /// In capitals, for the guard of the header.
    pub(super) guard: String,
    /// Where it comes from, for comments.
    pub(super) title: String,
    pub(super) name: String,
    pub(super) hash: String,
    pub(super) checksum: &'static str,
    pub(super) has_stamp: bool,
    pub(super) baud: u32,
    pub(super) silence_ms: u32,
    pub(super) short_bytes: usize,
    /// Of the longest frame from the board.
    pub(super) held_bytes: usize,
    /// Of the memory for a frame to it.
    pub(super) frame_bytes: usize,
    /// Of the longest value.
    pub(super) value_bytes: usize,
    /// The devices, in the design's order.
    pub(super) devices: Vec<DeviceView>,
}

/// A device.
pub(super) struct DeviceView {
    pub(super) ident: String,
    /// What it is, for a comment.
    pub(super) doc: String,
    pub(super) is_sensor: bool,
    pub(super) id: u8,
    pub(super) c_type: &'static str,
    /// Its value as a parameter, as an object, and as the pointer to it.
    pub(super) parameter: String,
    pub(super) object: String,
    pub(super) pointer: &'static str,
    /// The points of its curve; none for no curve.
    pub(super) curve: Vec<String>,
    /// The members of its row in the table.
    pub(super) row: String,
    /// The pointer to its row.
    pub(super) place: usize,
    pub(super) table_type: String,
}

impl DesignView {
    pub(super) fn new(plan: &HostPlan) -> Self {
        let mut prefixes = Prefixes::new(&plan.name);
        let view = |board| BoardView::new(&plan.name, board, &mut prefixes);
        Self { boards: plan.boards.iter().map(view).collect() }
    }

    /// The first board, and its first sensor, for examples.
    pub(super) fn sensor(&self) -> Option<(&BoardView, &DeviceView)> {
        self.boards.iter().find_map(|board| Some((board, board.sensors().next()?)))
    }

    /// The first board, and its first actuator, for examples.
    pub(super) fn actuator(&self) -> Option<(&BoardView, &DeviceView)> {
        self.boards.iter().find_map(|board| Some((board, board.actuators().next()?)))
    }
}

impl BoardView {
    fn new(design: &str, plan: &BoardPlan, prefixes: &mut Prefixes) -> Self {
        let own = prefixes.take(&plan.name);
        let mut names = Names::default();
        let devices = plan.devices.iter().filter_map(|device| {
            let is_it =
                |one: &&MessagePlan| (one.id, one.direction) == (device.id, device.direction);
            Some((plan.messages().find(is_it)?, names.take(&device.name)))
        });
        let devices = devices.enumerate();
        let devices = devices.map(|(place, (one, ident))| DeviceView::new(&own, place, one, ident));
        let frame_bytes =
            |payload_bytes: usize| payload_bytes.to_string().len() + 2 + payload_bytes;
        let longest = plan.messages().map(|one| one.value.size_bytes()).max();
        Self {
            devices: devices.collect(),
            guard: own.to_ascii_uppercase(),
            title: comment(&format!("the board {} of the design {design}", plan.name)),
            name: literal(&plan.name),
            hash: format!("0x{:08x}", plan.hash),
            checksum: match plan.checksum {
                Checksum::None => "SENSEDSL_NONE",
                Checksum::Crc16 => "SENSEDSL_CRC16",
                Checksum::Crc32 => "SENSEDSL_CRC32",
            },
            has_stamp: plan.has_stamp,
            baud: plan.baud,
            silence_ms: plan.silence_ms.unwrap_or(0),
            short_bytes: plan.sensors.short_bytes_max,
            held_bytes: frame_bytes(plan.sensors.payload_bytes_max),
            frame_bytes: plan.actuators.payload_bytes_max,
            value_bytes: longest.unwrap_or(1),
            own,
        }
    }

    pub(super) fn sensors(&self) -> impl Iterator<Item = &DeviceView> {
        self.devices.iter().filter(|device| device.is_sensor)
    }

    pub(super) fn actuators(&self) -> impl Iterator<Item = &DeviceView> {
        self.devices.iter().filter(|device| !device.is_sensor)
    }
}

impl DeviceView {
    fn new(own: &str, place: usize, plan: &MessagePlan, ident: String) -> Self {
        let (word, c_type) = words(plan.value.scalar);
        let count = plan.value.length;
        let is_sensor = plan.direction == Direction::Sensor;
        let label = plan.label.as_deref().map_or(String::new(), |label| format!("{label}; "));
        let unit =
            plan.quantity.as_ref().map_or(String::new(), |unit| format!(", shown in {unit}"));
        let (parameter, object, pointer) = match count {
            None => (format!("{c_type} raw"), "raw".to_owned(), "&raw"),
            Some(count) => (format!("const {c_type} raw[{count}]"), format!("raw[{count}]"), "raw"),
        };
        let scaling = plan.scaling.as_ref().filter(|one| **one != Scaling::default());
        let scaling = scaling.filter(|_| plan.value.scalar != ScalarType::Bool);
        let curve = scaling.map_or(&[][..], |scaling| &scaling.curve);
        let points = curve.iter().map(|(x, y)| format!("{{{}, {}}}", real(*x), real(*y)));
        let limit = |limit: Option<f64>| real(limit.unwrap_or(0.0));
        let row = [
            plan.id.to_string(),
            is_sensor.to_string(),
            count.is_some().to_string(),
            format!("SENSEDSL_{word}"),
            count.unwrap_or(1).to_string(),
            curve.len().to_string(),
            if curve.is_empty() { "NULL".to_owned() } else { format!("{own}_curve_{ident}") },
            literal(&plan.name),
            literal(&visible(plan.quantity.as_deref().unwrap_or_default())),
            scaling.is_some().to_string(),
            plan.limits.min.is_some().to_string(),
            plan.limits.max.is_some().to_string(),
            real(scaling.map_or(1.0, |scaling| scaling.scale)),
            real(scaling.map_or(0.0, |scaling| scaling.offset)),
            limit(plan.limits.min),
            limit(plan.limits.max),
            plan.cycle_ms.unwrap_or(0).to_string(),
        ];
        Self {
            doc: comment(&visible(&format!("{label}{}{unit}", plan.value))),
            is_sensor,
            id: plan.id,
            c_type,
            parameter,
            object,
            pointer,
            curve: points.collect(),
            row: row.join(", "),
            place,
            table_type: plan.value.to_string(),
            ident,
        }
    }
}

/// The type in the runtime's words and in C's.
fn words(scalar: ScalarType) -> (&'static str, &'static str) {
    match scalar {
        ScalarType::Bool => ("BOOL", "bool"),
        ScalarType::Uint8 => ("UINT8", "uint8_t"),
        ScalarType::Int8 => ("INT8", "int8_t"),
        ScalarType::Uint16 => ("UINT16", "uint16_t"),
        ScalarType::Int16 => ("INT16", "int16_t"),
        ScalarType::Uint32 => ("UINT32", "uint32_t"),
        ScalarType::Int32 => ("INT32", "int32_t"),
        ScalarType::Uint64 => ("UINT64", "uint64_t"),
        ScalarType::Int64 => ("INT64", "int64_t"),
        ScalarType::Float32 => ("FLOAT32", "float"),
        ScalarType::Float64 => ("FLOAT64", "double"),
    }
}

/// A finite number as a constant of the runtime's type for shown values.
fn real(number: f64) -> String {
    format!("(sensedsl_real){number:?}")
}
