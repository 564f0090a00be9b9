//! The values that a host sets actuators to, chosen so that every mistake shows: both ends, the middle, both signs,
//! values out of range, and a different value for each element and each device.

use sensedsl_job::{BoardJob, JobDevice};
use sensedsl_model::kind::Interface;
use sensedsl_model::kind::encoding::Encoding;
use sensedsl_model::kind::stepper::{Mode, Stepper};
use sensedsl_model::words::Words;
use sensedsl_wire::{Direction, Scalar, ScalarType};

use super::expect::{FULL_CODE, FULL_LEVEL};
use crate::arith::number;
use crate::parts::words;
use crate::truth::scalar;

/// For 64-bit integers, the numbers that a double holds exactly are enough.
const WHOLE_MAX: f64 = 9_007_199_254_740_991.0;
/// How far a motor goes, in seconds of its greatest speed.
const FAR_SECONDS: f64 = 0.12;
/// The codes of letters.
const LETTERS: (f64, f64) = (32.0, 126.0);
/// The bound for real numbers that have none.
const REAL_MAX: f64 = 1_000.0;

/// The values of every actuator of a board, in the order of its devices: steps, and in each a value for each element.
pub(super) fn usual(job: &BoardJob<'_>) -> Vec<(usize, Vec<Vec<Scalar>>)> {
    // What code sets, the host does not; and other parameters would be another robot's.
    let owned = |index: usize| job.controllers.iter().any(|one| one.sets.contains(&index));
    let actuators = job.devices.iter().enumerate();
    let actuators = actuators.filter(|(index, one)| {
        let is_free = !owned(*index) && one.device.kind.code().is_none();
        one.device.direction == Direction::Actuator && is_free
    });
    let actuators: Vec<(usize, &JobDevice<'_>)> = actuators.collect();
    let count = |(_, one): &(usize, &JobDevice<'_>)| one.device.value.value.count();
    let total: usize = actuators.iter().filter(|one| is_switch(one.1)).map(count).sum();
    let (mut first, mut turn) = (0, 0);
    let mut all = Vec::new();
    for (index, one) in actuators {
        let elements = one.device.value.value.count();
        if is_switch(one) {
            all.push((index, switches(one, first, total)));
            first += elements;
        } else {
            all.push((index, numbers(one, turn)));
        }
        turn += elements;
    }
    all
}

/// Whether a value is only on or off.
fn is_switch(one: &JobDevice<'_>) -> bool {
    one.device.kind.is_level() || one.device.value.value.scalar == ScalarType::Bool
}

/// Each switch of the board has its own code word and shows the bits of it one after another, each followed by its
/// opposite. So any two switches differ in some step, and each of them is both on and off.
fn switches(one: &JobDevice<'_>, first: usize, total: usize) -> Vec<Vec<Scalar>> {
    let of = one.device.value.value.scalar;
    let bits = usize::BITS - (total + 1).leading_zeros();
    let most = of.integer_range().map_or(1.0, |(_, most)| whole(most));
    let step = |step: u32| {
        let element = |element: usize| {
            let word = first + element + 1;
            let is_on = ((word >> (step / 2)) & 1 == 1) != (step % 2 == 1);
            // Any value but 0 is on.
            scalar(
                of,
                if !is_on {
                    0.0
                } else if step < 2 {
                    1.0
                } else {
                    most
                },
            )
        };
        (0..one.device.value.value.count()).map(element).collect()
    };
    (0..2 * bits.max(2)).map(step).collect()
}

/// The ends, the middle and values out of range. Each element starts at another place of the list, and its values
/// between the ends are its own.
fn numbers(one: &JobDevice<'_>, turn: usize) -> Vec<Vec<Scalar>> {
    let of = one.device.value.value.scalar;
    let (low, high) = range(one);
    let span = high - low;
    let held = of.integer_range().map(|(least, most)| (whole(least), whole(most)));
    let held = held.unwrap_or((low - span, high + span));
    let beyond = [(high + span / 4.0).min(held.1), (low - span / 4.0).max(held.0)];
    let element = |element: usize| {
        let own = number(u64::try_from((turn + element) % 23).unwrap_or(0)) / 100.0;
        let between = |share: f64| low + span * (share - own / 4.0);
        let mut list = vec![high, low, between(0.75), between(0.30), beyond[0], between(0.55)];
        if low < 0.0 {
            list.push(low / 4.0 * (1.0 + own));
        }
        if beyond[1] < low {
            list.push(beyond[1]);
        }
        list
    };
    let lists: Vec<Vec<f64>> = (0..one.device.value.value.count()).map(element).collect();
    let steps = lists.first().map_or(0, Vec::len);
    let step = |step: usize| {
        let value = |(place, list): (usize, &Vec<f64>)| {
            let at = (step + place) % list.len().max(1);
            scalar(of, list.get(at).copied().unwrap_or(0.0))
        };
        lists.iter().enumerate().map(value).collect()
    };
    (0..steps).map(step).collect()
}

/// The least and the greatest raw value that the output can follow and that the type holds.
pub(super) fn range(one: &JobDevice<'_>) -> (f64, f64) {
    let own = match one.device.kind.interface() {
        Interface::Pwm(_) if one.device.coding.drive.is_some() => Some((-FULL_LEVEL, FULL_LEVEL)),
        Interface::Pwm(_) => Some((0.0, FULL_LEVEL)),
        Interface::Dac(_) => Some((0.0, FULL_CODE)),
        Interface::Stepper(own) => Some(of_motor(own)),
        Interface::I2c(own) if own.encoding == Encoding::Text => Some(LETTERS),
        Interface::Analog(_)
        | Interface::I2c(_)
        | Interface::Icu(_)
        | Interface::Encoder(_)
        | Interface::Digital(_)
        | Interface::Uart(_)
        | Interface::Spi(_)
        | Interface::OneWire(_)
        | Interface::Can(_)
        | Interface::Code(_) => Words::of(one.device).as_ref().and_then(words::range),
    };
    let held = one.device.value.value.scalar.integer_range();
    let held = held.map(|(least, most)| (whole(least), whole(most)));
    let (low, high) = match (own, held) {
        (Some(one), Some(other)) => (one.0.max(other.0), one.1.min(other.1)),
        (one, other) => one.or(other).unwrap_or((-REAL_MAX, REAL_MAX)),
    };
    (low.max(-WHOLE_MAX), high.min(WHOLE_MAX))
}

/// As far as the greatest speed goes in a while, to either side; or that speed.
fn of_motor(own: &Stepper) -> (f64, f64) {
    let speed = f64::from(own.speed);
    let far = match own.mode {
        Mode::Position => (speed * FAR_SECONDS).round().max(4.0),
        Mode::Velocity => speed,
    };
    (-far, far)
}

#[expect(clippy::cast_precision_loss, reason = "the ends of 64 bits are rounded")]
fn whole(number: i128) -> f64 {
    (number as f64).clamp(-WHOLE_MAX, WHOLE_MAX)
}
