//! `solve --format json`: the machine-readable form that scripts rely on.

use sensedsl_model::design::{Board, Design};
use sensedsl_wiring::assignment::{Assignment, BoardAssignment, Bound, Neatness, Wire};
use sensedsl_wiring::{Keep, NoWiring, Repaired};
use serde_json::{Value, json};

/// Version of the format.
const VERSION: u32 = 1;

/// The answer with a wiring.
#[must_use]
pub fn wired(design: &Design, assignment: &Assignment) -> Value {
    let boards: Vec<Value> = assignment
        .boards
        .iter()
        .filter_map(|on| Some(board_value(design, on, design.board(on.board)?)))
        .collect();
    let mut value = json!({
        "version": VERSION,
        "status": assignment.status.name(),
        "moved": assignment.moved,
        "violated": assignment.violated,
        "shared": assignment.shared,
        "cost": assignment.cost,
        "neatness": neatness(assignment),
        "count": null,
        "boards": boards,
    });
    if let (Some(bound), Some(object)) = (assignment.bound, value.as_object_mut()) {
        let Bound { moved, violated, shared, cost } = bound;
        let bound = json!({ "moved": moved, "violated": violated, "shared": shared, "cost": cost });
        object.insert("bound".into(), bound);
    }
    value
}

fn neatness(assignment: &Assignment) -> Value {
    let Neatness { sides, span, is_proved, .. } = assignment.neatness;
    json!({ "sides": sides, "span": span, "proved": is_proved })
}

fn board_value(design: &Design, on: &BoardAssignment, board: &Board) -> Value {
    let devices: Vec<Value> = on
        .devices
        .iter()
        .filter_map(|wiring| {
            let device = design.device(wiring.device)?;
            let mut value = json!({
                "name": device.name.value,
                "id": device.id.value,
                "kind": device.kind.name().name(),
                "unit": wiring.unit,
                "wires": wires(design, on, board, &wiring.wires),
            });
            let part = design.part(device.part)?;
            if let (Some(_), Some(object)) = (&part.chip, value.as_object_mut()) {
                object.insert("chip".into(), part.name.value.as_str().into());
            }
            Some(value)
        })
        .collect();
    let mut value = json!({
        "name": board.name.value,
        "mcu": board.mcu,
        "cost": on.cost,
        "devices": devices,
    });
    if let (Some(link), Some(object)) = (&on.link, value.as_object_mut()) {
        let link = json!({
            "transport": "uart", "unit": link.unit, "wires": wires(design, on, board, &link.wires),
        });
        object.insert("link".into(), link);
    }
    value
}

fn wires(design: &Design, on: &BoardAssignment, board: &Board, wires: &[Wire]) -> Vec<Value> {
    let value = |wire: &Wire| {
        let pin = wire.pin(board)?;
        let mut value = json!({
            "role": wire.name(design),
            "pin": pin.name.as_str(),
            "signal": wire.signal(board),
            "usages": pin.cost(),
        });
        let connection = wire.connection.and_then(|index| design.connection(index));
        let is_one_of_several =
            connection.is_some_and(|one| one.element.is_some() || one.name.is_some());
        if let (true, Some(object)) = (is_one_of_several, value.as_object_mut()) {
            object.insert("unit".into(), on.unit_of(wire).into());
        }
        if let (Some(with), Some(object)) = (on.shared_with(wire), value.as_object_mut()) {
            object.insert("shared".into(), with.into());
        }
        Some(value)
    };
    wires.iter().filter_map(value).collect()
}

/// Adds the exact number of wirings to an answer.
#[must_use]
pub fn with_count(mut value: Value, count: &str) -> Value {
    if let Some(object) = value.as_object_mut() {
        object.insert("count".into(), count.into());
    }
    value
}

/// Adds the boards and devices that are not in the answer because they are in error.
#[must_use]
pub fn with_left_out(mut value: Value, names: &[&str]) -> Value {
    if let Some(object) = value.as_object_mut() {
        object.insert("left_out".into(), names.into());
    }
    value
}

/// The answer that there is no wiring.
#[must_use]
pub fn infeasible(design: &Design, conflict: &NoWiring) -> Value {
    let name = |index: &_| design.part(*index).map(|part| part.name.value.clone());
    let devices: Vec<String> = conflict.parts.iter().filter_map(name).collect();
    let repairs: Vec<Value> = conflict
        .repairs
        .iter()
        .map(|Repaired { repair, cost, is_best }| {
            json!({
                "action": repair.action(),
                "device": repair.device().and_then(|device| name(&device)),
                "message": repair.describe(design),
                "cost": cost,
                "best": is_best,
            })
        })
        .collect();
    let resources: Vec<&str> = conflict.resources.iter().map(|one| one.name.as_str()).collect();
    let rules: Vec<String> = conflict.rules.iter().map(|rule| rule.describe(design)).collect();
    let mut value = json!({
        "version": VERSION,
        "status": "infeasible",
        "moved": 0,
        "violated": 0,
        "shared": 0,
        "cost": null,
        "count": null,
        "boards": [],
        "conflict": {
            "devices": devices, "resources": resources, "repairs": repairs,
            "rules": rules, "places": places(design, conflict),
            "minimal": conflict.minimal,
        },
    });
    let stated = value.get_mut("conflict").and_then(Value::as_object_mut);
    if let Some(stated) = stated.filter(|_| !conflict.explained) {
        stated.insert("explained".to_owned(), json!(false));
    }
    value
}

/// The rows of the tables that show what is contested: the resource, the board, the pin and its
/// line.
fn places(design: &Design, conflict: &NoWiring) -> Vec<Value> {
    let mut places = Vec::new();
    for contested in &conflict.resources {
        let Some(board) = design.board(contested.board) else { continue };
        for pin in contested.pins.iter().filter_map(|pin| board.table.pins.get(*pin)) {
            places.push(json!({
                "resource": contested.name,
                "board": board.name.value,
                "pin": pin.name.as_str(),
                "line": pin.row,
            }));
        }
    }
    places
}

/// An earlier answer, read back to be kept; `None` if the value is not an answer.
#[must_use]
pub fn keep(value: &Value) -> Option<Keep> {
    let mut keep = Keep::default();
    for board in value.get("boards")?.as_array()? {
        let name = board.get("name")?.as_str()?;
        for device in board.get("devices")?.as_array()? {
            let device_name = device.get("name")?.as_str()?;
            for wire in device.get("wires")?.as_array()? {
                let (role, pin) = (wire.get("role")?.as_str()?, wire.get("pin")?.as_str()?);
                keep.add(device_name, role, name, pin);
            }
        }
    }
    Some(keep)
}
