//! `schema.json`: the wire, for programs that decode it without generated code.

use sensedsl_model::design::{Board, Design, Device, DeviceIndex, Transport};
use sensedsl_wire::{Direction, ScalarType, Schema};
use sensedsl_wiring::assignment::{Assignment, BoardAssignment};
use serde_json::{Map, Value, json};

/// Version of the format.
const VERSION: u32 = 2;

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
        devices.iter().filter_map(|index| item(design, *index, design.device(*index)?)).collect();
    json!({
        "name": board.name.value,
        "hash": format!("0x{:08x}", schema.hash()),
        "checksum": schema.checksum.name(),
        "stamp": schema.stamp,
        "baud": (board.link.transport == Transport::Uart).then_some(board.link.baud),
        "silence_ms": board.link.silence_ms,
        "frame_bytes_max": {
            "sensors": schema.frame_bytes_max(Direction::Sensor),
            "actuators": schema.frame_bytes_max(Direction::Actuator),
        },
        "items": items,
    })
}

fn item(design: &Design, index: DeviceIndex, device: &Device) -> Option<Value> {
    let part = design.part(device.part)?;
    let scalar = device.value.value.scalar;
    let mut object = Map::new();
    object.insert("id".into(), device.id.value.into());
    object.insert("name".into(), device.name.value.as_str().into());
    object.insert("direction".into(), device.direction.name().into());
    object.insert("type".into(), scalar.name().into());
    object.insert("length".into(), device.value.value.length.map_or(Value::Null, Value::from));
    object.insert("kind".into(), device.kind.name().name().into());
    object.insert("cycle_ms".into(), design.told_every_ms(device).map_or(Value::Null, Value::from));
    if let Some(own) = design.owner(index).filter(|_| device.direction == Direction::Actuator) {
        let controller = design.device(own.device)?;
        let host = if own.host_overrides { "override" } else { "refused" };
        let owner = json!({ "controller": controller.name.value, "host": host });
        object.insert("owner".into(), owner);
    }
    let chip = part.chip.is_some();
    let chip = chip.then(|| json!({ "name": part.name.value, "driver": part.driver }));
    object.insert("chip".into(), chip.unwrap_or_default());
    let shown = &device.shown;
    for (name, text) in [("label", &shown.label), ("quantity", &shown.quantity)] {
        object.insert(name.into(), text.as_deref().map_or(Value::Null, Value::from));
    }
    let numbers =
        [("scale", shown.scale), ("offset", shown.offset), ("min", shown.min), ("max", shown.max)];
    for (name, number) in numbers {
        object.insert(name.into(), number.map_or(Value::Null, Value::from));
    }
    object.insert("curve".into(), shown.curve.iter().map(|(x, y)| json!([x, y])).collect());
    let ranges = device.filter.invalid.iter();
    let invalid = ranges.map(|(from, to)| json!([raw(scalar, *from), raw(scalar, *to)]));
    object.insert("invalid".into(), invalid.collect());
    Some(Value::Object(object))
}

/// A raw value as JSON writes it: without a fraction if the type has none.
fn raw(scalar: ScalarType, number: f64) -> Value {
    /// Every whole number up to this is exact as a double.
    const EXACT: f64 = 9_007_199_254_740_992.0;
    let is_real = matches!(scalar, ScalarType::Float32 | ScalarType::Float64);
    if is_real || number.fract() != 0.0 || number.abs() > EXACT {
        return number.into();
    }
    #[expect(
        clippy::cast_possible_truncation,
        reason = "whole, and within what a double holds exactly"
    )]
    let whole = number as i64;
    whole.into()
}
