//! The names in a record, and what its JSON looks like to programs that know none of it.

use std::collections::BTreeMap;

use sensedsl_host::{Board, Device};
use sensedsl_wire::ScalarType;
use serde_json::{Value, json};

/// The profile in the header of a record.
pub const PROFILE: &str = "sensedsl";
/// The name of the attachment that describes the boards.
pub const SCHEMA_FILE: &str = "schema.json";
/// The last parts of the topic with how a board is. No device has a name with a slash.
pub const HEALTH: &str = "link/health";
/// The last parts of the topic with what became of a link.
pub const EVENTS: &str = "link/events";
/// The last parts of the topic with the bytes of a board.
pub const RECEIVED: &str = "link/received";
/// The last parts of the topic with the bytes to a board.
pub const SENT: &str = "link/sent";

/// The encoding of messages with values.
pub(crate) const JSON: &str = "json";
/// The encoding of their schemas.
pub(crate) const JSON_SCHEMA: &str = "jsonschema";
/// The encoding of messages with the bytes of a link.
pub(crate) const OCTETS: &str = "octets";

/// The topic of a device, or of something else of its board.
pub(crate) fn topic(board: &Board, name: &str) -> String {
    format!("/{}/{name}", board.name)
}

/// What a channel says of its device.
pub(crate) fn about(device: &Device) -> BTreeMap<String, String> {
    let mut about = BTreeMap::from([
        ("direction".to_owned(), device.direction.name().to_owned()),
        ("type".to_owned(), device.value.to_string()),
    ]);
    if let Some(unit) = &device.quantity {
        about.insert("unit".to_owned(), unit.clone());
    }
    if !device.kind.is_empty() {
        about.insert("kind".to_owned(), device.kind.clone());
    }
    about
}

/// The JSON schema of a device's messages.
pub(crate) fn value_schema(device: &Device, has_stamps: bool) -> Value {
    let is_bool = device.value.scalar == ScalarType::Bool;
    let one = |what: &str| {
        let form = if is_bool { "boolean" } else { "number" };
        let one = json!({ "type": form });
        match device.value.length {
            Some(_) => json!({ "type": "array", "items": one, "description": what }),
            None => json!({ "type": form, "description": what }),
        }
    };
    let unit = device
        .quantity
        .as_ref()
        .map_or_else(|| "as it is shown".to_owned(), |unit| format!("in {unit}"));
    let mut properties = json!({ "value": one(&unit), "raw": one("as it was sent") });
    if has_stamps && let Some(properties) = properties.as_object_mut() {
        let number = |what: &str| json!({ "type": "integer", "description": what });
        properties.insert("stamp_us".into(), number("microseconds of the board, 32 bits"));
        properties.insert("counter".into(), number("number of the report, 8 bits"));
    }
    json!({ "type": "object", "properties": properties })
}

/// The JSON schema of messages whose fields are not told one by one.
pub(crate) fn open_schema() -> Value {
    json!({ "type": "object" })
}
