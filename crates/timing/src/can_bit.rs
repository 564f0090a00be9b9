//! The bit of a CAN bus: the divider of the unit's clock, and the steps before and after the sample
//! point.

use sensedsl_board::profile::Dividers;

/// Most steps before the sample point, besides the first step, which every bit has.
const BEFORE_MAX: u32 = 16;
/// Most steps after the sample point.
const BEHIND_MAX: u32 = 8;
/// The earliest sample point, in thousandths of the bit; an earlier one leaves too little time for
/// the propagation delay.
const SAMPLE_MIN: u32 = 770;
/// The largest resynchronization jump, in steps.
const JUMP_MAX: u32 = 4;

/// The parts of a bit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CanBit {
    /// Clocks of the unit per step.
    pub divider: u32,
    /// Steps before the sample point, besides the first.
    pub before: u32,
    /// Steps after the sample point.
    pub behind: u32,
}

impl CanBit {
    /// Steps in the bit.
    #[must_use]
    pub const fn steps(self) -> u32 {
        1 + self.before + self.behind
    }

    /// The resynchronization jump, in steps.
    #[must_use]
    pub fn jump(self) -> u32 {
        self.behind.min(JUMP_MAX)
    }

    /// The bit rate that results from the unit's clock, to the nearest hertz.
    #[must_use]
    pub fn rate_hz(self, unit_hz: u32) -> Option<u32> {
        let clocks = self.divider.checked_mul(self.steps())?;
        unit_hz.checked_add(clocks / 2)?.checked_div(clocks)
    }

    /// The sample point, in thousandths of the bit.
    fn sample(self) -> u32 {
        (1 + self.before) * 1_000 / self.steps()
    }
}

/// The bit whose rate is nearest to `asked_hz`; of equal ones, the one whose sample point is
/// nearest to 87.5 %, then the one with the finest steps. `None` if the dividers allow none.
#[must_use]
pub fn can_bit(dividers: &Dividers, unit_hz: u32, asked_hz: u32) -> Option<CanBit> {
    let ([least, greatest], [few, many]) = (dividers.range, dividers.steps);
    let bits = (few..=many).filter_map(|steps| {
        let step_hz = asked_hz.checked_mul(steps)?;
        let divider = unit_hz.checked_add(step_hz / 2)?.checked_div(step_hz)?;
        let before = (steps * 7 / 8).checked_sub(1)?.min(BEFORE_MAX);
        let behind = steps.checked_sub(1 + before)?;
        let bit = CanBit { divider: divider.clamp(least, greatest), before, behind };
        let is_made = (1..=BEHIND_MAX).contains(&behind) && bit.sample() >= SAMPLE_MIN;
        is_made.then_some((bit.rate_hz(unit_hz)?, bit))
    });
    let best = bits.min_by_key(|(hz, bit)| {
        (hz.abs_diff(asked_hz), bit.sample().abs_diff(875), u32::MAX - bit.steps())
    });
    best.map(|(_, bit)| bit)
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test may panic")]
mod tests {
    use super::*;

    fn dividers(greatest: u32) -> Dividers {
        Dividers {
            range: [1, greatest],
            powers_of_two: false,
            steps: [8, 25],
            source: String::new(),
        }
    }

    #[test]
    fn a_bit_has_whole_steps() {
        let rate = |asked| can_bit(&dividers(1024), 42_000_000, asked)?.rate_hz(42_000_000);
        for exact in [10_000, 125_000, 250_000, 500_000, 1_000_000] {
            assert_eq!(rate(exact), Some(exact));
        }
        assert_eq!(rate(800_000), Some(807_692));
    }

    /// The controller clocks that firmware sets, with the usual bit rates.
    #[test]
    fn usual_rates_are_made_of_usual_clocks() {
        for unit_hz in [24, 36, 40, 42, 45, 48, 50, 54, 64, 80, 170].map(|mhz| mhz * 1_000_000) {
            for asked in [125_000, 250_000, 500_000, 1_000_000] {
                let bit = can_bit(&dividers(511), unit_hz, asked).unwrap();
                assert_eq!(bit.rate_hz(unit_hz), Some(asked), "{unit_hz} {bit:?}");
                assert!((770..=900).contains(&bit.sample()) && bit.jump() >= 1, "{bit:?}");
            }
        }
        let bit = can_bit(&dividers(511), 48_000_000, 500_000).unwrap();
        assert_eq!(bit, CanBit { divider: 6, before: 13, behind: 2 });
    }

    #[test]
    fn a_rate_out_of_reach_is_the_nearest() {
        let slow = can_bit(&dividers(511), 170_000_000, 1_000).unwrap();
        assert_eq!(slow.divider, 511);
        assert!(slow.rate_hz(170_000_000).unwrap() > 10_000);
        let fast = can_bit(&dividers(511), 4_000_000, 1_000_000).unwrap();
        assert_eq!(fast.rate_hz(4_000_000), Some(500_000));
    }
}
