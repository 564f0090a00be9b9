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

/// The value of one element, rounded, 0 to 10000. Negative numbers and NaN are 0.
#[must_use]
pub fn pulse_level(scalar: Scalar, element: &[u8]) -> u32 {
    let (level, is_negative) = load_magnitude(scalar, element);
    if is_negative { 0 } else { level.min(u64::from(LEVEL_FULL)) as u32 }
}
