//! Commands of other programs: what they send in, an actuator and a text that the host reads out.
//!
//! Whatever comes is text of strangers: it is bounded, checked against the actuator's type and limits, and refused with
//! a reason that can be sent back.

use sensedsl_host::CommandError;
use sensedsl_limits::MESSAGE_BYTES_MAX;
use serde_json::Value;

use crate::plan::Place;

/// The most characters of a value that is a text, such as `45 deg`.
const TEXT_CHARS_MAX: usize = 200;
/// Digits of a number that was scaled: enough for any code, and free of what floating point adds.
const DIGITS: usize = 14;

/// A command that the host takes.
#[derive(Clone, Debug, PartialEq)]
pub struct Command {
    /// The place of the board.
    pub board: usize,
    /// The place of the actuator.
    pub index: usize,
    /// The name of the actuator.
    pub name: String,
    /// The value, as the host reads it.
    pub text: String,
}

/// The command that bytes are for an actuator: JSON, or a text such as `on` or `45 deg`.
///
/// # Errors
/// Fails with the reason, for people.
pub fn of_bytes(place: &Place<'_>, bytes: &[u8]) -> Result<Command, String> {
    if bytes.len() > MESSAGE_BYTES_MAX {
        return Err(format!("it has more than {MESSAGE_BYTES_MAX} bytes"));
    }
    let text = std::str::from_utf8(bytes).map_err(|_| "it is not UTF-8".to_owned())?;
    let value = serde_json::from_str(text).unwrap_or_else(|_| Value::String(text.to_owned()));
    of_json(place, &value)
}

/// The command that a JSON value is for an actuator.
///
/// # Errors
/// Fails with the reason, for people.
pub fn of_json(place: &Place<'_>, value: &Value) -> Result<Command, String> {
    if !place.is_actuator() {
        return Err(format!("`{}` is a sensor: it is not set", place.device.name));
    }
    let text = match value {
        Value::Array(all) => {
            let expected = place.device.value.count();
            if all.len() != expected {
                return Err(CommandError::Count { expected, found: all.len() }.to_string());
            }
            let words: Option<Vec<String>> = all.iter().map(|one| word(place, one)).collect();
            words.ok_or("a list must hold numbers, or `true` and `false`")?.join(" ")
        }
        Value::String(text) => {
            let is_short = text.chars().count() <= TEXT_CHARS_MAX;
            let text = text.trim();
            if !is_short || text.chars().any(char::is_control) {
                return Err("a text must be short and without control characters".to_owned());
            }
            text.to_owned()
        }
        Value::Number(_) | Value::Bool(_) => {
            word(place, value).ok_or("the number is out of reach")?
        }
        Value::Null | Value::Object(_) => {
            return Err("a value must be a number, a text, `true`, `false` or a list".to_owned());
        }
    };
    let name = place.device.name.clone();
    // The host judges it again; this says at once what would become of it.
    let judged = place.on.board.command(&name, &text);
    judged.map_err(|why: CommandError| why.to_string())?;
    Ok(Command { board: place.board, index: place.index, name, text })
}

fn word(place: &Place<'_>, value: &Value) -> Option<String> {
    let number = match value {
        Value::Bool(flag) if place.is_bool() => return Some(flag.to_string()),
        Value::Number(number) => number.as_f64()?,
        Value::Null | Value::Bool(_) | Value::String(_) | Value::Array(_) | Value::Object(_) => {
            return None;
        }
    };
    let shown = number / place.route.factor;
    if place.route.factor == 1.0 {
        return Some(shown.to_string());
    }
    let rounded: f64 = format!("{shown:.DIGITS$e}").parse().ok()?;
    Some(rounded.to_string())
}
