//! What happened, as JSON: values, presence and health in, one object each out.

use sensedsl_host::{reset_cause, status};
use sensedsl_wire::{Health, NEVER_MS};
use serde_json::{Map, Value, json};

use crate::event::Values;
use crate::plan::{BoardPlan, Place, Plan, seconds};

/// The values of a report, by topic: `{"board":…,"time":…,"values":{…},"raw":{…}}`.
#[must_use]
pub(crate) fn values(plan: &Plan, of: &Values) -> Value {
    let board = plan.board(of.board).map_or("", |on| on.board.name.as_str());
    let (mut shown, mut raw) = (Map::new(), Map::new());
    for (place, value) in plan.of(of) {
        shown.insert(place.route.topic.clone(), place.json(value));
        raw.insert(place.route.topic.clone(), place.raw_json(value));
    }
    let mut object = Map::new();
    object.insert("board".into(), board.into());
    object.insert("time".into(), seconds(of.taken).into());
    if let Some(stamp) = of.stamp {
        object.insert("stamp_us".into(), stamp.time_us.into());
        object.insert("counter".into(), stamp.counter.into());
    }
    if let Some(latency) = of.latency {
        object.insert("latency_s".into(), seconds(latency).into());
    }
    object.insert("values".into(), shown.into());
    object.insert("raw".into(), raw.into());
    object.into()
}

/// One value with its time and unit.
#[must_use]
pub(crate) fn value(place: &Place<'_>, of: &Values, raw: &[sensedsl_wire::Scalar]) -> Value {
    let mut object = Map::new();
    object.insert("time".into(), seconds(of.taken).into());
    object.insert("value".into(), place.json(raw));
    object.insert("raw".into(), place.raw_json(raw));
    object.insert("unit".into(), json!(place.route.unit));
    if let Some(stamp) = of.stamp {
        object.insert("stamp_us".into(), stamp.time_us.into());
    }
    object.into()
}

/// Whether a board is there.
#[must_use]
pub(crate) fn presence(on: &BoardPlan, away: Option<&str>) -> Value {
    json!({ "board": on.board.name, "online": away.is_none(), "why": away })
}

/// How a board and its devices are.
#[must_use]
pub(crate) fn health(on: &BoardPlan, health: &Health) -> Value {
    let known =
        |number: u64, unknown: u64| if number == unknown { Value::Null } else { number.into() };
    let devices: Map<String, Value> = health
        .devices
        .iter()
        .filter_map(|one| {
            let device = on.board.devices.iter().find(|device| device.id == one.id)?;
            let age = known(one.age_ms.into(), NEVER_MS.into());
            let failures: u32 = one.causes.counts().into_iter().map(u32::from).sum();
            let of = json!({ "status": status(one.status), "age_ms": age, "failures": failures });
            Some((device.name.clone(), of))
        })
        .collect();
    let hung = on.board.devices.iter().find(|device| device.id == health.reset_device);
    json!({
        "board": on.board.name,
        "uptime_s": f64::from(health.uptime_ms) / 1e3,
        "reset_cause": reset_cause(health.reset_cause),
        "hung": hung.map(|device| &device.name),
        "reports_sent": health.reports_sent,
        "reports_refused": health.reports_refused,
        "load_percent": known(health.load_percent.into(), u8::MAX.into()),
        "stack_left_bytes": known(health.stack_left_bytes.into(), u16::MAX.into()),
        "devices": devices,
    })
}

/// What a client needs to know of the boards before values make sense.
#[must_use]
pub(crate) fn schema(plan: &Plan) -> Value {
    let boards = plan.boards.iter().enumerate().map(|(board, on)| {
        let devices = (0..on.routes.len()).filter_map(|index| plan.place(board, index));
        let devices = devices.map(|place| {
            json!({
                "name": place.device.name,
                "topic": place.route.topic,
                "direction": place.device.direction.name(),
                "type": place.device.value.scalar.name(),
                "length": place.device.value.length,
                "kind": place.device.kind,
                "unit": place.route.unit,
                "min": place.device.min.map(|least| place.scaled(least)),
                "max": place.device.max.map(|most| place.scaled(most)),
                "cycle_ms": place.device.cycle_ms,
            })
        });
        json!({
            "name": on.board.name,
            "topic": on.topic,
            "hash": format!("0x{:08x}", on.board.schema.hash()),
            "devices": devices.collect::<Vec<_>>(),
        })
    });
    boards.collect()
}
