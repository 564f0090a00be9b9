//! The plan in Rust's words.

use sensedsl_diagnostics::visible;
use sensedsl_job::host::{BoardPlan, HostPlan, MessagePlan, Names, Scaling};
use sensedsl_wire::{Checksum, Direction, ScalarType};

use crate::names::{literal, names, package};

/// A design.
pub(super) struct DesignView {
    /// The design's name as a literal.
    pub(super) name: String,
    /// The name of the package.
    pub(super) package: String,
    /// The name of the crate in programs.
    pub(super) krate: String,
    pub(super) boards: Vec<BoardView>,
}

/// A board.
pub(super) struct BoardView {
    pub(super) ident: String,
    /// The enumeration of its messages.
    pub(super) any: String,
    pub(super) name: String,
    /// The schema's text as an expression, a literal a line.
    pub(super) text: String,
    pub(super) hash: String,
    pub(super) checksum: &'static str,
    pub(super) has_stamp: bool,
    pub(super) baud: u32,
    pub(super) silence_ms: String,
    pub(super) messages: Vec<MessageView>,
    /// The items, in the design's order.
    pub(super) items: Vec<String>,
}

/// A message.
pub(super) struct MessageView {
    pub(super) ident: String,
    /// What it is, as a literal.
    pub(super) doc: String,
    pub(super) raw_type: String,
    pub(super) value_type: String,
    /// Whether values are `shown` or `plain`.
    pub(super) mode: &'static str,
    pub(super) name: String,
    pub(super) scaling: String,
    pub(super) unit: String,
    pub(super) min: String,
    pub(super) max: String,
    pub(super) cycle_ms: String,
    pub(super) is_sensor: bool,
    pub(super) id: u8,
    pub(super) table_type: String,
}

impl DesignView {
    pub(super) fn new(plan: &HostPlan) -> Self {
        let mut names = names();
        let boards = plan.boards.iter().map(|board| BoardView::new(board, &mut names)).collect();
        let package = package(&plan.name);
        let krate = package.replace('-', "_");
        Self { name: literal(&plan.name), package, krate, boards }
    }

    /// The first board, and its first sensor, for examples.
    pub(super) fn sensor(&self) -> Option<(&BoardView, &MessageView)> {
        let with = |board| Some((board, BoardView::sensor(board)?));
        self.boards.iter().find_map(with)
    }

    /// The board of examples: the first one that reports something.
    pub(super) fn board(&self) -> &str {
        let first = self.sensor().map(|(board, _)| board).or_else(|| self.boards.first());
        first.map_or("Board", |board| &board.ident)
    }

    /// The actuator of the examples' board.
    pub(super) fn command(&self) -> Option<&MessageView> {
        let board = self.boards.iter().find(|board| board.ident == self.board())?;
        board.actuator()
    }
}

impl BoardView {
    fn new(plan: &BoardPlan, names: &mut Names) -> Self {
        let ident = names.take(&plan.name);
        let messages: Vec<MessageView> =
            plan.messages().map(|message| MessageView::new(message, names)).collect();
        let items = plan.devices.iter().filter_map(|device| {
            let is_it =
                |one: &&MessagePlan| (one.id, one.direction) == (device.id, device.direction);
            let found = plan.messages().find(is_it)?;
            Some(format!(
                "Item {{ id: {}, name: {}, is_sensor: {}, bytes: {}, is_bool: {} }}",
                found.id,
                literal(&found.name),
                found.direction == Direction::Sensor,
                found.value.size_bytes(),
                found.value.scalar == ScalarType::Bool,
            ))
        });
        Self {
            any: names.take(&format!("{ident}Message")),
            name: literal(&plan.name),
            text: joined(&plan.schema_text),
            hash: format!("0x{:08x}", plan.hash),
            checksum: match plan.checksum {
                Checksum::None => "None",
                Checksum::Crc16 => "Crc16",
                Checksum::Crc32 => "Crc32",
            },
            has_stamp: plan.has_stamp,
            baud: plan.baud,
            silence_ms: option(plan.silence_ms),
            items: items.collect(),
            messages,
            ident,
        }
    }

    fn sensor(&self) -> Option<&MessageView> {
        self.messages.iter().find(|message| message.is_sensor)
    }

    fn actuator(&self) -> Option<&MessageView> {
        self.messages.iter().find(|message| !message.is_sensor)
    }
}

impl MessageView {
    fn new(plan: &MessagePlan, names: &mut Names) -> Self {
        let scalar = plan.value.scalar;
        let raw = rust_type(scalar);
        let scaling = plan.scaling.as_ref().filter(|_| scalar != ScalarType::Bool);
        let scaling = scaling.filter(|one| **one != Scaling::default());
        let value = if scaling.is_some() { "f64" } else { raw };
        let of = |element: &str| match plan.value.length {
            None => element.to_owned(),
            Some(length) => format!("[{element}; {length}]"),
        };
        let is_sensor = plan.direction == Direction::Sensor;
        let kind = if is_sensor { "sensor" } else { "actuator" };
        let label = plan.label.as_deref().map_or(String::new(), |label| format!(": {label}"));
        let shown_in = plan.quantity.as_ref().map_or(String::new(), |unit| format!(" in {unit}"));
        Self {
            ident: names.take(&plan.name),
            doc: literal(&format!(
                "The {kind} {}{label}. Its value is shown{shown_in}, its code is {}.",
                plan.name, plan.value
            )),
            raw_type: of(raw),
            value_type: of(value),
            mode: if scaling.is_some() { "shown" } else { "plain" },
            name: literal(&plan.name),
            scaling: scaling.map_or("None".to_owned(), scaling_literal),
            // It is printed to terminals.
            unit: option(plan.quantity.as_deref().map(|unit| literal(&visible(unit)))),
            min: option(plan.limits.min.map(real)),
            max: option(plan.limits.max.map(real)),
            cycle_ms: option(plan.cycle_ms),
            is_sensor,
            id: plan.id,
            table_type: plan.value.to_string(),
        }
    }
}

/// A text of several lines as an expression.
fn joined(text: &str) -> String {
    let lines: Vec<String> = text.split_inclusive('\n').map(literal).collect();
    match &lines[..] {
        [line] => line.clone(),
        lines => format!("concat!(\n        {},\n    )", lines.join(",\n        ")),
    }
}

fn rust_type(scalar: ScalarType) -> &'static str {
    match scalar {
        ScalarType::Bool => "bool",
        ScalarType::Uint8 => "u8",
        ScalarType::Int8 => "i8",
        ScalarType::Uint16 => "u16",
        ScalarType::Int16 => "i16",
        ScalarType::Uint32 => "u32",
        ScalarType::Int32 => "i32",
        ScalarType::Uint64 => "u64",
        ScalarType::Int64 => "i64",
        ScalarType::Float32 => "f32",
        ScalarType::Float64 => "f64",
    }
}

fn scaling_literal(scaling: &Scaling) -> String {
    let points = scaling.curve.iter().map(|(x, y)| format!("({}, {})", real(*x), real(*y)));
    let curve: Vec<String> = points.collect();
    let (scale, offset) = (real(scaling.scale), real(scaling.offset));
    format!("Some(Scaling {{ scale: {scale}, offset: {offset}, curve: &[{}] }})", curve.join(", "))
}

/// A finite number as a literal of type `f64`.
fn real(number: f64) -> String {
    format!("{number:?}")
}

fn option(value: Option<impl ToString>) -> String {
    value.map_or("None".to_owned(), |value| format!("Some({})", value.to_string()))
}
