//! The plan in C++ terms: types, literals, names. Shared by all C++ hosts.
//!
//! In: a [`HostPlan`]. Out: views whose fields are exactly what templates print, with nothing left to compute.

use sensedsl_diagnostics::visible;
use sensedsl_wire::ScalarType;

use super::names::CppNames;
use sensedsl_job::host::{BoardPlan, DevicePlan, DirectionPlan, HostPlan, Limits, MessagePlan};

/// The offset between a wire identifier and the number of its message on an OpenDaVINCI or libcluon bus. Those buses
/// are shared with other programs, whose messages have numbers of up to four digits.
const MESSAGE_NUMBER_BASE: u32 = 21_000;

/// The offset between a wire identifier and its data type in the OpenDaVINCI of 2014, whose data types are an
/// enumeration: 701 to 954 are free and within its range of values.
const DATA_TYPE_BASE_2014: u32 = 700;

/// The whole design.
pub(super) struct DesignView {
    /// Its namespace in `sense`, its `CMake` target, and its folder of headers.
    pub(super) ident: String,
    pub(super) boards: Vec<BoardView>,
}

/// One board.
pub(super) struct BoardView {
    /// The design's namespace.
    pub(super) design: String,
    pub(super) name: String,
    /// Its name as a C++ string literal.
    pub(super) name_literal: String,
    /// The name of its class and the stem of its files.
    pub(super) ident: String,
    pub(super) hash: String,
    /// The schema text as C++ string literals, one per line.
    pub(super) schema_text: Vec<String>,
    pub(super) checksum: &'static str,
    pub(super) has_stamp: bool,
    pub(super) baud: u32,
    /// The time limit without frames from the host; 0 for never.
    pub(super) silence_ms: u32,
    pub(super) devices: Vec<DeviceView>,
    pub(super) sensors: Vec<MessageView>,
    pub(super) actuators: Vec<MessageView>,
    pub(super) sensor_payload_bytes_max: usize,
    pub(super) actuator_payload_bytes_max: usize,
    pub(super) sensor_short_bytes_max: usize,
    pub(super) actuator_short_bytes_max: usize,
}

/// A device as listed in health.
pub(super) struct DeviceView {
    pub(super) id: u8,
    /// Its name as a C++ string literal.
    pub(super) name: String,
    pub(super) is_actuator: bool,
}

/// One message.
pub(super) struct MessageView {
    /// The device's name as a C++ string literal.
    pub(super) name: String,
    /// The name of its class.
    pub(super) ident: String,
    /// The qualified name of its class: `::sense::fig2::IRFront`.
    pub(super) path: String,
    /// Its name in an .odvd file: `sense.fig2.IRFront`.
    pub(super) odvd_name: String,
    pub(super) id: u8,
    /// The message's number on the bus, distinct from those of other programs' messages.
    pub(super) number: u32,
    pub(super) data_type_2014: u32,
    pub(super) is_actuator: bool,
    /// A one-line summary, for a comment.
    pub(super) summary: String,
    /// A one-line help text as a C++ string literal: name, type, limits, label.
    pub(super) help: String,
    /// `uint16_t`
    pub(super) cpp_type: &'static str,
    pub(super) scalar_bytes: usize,
    pub(super) is_bool: bool,
    pub(super) count: usize,
    pub(super) is_array: bool,
    /// The function that describes how values are shown: `::sense::fig2::scaling::IRFront`.
    pub(super) scaling: String,
    /// Scale and offset as C++ literals.
    pub(super) scale: String,
    pub(super) offset: String,
    /// The points as C++ initialisers: `{80.0, 8.0}`.
    pub(super) curve: Vec<String>,
    pub(super) has_value: bool,
    /// The limits as C++ expressions of type double.
    pub(super) min: String,
    pub(super) max: String,
    /// The cycle time; 0 if values come only when something happens.
    pub(super) cycle_ms: u32,
    /// The unit as a C++ string literal; `""` if there is none.
    pub(super) quantity: String,
    /// The unit as a suffix for numbers, as a C++ string literal: ` cm`.
    pub(super) quantity_suffix: String,
    /// The fields of each element, raw ones first.
    pub(super) fields: Vec<FieldView>,
    /// The number of the field `is_raw`, which selects the value that a command uses; `None` if there is no choice.
    pub(super) is_raw_number: Option<usize>,
}

/// One scalar of a message on a bus.
pub(super) struct FieldView {
    pub(super) number: usize,
    /// `raw`, `raw2`, `value`, `value2`.
    pub(super) name: String,
    /// The type in an .odvd file: `uint16`.
    pub(super) odvd_type: &'static str,
    pub(super) element: usize,
    pub(super) is_raw: bool,
}

impl DesignView {
    /// Names are unique within the whole design, so that messages of all boards can share a namespace.
    pub(super) fn new(plan: &HostPlan) -> Self {
        let ident = CppNames::new().take(&plan.name);
        let mut names = CppNames::new();
        let boards = plan.boards.iter().map(|board| BoardView::new(board, &ident, &mut names));
        Self { boards: boards.collect(), ident }
    }

    /// All messages of all boards.
    pub(super) fn messages(&self) -> impl Iterator<Item = &MessageView> {
        self.boards.iter().flat_map(BoardView::messages)
    }

    /// The offset of message numbers.
    pub(super) fn number_base(&self) -> u32 {
        MESSAGE_NUMBER_BASE
    }

    /// The offset of data types in the OpenDaVINCI of 2014.
    pub(super) fn data_type_base_2014(&self) -> u32 {
        DATA_TYPE_BASE_2014
    }
}

impl BoardView {
    fn new(board: &BoardPlan, design: &str, names: &mut CppNames) -> Self {
        let sensors = messages(&board.sensors, design, names);
        let actuators = messages(&board.actuators, design, names);
        let schema_text = board.schema_text.split_inclusive('\n').map(string_literal).collect();
        Self {
            design: design.to_owned(),
            schema_text,
            name: one_line(&board.name),
            name_literal: string_literal(&board.name),
            ident: names.take(&board.name),
            hash: format!("0x{:08x}U", board.hash),
            checksum: board.checksum.name(),
            has_stamp: board.has_stamp,
            baud: board.baud,
            silence_ms: board.silence_ms.unwrap_or_default(),
            devices: board.devices.iter().map(DeviceView::new).collect(),
            sensors,
            actuators,
            sensor_payload_bytes_max: board.sensors.payload_bytes_max,
            actuator_payload_bytes_max: board.actuators.payload_bytes_max,
            sensor_short_bytes_max: board.sensors.short_bytes_max,
            actuator_short_bytes_max: board.actuators.short_bytes_max,
        }
    }

    /// The messages of the sensors, then those of the actuators.
    pub(super) fn messages(&self) -> impl Iterator<Item = &MessageView> {
        self.sensors.iter().chain(&self.actuators)
    }
}

impl DeviceView {
    fn new(device: &DevicePlan) -> Self {
        Self {
            id: device.id,
            name: string_literal(&device.name),
            is_actuator: device.direction == sensedsl_wire::Direction::Actuator,
        }
    }
}

fn messages(direction: &DirectionPlan, design: &str, names: &mut CppNames) -> Vec<MessageView> {
    direction.messages.iter().map(|message| MessageView::new(message, design, names)).collect()
}

impl MessageView {
    fn new(message: &MessagePlan, design: &str, names: &mut CppNames) -> Self {
        let ident = names.take(&message.name);
        // The unit is printed to terminals.
        let quantity = visible(message.quantity.as_deref().unwrap_or_default());
        let scalar = message.value.scalar;
        let count = message.value.count();
        let types = CppTypes::of(scalar);
        let scaling = message.scaling.clone().unwrap_or_default();
        let label = message.label.as_deref().map(|label| format!(": {label}")).unwrap_or_default();
        let is_actuator = message.direction == sensedsl_wire::Direction::Actuator;
        let has_value = message.scaling.is_some();
        let fields = fields(&types, count, message.value.length.is_some(), has_value);
        Self {
            name: string_literal(&message.name),
            path: format!("::sense::{design}::{ident}"),
            scaling: format!("::sense::{design}::scaling::{ident}"),
            odvd_name: format!("sense.{design}.{ident}"),
            ident,
            id: message.id,
            number: MESSAGE_NUMBER_BASE + u32::from(message.id),
            data_type_2014: DATA_TYPE_BASE_2014 + u32::from(message.id),
            is_actuator,
            summary: one_line(&format!(
                "{} {} {}{label}",
                message.direction.name(),
                message.name,
                message.value
            )),
            help: string_literal(&visible(&help(message))),
            cpp_type: types.cpp,
            scalar_bytes: scalar.size_bytes(),
            is_bool: scalar == ScalarType::Bool,
            count,
            is_array: message.value.length.is_some(),
            scale: real_literal(scaling.scale),
            offset: real_literal(scaling.offset),
            curve: scaling.curve.iter().map(point).collect(),
            has_value,
            min: limit_literal("-", message.limits.min),
            max: limit_literal("", message.limits.max),
            cycle_ms: message.cycle_ms.unwrap_or_default(),
            quantity: string_literal(&quantity),
            quantity_suffix: string_literal(&suffix(&quantity)),
            is_raw_number: (is_actuator && has_value).then_some(fields.len() + 1),
            fields,
        }
    }
}

/// `Steering int16, -30 to 30 deg: front axle`
fn help(message: &MessagePlan) -> String {
    let Limits { min, max } = message.limits;
    let limits = match (min, max) {
        (Some(min), Some(max)) => format!(", {min} to {max}"),
        (Some(min), None) => format!(", at least {min}"),
        (None, Some(max)) => format!(", at most {max}"),
        (None, None) => String::new(),
    };
    let quantity = suffix(message.quantity.as_deref().unwrap_or_default());
    let shown = if limits.is_empty() && !quantity.is_empty() { "," } else { "" };
    let label = message.label.as_deref().map(|label| format!(": {label}")).unwrap_or_default();
    format!("{} {}{limits}{shown}{quantity}{label}", message.name, message.value)
}

fn suffix(quantity: &str) -> String {
    if quantity.is_empty() { String::new() } else { format!(" {quantity}") }
}

fn fields(types: &CppTypes, count: usize, is_array: bool, has_value: bool) -> Vec<FieldView> {
    let kinds = [(true, "raw", types), (false, "value", &CppTypes::of(ScalarType::Float64))];
    let mut fields = Vec::new();
    for (is_raw, stem, types) in kinds.iter().filter(|(is_raw, ..)| *is_raw || has_value) {
        for element in 0..count {
            fields.push(FieldView {
                number: fields.len() + 1,
                name: if is_array { format!("{stem}{element}") } else { (*stem).to_owned() },
                odvd_type: types.odvd,
                element,
                is_raw: *is_raw,
            });
        }
    }
    fields
}

/// The C++ spellings of a scalar type of the wire, in this one place for all hosts.
struct CppTypes {
    cpp: &'static str,
    odvd: &'static str,
}

impl CppTypes {
    fn of(scalar: ScalarType) -> Self {
        let (cpp, odvd) = match scalar {
            ScalarType::Bool => ("bool", "bool"),
            ScalarType::Uint8 => ("uint8_t", "uint8"),
            ScalarType::Int8 => ("int8_t", "int8"),
            ScalarType::Uint16 => ("uint16_t", "uint16"),
            ScalarType::Int16 => ("int16_t", "int16"),
            ScalarType::Uint32 => ("uint32_t", "uint32"),
            ScalarType::Int32 => ("int32_t", "int32"),
            ScalarType::Uint64 => ("uint64_t", "uint64"),
            ScalarType::Int64 => ("int64_t", "int64"),
            ScalarType::Float32 => ("float", "float"),
            ScalarType::Float64 => ("double", "double"),
        };
        Self { cpp, odvd }
    }
}

/// A finite number as a C++ literal of type double.
fn real_literal(number: f64) -> String {
    format!("{number:?}")
}

/// A point of a curve as a C++ initialiser.
fn point((x, y): &(f64, f64)) -> String {
    format!("{{{}, {}}}", real_literal(*x), real_literal(*y))
}

/// A limit as a C++ expression; a missing one is infinite.
fn limit_literal(sign: &str, limit: Option<f64>) -> String {
    limit.map_or_else(|| format!("{sign}std::numeric_limits<double>::infinity()"), real_literal)
}

/// Text as a C++ string literal. Bytes outside printable ASCII become octal escapes, which end after three digits; so
/// does `?`, so that no trigraph can arise.
fn string_literal(text: &str) -> String {
    let mut literal = String::from("\"");
    for byte in text.bytes() {
        match byte {
            b' '..=b'~' if !matches!(byte, b'"' | b'\\' | b'?') => literal.push(char::from(byte)),
            _ => literal.push_str(&format!("\\{byte:03o}")),
        }
    }
    literal.push('"');
    literal
}

/// Text that cannot end a `//` comment or continue on the next line: without invisible characters and without a
/// backslash at the end, even one spelled as a trigraph.
fn one_line(text: &str) -> String {
    visible(&text.replace('\\', " ")).replace("??/", "?? /")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_stays_inside_its_literal_and_its_comment() {
        assert_eq!(string_literal("a\"b\\c\n??/°"), "\"a\\042b\\134c\\012\\077\\077/\\302\\260\"");
        assert_eq!(one_line("ends with \\\nint x; ??/"), "ends with  \\u{a}int x; ?? /");
    }

    #[test]
    fn numbers_are_double_literals() {
        let printed = [0.5, 1.0, -3.0, 1e-7, 1e300].map(real_literal);
        assert_eq!(printed, ["0.5", "1.0", "-3.0", "1e-7", "1e300"]);
    }
}
