//! From the value of a PWM output to its pulse width: servos, speed controllers, duty cycle.
//!
//! A value goes from 0 (the shortest pulse) to 10000 (the longest); values beyond saturate.

use crate::convert::load_magnitude;
use crate::scalar::Scalar;

/// The value of the longest pulse.
pub const LEVEL_FULL: u32 = 10_000;

/// The pulses of an output.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PulseWidth {
    /// The pulse at 0.
    pub least_ticks: u16,
    /// The pulse at 10000.
    pub greatest_ticks: u16,
}

impl PulseWidth {
    /// The width of a pulse, rounded.
    #[must_use]
    pub const fn ticks(&self, level: u32) -> u16 {
        let span = self.greatest_ticks.abs_diff(self.least_ticks) as u32;
        let level = if level > LEVEL_FULL { LEVEL_FULL } else { level };
        let share = ((span * level + LEVEL_FULL / 2) / LEVEL_FULL) as u16;
        if self.greatest_ticks > self.least_ticks {
            self.least_ticks.wrapping_add(share)
        } else {
            self.least_ticks.wrapping_sub(share)
        }
    }
}

/// The part of a timer's `counts` that the pulse of a level takes, rounded, from the least to the greatest of `[least,
/// greatest, period]` in any unit. A pulse as long as the period takes all of them.
#[must_use]
pub fn pulse_counts(counts: u32, [least, greatest, period]: [u32; 3], level: u32) -> u32 {
    let (full, level) = (u64::from(LEVEL_FULL), u64::from(level.min(LEVEL_FULL)));
    let width = u64::from(least) * (full - level) + u64::from(greatest) * level;
    let whole = u64::from(period.max(1)) * full;
    if width >= whole {
        return counts;
    }
    // At most `counts`, as the width is less than the whole.
    ((u64::from(counts) * width + whole / 2) / whole) as u32
}

/// The value of one element, rounded, 0 to 10000. Negative numbers and NaN are 0.
#[must_use]
pub fn pulse_level(scalar: Scalar, element: &[u8]) -> u32 {
    let (level, is_negative) = load_magnitude(scalar, element);
    if is_negative { 0 } else { level.min(u64::from(LEVEL_FULL)) as u32 }
}

#[cfg(test)]
mod tests {
    use super::{LEVEL_FULL, pulse_counts};

    #[test]
    fn pulses_are_parts_of_a_period() {
        let servo = [1_000, 2_000, 20_000];
        for (level, expected) in
            [(0, 1_000), (5_000, 1_500), (LEVEL_FULL, 2_000), (u32::MAX, 2_000)]
        {
            assert_eq!(pulse_counts(20_000, servo, level), expected, "{level}");
        }
        assert_eq!(pulse_counts(100, [0, 3, 3], LEVEL_FULL), 100);
        assert_eq!(pulse_counts(100, [0, 3, 3], 1_249), 12);
        assert_eq!(pulse_counts(100, [0, 3, 3], 1_250), 13);
        assert_eq!(pulse_counts(u32::MAX, [0, 1, 1], 9_999), 4_294_537_798);
    }
}
