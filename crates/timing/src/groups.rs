//! Groups: devices that never measure at the same time get start times that always keep them apart.
//!
//! Two devices with fixed periods meet again at the same offset after the greatest common divisor
//! of their periods, so it is enough that their measurements do not touch within it. Devices are
//! placed in file order, each as early as possible.

use std::collections::BTreeMap;

use sensedsl_model::design::{Design, Device, DeviceIndex};
use sensedsl_wiring::assignment::BoardAssignment;

/// Milliseconds after the board's start at which each device begins; 0 for devices that are not
/// listed.
pub type Starts = BTreeMap<DeviceIndex, u32>;

/// The times at which a device of a group measures.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Turn {
    /// The group.
    pub group: String,
    /// The device.
    pub device: DeviceIndex,
    /// The first measurement, in milliseconds after the board's start.
    pub start_ms: u32,
    /// The time from one measurement to the next.
    pub period_ms: u32,
    /// The duration of a measurement.
    pub measuring_ms: u32,
    /// True if another device of the group measures at the same time, because there is no time for
    /// turns.
    pub overlaps: bool,
}

/// Most places tried for a device: more than there can be devices, even if each is moved past
/// several times.
const TRIES_MAX: usize = 4_096;

/// The start times of all devices of a board.
#[must_use]
pub fn starts(design: &Design, wiring: &BoardAssignment) -> Starts {
    turns(design, wiring).into_iter().map(|turn| (turn.device, turn.start_ms)).collect()
}

/// The turns of the groups on a board, in file order.
pub(crate) fn turns(design: &Design, wiring: &BoardAssignment) -> Vec<Turn> {
    let mut turns: Vec<Turn> = Vec::new();
    for index in wiring.devices.iter().map(|wiring| wiring.device) {
        let Some(device) = design.device(index) else { continue };
        let (Some(group), Some(period_ms)) = (&device.group, period_ms(device)) else { continue };
        let mut turn = Turn {
            group: group.name.clone(),
            device: index,
            start_ms: 0,
            period_ms,
            measuring_ms: device.turn_ms(),
            overlaps: false,
        };
        let others = || turns.iter().filter(|other| other.group == turn.group);
        match place(&turn, others) {
            Some(start_ms) => turn.start_ms = start_ms,
            None => turn.overlaps = true,
        }
        // An array has its own turns, and needs a cycle that is long enough.
        turn.overlaps |= device.value.value.length > Some(1) && turn.measuring_ms > period_ms;
        turns.push(turn);
    }
    turns
}

/// The time from one measurement to the next, for a device that measures on demand.
fn period_ms(device: &Device) -> Option<u32> {
    let kind = &device.kind;
    let is_asked = kind.i2c().is_some() || kind.onewire().is_some() || kind.pulse_us().is_some();
    device.measured_every_ms().filter(|_| is_asked)
}

/// The earliest start that does not collide with any other device.
fn place<'t, I: Iterator<Item = &'t Turn>>(turn: &Turn, others: impl Fn() -> I) -> Option<u32> {
    let mut start_ms = 0_u32;
    for _ in 0..TRIES_MAX {
        let later = others().find_map(|other| clear_of(turn, start_ms, other).err());
        match later {
            None => return Some(start_ms),
            Some(wait_ms) => start_ms = start_ms.checked_add(wait_ms?)?,
        }
        if start_ms >= turn.period_ms {
            return None;
        }
    }
    None
}

/// Whether a start does not collide with another device; if it does, how much later it must be, if
/// that helps.
fn clear_of(turn: &Turn, start_ms: u32, other: &Turn) -> Result<(), Option<u32>> {
    let common = gcd(turn.period_ms, other.period_ms);
    if turn.measuring_ms.checked_add(other.measuring_ms).is_none_or(|both| both > common) {
        return Err(None);
    }
    let behind = (start_ms % common + common - other.start_ms % common) % common;
    if behind < other.measuring_ms {
        return Err(Some(other.measuring_ms - behind));
    }
    let ahead = common - behind;
    if ahead < turn.measuring_ms {
        return Err(Some(ahead + other.measuring_ms));
    }
    Ok(())
}

fn gcd(a: u32, b: u32) -> u32 {
    let (mut a, mut b) = (a.max(1), b.max(1));
    while b > 0 {
        (a, b) = (b, a % b);
    }
    a
}

#[cfg(test)]
mod tests {
    use super::*;

    fn turn(device: usize, start_ms: u32, period_ms: u32, measuring_ms: u32) -> Turn {
        let (device, group) = (DeviceIndex(device), String::new());
        Turn { group, device, start_ms, period_ms, measuring_ms, overlaps: false }
    }

    /// Whether two devices ever measure at the same time, by checking every millisecond.
    fn meet(one: &Turn, other: &Turn) -> bool {
        let measures = |turn: &Turn, at: u32| {
            at >= turn.start_ms && (at - turn.start_ms) % turn.period_ms < turn.measuring_ms
        };
        let end = one.period_ms * other.period_ms + one.start_ms + other.start_ms;
        (0..end).any(|at| measures(one, at) && measures(other, at))
    }

    #[test]
    fn no_two_devices_of_a_group_ever_measure_together() {
        for periods in [[200, 200, 200], [80, 160, 240], [60, 90, 120], [70, 70, 70], [50, 75, 500]]
        {
            for measuring in [[10, 10, 10], [30, 20, 5], [66, 66, 66], [1, 24, 40]] {
                let mut placed: Vec<Turn> = Vec::new();
                for (at, (period, measuring)) in periods.into_iter().zip(measuring).enumerate() {
                    let mut next = turn(at, 0, period, measuring);
                    let Some(start_ms) = place(&next, || placed.iter()) else { continue };
                    next.start_ms = start_ms;
                    let others: Vec<&Turn> = placed.iter().collect();
                    assert!(others.iter().all(|other| !meet(&next, other)), "{next:?} {placed:?}");
                    placed.push(next);
                }
            }
        }
    }

    #[test]
    fn turns_follow_each_other_at_once() {
        let first = turn(0, 0, 200, 66);
        let second = turn(1, 66, 200, 66);
        let start = |others: &[Turn]| place(&turn(9, 0, 200, 66), || others.iter());
        assert_eq!(start(std::slice::from_ref(&first)), Some(66));
        assert_eq!(start(&[first.clone(), second.clone()]), Some(132));
        assert_eq!(start(&[first, second, turn(2, 132, 200, 66)]), None);
    }
}
