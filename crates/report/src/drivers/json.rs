//! The parts as JSON, for programs.

use sensedsl_model::facts::{ConnectionFacts, PartFacts, ValueFacts, example};
use sensedsl_wire::Direction;
use serde_json::{Value, json};

/// Several parts as one document.
#[must_use]
pub fn values(parts: &[PartFacts]) -> Value {
    json!({ "version": 1, "drivers": parts.iter().map(value).collect::<Vec<_>>() })
}

/// A part as JSON.
#[must_use]
pub fn value(part: &PartFacts) -> Value {
    let identity = part.protocol.as_ref().and_then(|protocol| protocol.identity.as_ref());
    json!({
        "name": part.name,
        "field": part.field,
        "kinds": part.kinds.iter().map(|kind| kind.name()).collect::<Vec<_>>(),
        "part": part.part,
        "about": part.about,
        "aliases": part.aliases,
        "sheet": part.sheet,
        "checked": part.checked,
        "supply_mv": part.supply_mv.map(|(least, most)| [least, most]),
        "clock_max_hz": part.clock_max_hz,
        "needs_pull_up": part.needs_pull_up,
        "addresses": part.addresses,
        "address": part.address,
        "connector": part.module.connector,
        "notes": part.module.notes,
        "identity": identity.map(|one| json!({
            "register": one.register,
            "bytes": one.expected,
            "mask": if one.mask.is_empty() { None } else { Some(&one.mask) },
        })),
        "connections": part.connections.iter().map(|one| connection(part, one)).collect::<Vec<_>>(),
        "values": part.values.iter().map(of_value).collect::<Vec<_>>(),
        "example": example(part),
    })
}

fn connection(part: &PartFacts, one: &ConnectionFacts) -> Value {
    let wires = one.roles.iter().map(
        |role| json!({ "role": role.name(), "contact": crate::contact::Wires::of_driver(one).contact(&part.module, *role) }),
    );
    json!({
        "name": one.name,
        "kind": one.kind.name().name(),
        "wires": wires.collect::<Vec<_>>(),
        "level_mv": one.level.map(|level| level.mv),
        "divider_ohm": one.level.and_then(|level| level.divider),
    })
}

fn of_value(one: &ValueFacts) -> Value {
    let direction = match one.direction {
        Direction::Sensor => "sensor",
        Direction::Actuator => "actuator",
    };
    json!({
        "name": one.name,
        "direction": direction,
        "type": one.value.to_string(),
        "kind": one.kind.name().name(),
        "connections": one.via,
        "quantity": one.shown.quantity,
        "scale": one.shown.scale,
        "offset": one.shown.offset,
        "curve": one.shown.curve,
        "range": one.range().map(|(least, most)| [least, most]),
        "invalid": one.filter.invalid,
    })
}
