//! `schema.json`: the wire, for programs that decode it without generated code.

use sensedsl_model::design::{Board, Design, Device, DeviceIndex};
use sensedsl_wire::{Direction, Schema};
use sensedsl_wiring::assignment::{Assignment, BoardAssignment};
use serde_json::{Map, Value, json};

/// Version of the format.
const VERSION: u32 = 1;

/// The links of all boards that carry a device.
#[must_use]
pub fn schema(design: &Design, assignment: &Assignment) -> Value {
    let boards: Vec<Value> =
        assignment.used(design).map(|(on, board)| board_value(design, on, board)).collect();
    json!({ "version": VERSION, "byte_order": "big", "framing": "netstring", "boards": boards })
}

fn board_value(design: &Design, on: &BoardAssignment, board: &Board) -> Value {
    let devices: Vec<DeviceIndex> = on.devices.iter().map(|wiring| wiring.device).collect();
    let schema: Schema = design.schema(on.board, &devices);
    let items: Vec<Value> =
        devices.iter().filter_map(|index| design.device(*index)).map(item).collect();
    json!({
        "name": board.name.value,
        "hash": format!("0x{:08x}", schema.hash()),
        "checksum": schema.checksum.name(),
        "frame_bytes_max": {
            "sensors": schema.frame_bytes_max(Direction::Sensor),
            "actuators": schema.frame_bytes_max(Direction::Actuator),
        },
        "items": items,
    })
}

fn item(device: &Device) -> Value {
    let mut object = Map::new();
    object.insert("id".into(), device.id.value.into());
    object.insert("name".into(), device.name.value.as_str().into());
    object.insert("direction".into(), device.direction.name().into());
    object.insert("type".into(), device.value.value.scalar.name().into());
    object.insert("length".into(), device.value.value.length.map_or(Value::Null, Value::from));
    object.insert("kind".into(), device.kind.name().name().into());
    let shown = &device.shown;
    for (name, text) in [("label", &shown.label), ("quantity", &shown.quantity)] {
        object.insert(name.into(), text.as_deref().map_or(Value::Null, Value::from));
    }
    let numbers =
        [("scale", shown.scale), ("offset", shown.offset), ("min", shown.min), ("max", shown.max)];
    for (name, number) in numbers {
        object.insert(name.into(), number.map_or(Value::Null, Value::from));
    }
    Value::Object(object)
}
