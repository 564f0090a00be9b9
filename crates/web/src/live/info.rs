//! What a page must know of a board to show it: its devices, with ranges for sliders.

use sensedsl_host::{Board, Device};
use sensedsl_job::{BoardJob, JobDevice};
use sensedsl_twin::range::shown_range;
use sensedsl_twin::world::usual;
use sensedsl_wire::{Direction, ScalarType};
use serde_json::{Value, json};

/// How many steps a slider has at least, unless the device has fewer codes.
const STEPS: f64 = 200.0;
/// The end of a slider of a quantity that grows without bounds: so many of its first second.
const SECONDS: f64 = 10.0;

/// A board, and the names of all boards of its design.
pub(super) fn info(all: &[BoardJob<'_>], job: &BoardJob<'_>, host: &Board) -> Value {
    let names: Vec<&str> = all.iter().map(|one| one.board.name.value.as_str()).collect();
    let devices = host.devices.iter().zip(&job.devices);
    json!({
        "board": host.name,
        "boards": names,
        "hash": format!("{:#010x}", host.schema.hash()),
        "baud": host.baud,
        "controllers": controllers(job),
        "devices": devices.map(|(device, own)| one(device, own)).collect::<Vec<_>>(),
    })
}

fn controllers<'a>(job: &BoardJob<'a>) -> Vec<&'a str> {
    let devices = job.controllers.iter().filter_map(|one| job.devices.get(one.own));
    devices.map(|one| one.device.name.value.as_str()).collect()
}

fn one(device: &Device, own: &JobDevice<'_>) -> Value {
    let (least, greatest, step) = slider(device, own);
    json!({
        "name": device.name,
        "id": device.id,
        "direction": match device.direction {
            Direction::Sensor => "sensor",
            Direction::Actuator => "actuator",
        },
        "kind": device.kind,
        "type": device.value.to_string(),
        "elements": device.value.count(),
        "is_bool": device.value.scalar == ScalarType::Bool,
        "unit": device.quantity,
        "min": device.min,
        "max": device.max,
        "slider": { "min": least, "max": greatest, "step": step },
        "cycle_ms": device.cycle_ms,
    })
}

/// The ends of a slider and its step: what the design allows, or else what the world usually has, within what the device
/// can measure or take.
fn slider(device: &Device, own: &JobDevice<'_>) -> (f64, f64, f64) {
    if device.value.scalar == ScalarType::Bool {
        return (0.0, 1.0, 1.0);
    }
    let (least, greatest) = shown_range(own.device).unwrap_or((-100.0, 100.0));
    let (mut from, mut to) = match device.direction {
        Direction::Sensor => likely(own),
        Direction::Actuator => (least, greatest),
    };
    from = device.min.unwrap_or(from).max(least);
    to = device.max.unwrap_or(to).min(greatest);
    if from >= to {
        (from, to) = (least, greatest);
    }
    let code = device.scale.shown_step(device.scale.raw(f64::midpoint(from, to))).abs();
    let even = (to - from) / STEPS;
    let step =
        if code.is_finite() && code > 0.0 { (even / code).ceil().max(1.0) * code } else { even };
    (from, to, step)
}

/// What the world usually has, with as much again at both ends.
fn likely(own: &JobDevice<'_>) -> (f64, f64) {
    let signals = usual(own.index, own.device);
    let bounds = signals.iter().map(|one| {
        one.bounds().unwrap_or_else(|| {
            let steep = one.steepest().unwrap_or(1.0);
            (one.at(0), one.at(0) + steep * SECONDS)
        })
    });
    let (low, high) =
        bounds.fold((f64::MAX, f64::MIN), |sum, one| (sum.0.min(one.0), sum.1.max(one.1)));
    let more = (high - low) / 2.0;
    (low - more, high + more)
}
