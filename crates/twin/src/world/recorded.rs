//! A recorded run as a world: the sensors measure again what they measured then, and the host sets what it set.
//!
//! In: the numbers of a record as people saw them, so that a design that codes them differently can be compared with
//! it. Out: a [`World`] whose signals go straight from one recorded value to the next; what is either one or the other
//! jumps. What counts may have overflowed, or begun again when its board did: it goes on here.

use std::collections::BTreeMap;

use sensedsl_diagnostics::codes::e0542_world_value as value;
use sensedsl_diagnostics::{Diagnostic, FileId, Span};
use sensedsl_model::design::{Design, Device, DeviceIndex};
use sensedsl_wire::{Direction, ScalarType};

use super::file::{Scene, impossible, is_turning, key, short};
use super::{Shape, Signal, World};
use crate::commands::Command;
use crate::range::is_counter;
use crate::truth::{scalar, scale_of};

/// A number and its time.
pub type Point = (u64, f64);

/// A recorded run of one board. Times are nanoseconds since the run began, numbers are as they were shown.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Recorded {
    /// The values of each sensor, a course for each element, in the order of time.
    pub sensors: BTreeMap<String, Vec<Vec<Point>>>,
    /// What each actuator was set to, in the order of time, an element each.
    pub actuators: BTreeMap<String, Vec<(u64, Vec<f64>)>>,
    /// What the record says of its devices.
    pub devices: Vec<sensedsl_host::Device>,
    /// The length of the run.
    pub lasts_ns: u64,
}

/// What a recorded run became.
#[derive(Debug, Default)]
pub struct Again {
    /// The world.
    pub world: World,
    /// What the board cannot follow.
    pub reported: Vec<Diagnostic>,
    /// Devices of the record that the board does not have.
    pub left_out: Vec<String>,
    /// What of the others is not as it was, in words.
    pub changes: Vec<String>,
}

/// The world of a recorded run. `file` is the record, for diagnostics.
#[must_use]
pub fn recorded(file: FileId, run: Recorded, scene: &Scene<'_>) -> Again {
    let at = Span::new(file, 0..0);
    let world = World { lasts_ns: Some(run.lasts_ns), ..World::default() };
    let mut again = Again { world, ..Again::default() };
    let here = |name: &str, direction| {
        let mut all = scene.devices.iter().filter_map(|at| Some((*at, scene.design.device(*at)?)));
        all.find(|(_, one)| one.name.value == name && one.direction == direction)
    };
    for was in &run.devices {
        match here(&was.name, was.direction) {
            Some((_, device)) => {
                let value = run.sensors.get(&was.name).and_then(|all| all.first()?.first());
                again.changes.extend(changes(
                    was,
                    (scene.design, device),
                    value.map(|point| point.1),
                ));
            }
            None => again.left_out.push(was.name.clone()),
        }
    }
    for (name, courses) in run.sensors {
        let Some((index, device)) = here(&name, Direction::Sensor) else { continue };
        if courses.iter().all(Vec::is_empty) {
            continue;
        }
        let count = device.value.value.count();
        if courses.len() != count {
            again.reported.push(value::wrong_count(at, &name, courses.len(), count));
            continue;
        }
        let signals = courses.into_iter().enumerate();
        let signals: Vec<Signal> = signals
            .map(|(element, points)| signal(device, points, (scene, index, element)))
            .collect();
        again.reported.extend(signals.iter().find_map(|signal| impossible(device, signal, at)));
        let _ = again.world.signals.insert(index, signals);
    }
    for (name, all) in run.actuators {
        let Some((index, device)) = here(&name, Direction::Actuator) else { continue };
        let (scale, of) = (scale_of(&device.shown), device.value.value.scalar);
        let count = device.value.value.count();
        let fitting = all.into_iter().filter(|(_, shown)| shown.len() == count);
        again.world.commands.extend(fitting.map(|(at_ns, shown)| Command {
            device: index,
            at_ns,
            value: shown.into_iter().map(|one| scalar(of, scale.raw(one))).collect(),
        }));
    }
    again
}

/// What a host sees otherwise; `value` is one that was shown.
fn changes(
    was: &sensedsl_host::Device,
    (design, device): (&Design, &Device),
    value: Option<f64>,
) -> Vec<String> {
    let (name, scale) = (&was.name, scale_of(&device.shown));
    let mut all = Vec::new();
    if was.value != device.value.value {
        all.push(format!("{name} was {} and is {}", was.value, device.value.value));
    }
    let unit =
        |unit: &Option<String>| unit.as_ref().map_or(String::new(), |unit| format!(" {unit}"));
    let (unit_was, unit_is) = (unit(&was.quantity), unit(&device.shown.quantity));
    if was.scale != scale || unit_was != unit_is {
        let shown_was = value.unwrap_or_else(|| was.scale.shown(1.0));
        let shown_is = scale.shown(was.scale.raw(shown_was));
        all.push(format!(
            "{name} of {}{unit_was} would be {}{unit_is}",
            short(shown_was),
            short(shown_is)
        ));
    }
    if let (Some(was_ms), Some(is_ms)) = (was.cycle_ms, design.told_every_ms(device))
        && was_ms != is_ms
    {
        all.push(format!("{name} came every {was_ms} ms and comes every {is_ms} ms"));
    }
    all
}

fn signal(
    device: &Device,
    mut points: Vec<Point>,
    (scene, index, element): (&Scene<'_>, DeviceIndex, usize),
) -> Signal {
    if is_turning(device) {
        unwrap(device, &mut points);
    }
    let is_straight = device.value.value.scalar != ScalarType::Bool || is_turning(device);
    let shape = Shape::Points { points: corners(points), is_straight };
    let element = u64::try_from(element).unwrap_or(u64::MAX);
    Signal { key: key(scene.seed.unwrap_or(0), index, element), ..Signal::of(shape) }
}

/// Joins what overflowed or began again.
fn unwrap(device: &Device, points: &mut [Point]) {
    let Some((least, most)) = device.value.value.scalar.integer_range() else { return };
    let scale = scale_of(&device.shown);
    let each = scale.shown(1.0) - scale.shown(0.0);
    #[expect(clippy::cast_precision_loss, reason = "the ends of 64 bits are rounded")]
    let turn = (most - least + 1) as f64 * each;
    let counts_up = is_counter(&device.kind, device);
    let (mut added, mut last) = (0.0, None::<f64>);
    for (_, number) in points {
        let now = *number;
        if let Some(last) = last {
            let step = now - last;
            if step.abs() > turn.abs() / 2.0 {
                added -= turn.abs().copysign(step);
            } else if counts_up && step * each < 0.0 {
                added += last - scale.shown(0.0);
            }
        }
        last = Some(now);
        *number += added;
    }
}

/// The points without those between two equal ones, which change nothing.
fn corners(points: Vec<Point>) -> Vec<Point> {
    let mut kept: Vec<Point> = Vec::new();
    for point in points {
        match kept.as_mut_slice() {
            // A time comes once: the later value is the one that was reported.
            [.., last] if last.0 >= point.0 => last.1 = point.1,
            [.., before, last] if before.1 == last.1 && last.1 == point.1 => last.0 = point.0,
            _ => kept.push(point),
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_between_equal_points_is_dropped() {
        let points = vec![(0, 1.0), (1, 1.0), (2, 1.0), (3, 2.0), (3, 4.0), (4, 1.0), (5, 1.0)];
        let kept = corners(points.clone());
        assert_eq!(kept, [(0, 1.0), (2, 1.0), (3, 4.0), (4, 1.0), (5, 1.0)]);
        let shape = |points| Signal::of(Shape::Points { points, is_straight: true });
        for now in 0..7 {
            assert_eq!(shape(kept.clone()).at(now), shape(corners(kept.clone())).at(now));
        }
    }
}
