//! Examples of messages that several devices go out in: boards in, lines of TOML out.
//!
//! Where a design has devices that look like a message, the example names them, so that removing `#` is enough.

use sensedsl_host::{Board, Device};
use sensedsl_wire::{Direction, ScalarType};

use super::message::{Field, MESSAGES, MessageSpec, Takes};
use super::units::convert;

/// What there is to say where nothing fits. It is set apart from what can be taken as it is.
const GENERAL: &str = "
# For ROS 2, several devices in one message, such as:
#
#     [messages.battery]        # the topic
#     type = \"BatteryState\"     # or Joy, NavSatFix, JointState, Imu
#     voltage = \"Rover/Volts\"   # the fields of the message
#     current = \"Rover/Amps\"
";

/// A field, and words in the names of devices that are meant for it.
type Hint = (&'static str, &'static [&'static str]);

/// The type and the topic of each example, and how its devices are found.
const HINTS: &[(&str, &str, &[Hint])] = &[
    (
        "BatteryState",
        "battery",
        &[
            ("voltage", &["bat", "volt"]),
            ("current", &["bat", "curr", "amp"]),
            ("percentage", &["bat", "charge", "percent"]),
        ],
    ),
    ("Joy", "pad", &[("axes", &["stick", "axis", "joy", "throttle"]), ("buttons", &[""])]),
    (
        "NavSatFix",
        "fix",
        &[("latitude", &["lat"]), ("longitude", &["lon", "lng"]), ("altitude", &["alt"])],
    ),
    ("JointState", "joints", &[("position", &[""])]),
    ("Imu", "imu", &[("linear_acceleration", &[""]), ("angular_velocity", &[""])]),
];

/// All examples for boards.
pub(super) fn examples(boards: &[Board]) -> String {
    let found = HINTS.iter().filter_map(|(name, topic, hints)| {
        let spec = MESSAGES.iter().find(|spec| spec.name == *name)?;
        example(boards, spec, topic, hints)
    });
    let found: String = found.collect();
    if found.is_empty() { GENERAL.to_owned() } else { found }
}

fn example(boards: &[Board], spec: &MessageSpec, topic: &str, hints: &[Hint]) -> Option<String> {
    let fields = hints.iter().filter_map(|(name, hints)| {
        let field = spec.fields.iter().find(|field| field.name == *name)?;
        Some((field, named(boards, field, hints)))
    });
    let fields: Vec<(&Field, Vec<String>)> = fields.filter(|(_, all)| !all.is_empty()).collect();
    let has = |name: &str| fields.iter().any(|(field, _)| field.name == name);
    let is_whole = spec.fields.iter().all(|field| !field.is_needed || has(field.name));
    // One device has its own message; together they are worth more only from two on.
    let count: usize = fields.iter().map(|(_, all)| all.len()).sum();
    if !is_whole || (count < 2 && spec.name != "BatteryState") {
        return None;
    }
    let head = format!("\n# For ROS 2, in one message: {}\n# [messages.{topic}]\n", spec.about);
    let mut text = format!("{head}# type = \"{}\"\n", spec.name);
    for (field, all) in fields {
        let value = match (field.takes, all.first()) {
            (Takes::Numbers | Takes::Flags, _) => format!("[{}]", all.join(", ")),
            (Takes::Number | Takes::State | Takes::Vector, Some(first)) => first.clone(),
            (Takes::Number | Takes::State | Takes::Vector, None) => continue,
        };
        text.push_str(&format!("# {} = {value}\n", field.name));
    }
    Some(text)
}

/// The sensors that look like a field, by the first word of the hints that any of them has.
fn named(boards: &[Board], field: &Field, hints: &[&str]) -> Vec<String> {
    let of = |board: &Board, hint: &str| -> Vec<String> {
        let fitting = board.devices.iter().filter(|device| fits(device, field));
        let meant = fitting.filter(|device| device.name.to_lowercase().contains(hint));
        meant.map(|device| format!("\"{}/{}\"", board.name, device.name)).collect()
    };
    let all = hints
        .iter()
        .map(|hint| boards.iter().flat_map(|board| of(board, hint)).collect::<Vec<String>>());
    all.into_iter().find(|all| !all.is_empty()).unwrap_or_default()
}

fn fits(device: &Device, field: &Field) -> bool {
    let is_flag = device.value.scalar == ScalarType::Bool;
    let length = device.value.length;
    let is_right = match field.takes {
        Takes::Number | Takes::State => !is_flag && length.is_none(),
        Takes::Numbers => !is_flag && length.is_none() && is_joint(device, field),
        Takes::Flags => is_flag && length.is_none(),
        Takes::Vector => !is_flag && length == Some(3),
    };
    let unit = device.quantity.as_deref();
    let converts = field.units.iter().any(|wanted| convert(device, unit, wanted).is_some());
    device.direction == Direction::Sensor && is_right && (converts || field.units.is_empty())
}

/// Whether a device that would be a position is one of a joint.
fn is_joint(device: &Device, field: &Field) -> bool {
    field.name != "position" || device.kind == "encoder"
}
