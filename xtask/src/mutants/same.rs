//! Whether two runs of a design's programs show the same to hosts and parts, though not at the same nanosecond.
//!
//! A mistake that changes how long a start takes, or where a table is, shifts everything by some microseconds, but
//! changes no behaviour. So the output of the MCU must be the same on each pad and bus, in the same order and at nearly
//! the same times. The values that the host receives from each device must be the same, one after another, except for
//! the difference that so small a shift of a measurement can cause.

use std::collections::BTreeMap;
use std::path::Path;

use anyhow::{Context as _, Result};
use sensedsl_job::jobs;
use sensedsl_model::NoFiles;
use sensedsl_session::{Ask, On, Workspace};
use sensedsl_wire::{Decoder, DeviceHealth, Direction, Event, Scalar, Schema};

/// The greatest time between the same events in two runs.
const APART_NS: u64 = 200_000;
/// The greatest difference of a value, as a fraction of the largest one: it was measured at another moment.
const SHARE: f64 = 0.001;

/// The results of a run: the bytes on the link, and the output of the MCU with its times.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Seen {
    pub(super) frames: Vec<u8>,
    pub(super) wires: String,
}

/// The host's view of the bytes.
#[derive(Default)]
struct Heard {
    values: BTreeMap<u8, Vec<Vec<f64>>>,
    devices: Vec<DeviceHealth>,
    hellos: usize,
}

/// The schema of the link of a design's first board.
pub(super) fn schema(design: &Path, target: &str) -> Result<Schema> {
    let text = std::fs::read_to_string(design)?;
    let mut workspace = Workspace::default();
    workspace.open("board.sense", &text);
    let on = On { board: None, target: Some(target) };
    let snapshot = workspace.snapshot("board.sense", on, &NoFiles);
    let answer = snapshot.solve(&Ask::default());
    let (design, wiring) = answer.wired().context("the design has no wiring")?;
    Ok(jobs(design, wiring).next().context("the design has no board")?.schema)
}

/// The first difference; `None` if host and parts see the same.
pub(super) fn differ(schema: &Schema, one: &Seen, other: &Seen) -> Option<String> {
    if one == other {
        return None;
    }
    wires_differ(&one.wires, &other.wires).or_else(|| {
        let [one, other] = [one, other].map(|seen| received(schema, &seen.frames));
        heard_differ(schema, &one, &other)
    })
}

/// The events at each place, with their times.
fn places(text: &str) -> BTreeMap<&str, Vec<(u64, &str)>> {
    let mut places: BTreeMap<&str, Vec<(u64, &str)>> = BTreeMap::new();
    for line in text.lines() {
        let mut cells = line.splitn(3, ',');
        let time = cells.next().and_then(|time| time.parse().ok());
        if let (Some(at_ns), Some(place), Some(what)) = (time, cells.next(), cells.next()) {
            places.entry(place).or_default().push((at_ns, what));
        }
    }
    places
}

fn wires_differ(one: &str, other: &str) -> Option<String> {
    let [ones, others] = [one, other].map(places);
    let last = |all: &BTreeMap<&str, Vec<(u64, &str)>>| {
        all.values().filter_map(|lines| lines.last().map(|line| line.0)).max().unwrap_or(0)
    };
    let end_ns = last(&ones).max(last(&others)).saturating_sub(APART_NS);
    let empty = Vec::new();
    ones.keys().chain(others.keys()).find_map(|place| {
        let [one, other] = [&ones, &others].map(|all| all.get(place).unwrap_or(&empty));
        let is_same = |(one, other): &(&(u64, &str), &(u64, &str))| {
            one.1 == other.1 && one.0.abs_diff(other.0) <= APART_NS
        };
        let pairs = one.iter().zip(other);
        let common = pairs.take_while(is_same).count();
        let rest = [one, other].map(|all| all.get(common).copied());
        let is_over = rest.iter().flatten().all(|(at_ns, _)| *at_ns >= end_ns);
        (!is_over).then(|| {
            let [was, is] = rest.map(|line| {
                line.map_or_else(
                    || "nothing".to_owned(),
                    |(at_ns, what)| format!("{what} at {at_ns}"),
                )
            });
            format!("{place}: {was}, and {is}")
        })
    })
}

fn received(schema: &Schema, bytes: &[u8]) -> Heard {
    let mut received = Heard::default();
    Decoder::new(schema, Direction::Sensor).feed(bytes, |event| match event {
        Event::Report(_, values) => {
            for (id, elements) in values {
                let value = elements.iter().map(number).collect();
                received.values.entry(id).or_default().push(value);
            }
        }
        Event::Hello(_) => received.hellos += 1,
        Event::Health(health) => received.devices = health.devices,
        Event::OtherHealth(_) | Event::HelloRequest | Event::HealthRequest => {}
    });
    received
}

#[expect(clippy::cast_precision_loss, reason = "it is compared with a tolerance")]
fn number(of: &Scalar) -> f64 {
    match *of {
        Scalar::Bool(value) => f64::from(u8::from(value)),
        Scalar::Unsigned(value) => value as f64,
        Scalar::Signed(value) => value as f64,
        Scalar::Float32(value) => value.into(),
        Scalar::Float64(value) => value,
    }
}

fn heard_differ(schema: &Schema, one: &Heard, other: &Heard) -> Option<String> {
    if one.hellos != other.hellos {
        return Some(format!("{} greetings, and {}", one.hellos, other.hellos));
    }
    let healths = one.devices.iter().zip(&other.devices);
    let is_other = |(one, other): &(&DeviceHealth, &DeviceHealth)| {
        (one.status, one.causes) != (other.status, other.causes)
    };
    if one.devices.len() != other.devices.len() {
        return Some("the board does not say how its devices are in both".to_owned());
    }
    if let Some((one, other)) = healths.into_iter().find(is_other) {
        return Some(format!("health: {one:?}, and {other:?}"));
    }
    schema.items.iter().find_map(|item| {
        let empty = Vec::new();
        let [one, other] =
            [one, other].map(|received| received.values.get(&item.id).unwrap_or(&empty));
        values_differ(one, other).map(|what| format!("{}: {what}", item.name))
    })
}

/// A difference of one report comes from the end of the run.
fn values_differ(one: &[Vec<f64>], other: &[Vec<f64>]) -> Option<String> {
    if one.len().abs_diff(other.len()) > 1 {
        return Some(format!("{} values, and {}", one.len(), other.len()));
    }
    let greatest = one.iter().flatten().fold(0.0_f64, |most, value| most.max(value.abs()));
    let step = if greatest > 2.0 { 1.0 } else { 0.0 };
    let tolerance = (greatest * SHARE).max(step);
    one.iter().zip(other).find_map(|(one, other)| {
        let is_near = one.len() == other.len()
            && one.iter().zip(other).all(|(one, other)| {
                (one - other).abs() <= tolerance || (one.is_nan() && other.is_nan())
            });
        (!is_near).then(|| format!("{one:?}, and {other:?}"))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const RIGHT: &str = "time_ns,place,what\n1000000,PA1,high\n2000000,PA1,low\n2000000,I2C1,stop\n900000000,PA1,high\n";

    #[test]
    fn what_is_moved_by_little_is_the_same_and_nothing_else() {
        assert_eq!(wires_differ(RIGHT, &RIGHT.replace("1000000,PA1", "1150000,PA1")), None);
        for (from, to) in [
            ("1000000,PA1", "1250000,PA1"),
            ("PA1,low", "PA1,high"),
            ("2000000,I2C1,stop\n", ""),
            ("2000000,I2C1", "2000000,I2C2"),
        ] {
            let other = RIGHT.replace(from, to);
            assert!(wires_differ(RIGHT, &other).is_some(), "{other}");
            assert!(wires_differ(&other, RIGHT).is_some(), "{other}");
        }
        // The run ended between the two.
        assert_eq!(wires_differ(RIGHT, &format!("{RIGHT}900100000,PA1,low\n")), None);
    }

    #[test]
    fn values_are_compared_one_after_the_other() {
        let right = [vec![1_000.0], vec![2_000.0], vec![3_000.0]];
        assert_eq!(values_differ(&right, &[vec![1_001.0], vec![2_003.0], vec![3_000.0]]), None);
        assert_eq!(values_differ(&right, &right[..2]), None);
        for wrong in [[2_000.0, 1_000.0, 3_000.0], [1_000.0, 2_010.0, 3_000.0]] {
            assert!(values_differ(&right, &wrong.map(|one| vec![one])).is_some(), "{wrong:?}");
        }
        assert!(values_differ(&right, &right[..1]).is_some());
        let switch = [vec![0.0], vec![1.0]];
        assert!(values_differ(&switch, &[vec![1.0], vec![1.0]]).is_some());
    }
}
