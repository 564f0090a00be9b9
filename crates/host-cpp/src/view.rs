//! The plan in C++ words: types, literals, names. Shared by all C++ hosts.
//!
//! In: a [`HostPlan`]. Out: views whose fields are what templates print, nothing left to compute.

use sensedsl_diagnostics::visible;
use sensedsl_wire::ScalarType;

use super::names::CppNames;
use sensedsl_job::host::{BoardPlan, DevicePlan, DirectionPlan, HostPlan, Limits, MessagePlan};

/// Distance between a wire identifier and the number of its message on an OpenDaVINCI or libcluon
/// bus. Those busses are shared with other programs, whose messages have small numbers and four-digit ones.
const MESSAGE_NUMBER_BASE: u32 = 21_000;

/// Distance between a wire identifier and its data type in the OpenDaVINCI of 2014, whose data types
/// are an enumeration: 701 to 954 are free there and within its range of values.
const DATA_TYPE_BASE_2014: u32 = 700;

/// The whole design.
pub(super) struct DesignView {
    /// Its namespace in `sense`, its `CMake` target, its folder of headers.
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
    /// Its class and the stem of its files.
    pub(super) ident: String,
    pub(super) hash: String,
    /// C++ string literals, a line each.
    pub(super) schema_text: Vec<String>,
    pub(super) checksum: &'static str,
    pub(super) has_stamp: bool,
    pub(super) baud: u32,
    /// 0 for never.
    pub(super) silence_ms: u32,
    pub(super) devices: Vec<DeviceView>,
    pub(super) sensors: Vec<MessageView>,
    pub(super) actuators: Vec<MessageView>,
    pub(super) sensor_payload_bytes_max: usize,
    pub(super) actuator_payload_bytes_max: usize,
    pub(super) sensor_short_bytes_max: usize,
    pub(super) actuator_short_bytes_max: usize,
}

/// One device as health has it.
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
    /// Its class.
    pub(super) ident: String,
    /// The same from anywhere: `::sense::fig2::IRFront`.
    pub(super) path: String,
    /// Its name in an .odvd file: `sense.fig2.IRFront`.
    pub(super) odvd_name: String,
    pub(super) id: u8,
    /// Number on a bus of messages, unique beside other programs' messages.
    pub(super) number: u32,
    pub(super) data_type_2014: u32,
    pub(super) is_actuator: bool,
    /// One line for a comment.
    pub(super) summary: String,
    /// One line for a help text, as a C++ string literal: name, type, limits, label.
    pub(super) help: String,
    /// `uint16_t`
    pub(super) cpp_type: &'static str,
    pub(super) scalar_bytes: usize,
    pub(super) is_bool: bool,
    pub(super) count: usize,
    pub(super) is_array: bool,
    /// The function that says how values are shown: `::sense::fig2::scaling::IRFront`.
    pub(super) scaling: String,
    /// C++ literals.
    pub(super) scale: String,
    pub(super) offset: String,
    /// Points as C++ initialisers: `{80.0, 8.0}`.
    pub(super) curve: Vec<String>,
    pub(super) has_value: bool,
    /// C++ expressions of type double.
    pub(super) min: String,
    pub(super) max: String,
    /// 0 when values come only when something happens.
    pub(super) cycle_ms: u32,
    /// The unit as a C++ string literal; `""` when there is none.
    pub(super) quantity: String,
    /// ` cm` as a C++ string literal, for printing behind a number.
    pub(super) quantity_suffix: String,
    /// One for each element, raw ones first.
    pub(super) fields: Vec<FieldView>,
    /// The number of the field `is_raw`, which says by what a command is taken; none where there is nothing to choose.
    pub(super) is_raw_number: Option<usize>,
}

/// One scalar of a message on a bus.
pub(super) struct FieldView {
    pub(super) number: usize,
    /// `raw`, `raw2`, `value`, `value2`.
    pub(super) name: String,
    /// `uint16` in an .odvd file.
    pub(super) odvd_type: &'static str,
    pub(super) element: usize,
    pub(super) is_raw: bool,
}

impl DesignView {
    /// Names are unique over the whole design, so that messages of all boards fit one namespace.
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

    /// What message numbers begin with.
    pub(super) fn number_base(&self) -> u32 {
        MESSAGE_NUMBER_BASE
    }

    /// What data types of 2014 begin with.
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

    /// Sensors, then actuators.
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
        // It is printed to terminals.
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

/// The one place where a scalar type of the wire becomes types of the C++ hosts.
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

/// A limit as a C++ expression; one that is not there is infinite.
fn limit_literal(sign: &str, limit: Option<f64>) -> String {
    limit.map_or_else(|| format!("{sign}std::numeric_limits<double>::infinity()"), real_literal)
}

/// Text as a C++ string literal. Bytes outside printable ASCII become octal escapes, which end after
/// three digits; `?` too, so that no trigraph can arise.
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

/// Text that cannot end a `//` comment or go on in the next line: nothing hidden, and no backslash at
/// the end, not even one spelt as a trigraph.
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
