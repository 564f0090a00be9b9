//! Dividers: which clock results from another, and how near it is to the requested one.

use sensedsl_board::profile::{Adcs, Cycles, Dividers, TargetProfile, Timer, Unit};

use crate::context::Context;

/// The greatest prescaler of a timer, which has 16 bits.
pub(crate) const PRESCALER_MAX: u32 = 65_536;

/// The requested tick of a timer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Tick {
    /// The timer's clock.
    pub clock_hz: u32,
    /// Ticks per second.
    pub tick_hz: u32,
}

impl Tick {
    /// Whether the prescaler can produce it without remainder.
    #[must_use]
    pub fn is_possible(self) -> bool {
        let divides = self.clock_hz.checked_rem(self.tick_hz) == Some(0);
        divides && self.clock_hz / self.tick_hz <= PRESCALER_MAX
    }

    /// The tick that is used: the exact one if the prescaler can produce it, otherwise the nearest
    /// within a thousandth. The drivers take only whole numbers of ticks per second.
    #[must_use]
    pub fn made(self) -> Option<u32> {
        if self.is_possible() {
            return Some(self.tick_hz);
        }
        self.nearest().filter(|hz| hz.abs_diff(self.tick_hz) <= self.tick_hz / TICK_PARTS)
    }

    /// The possible tick nearest to this one.
    #[must_use]
    pub fn nearest(self) -> Option<u32> {
        let clock_hz = self.clock_hz;
        // Each divisor of the clock comes with its quotient.
        let pairs = (1..=PRESCALER_MAX).filter(|divider| clock_hz.is_multiple_of(*divider));
        pairs
            .map(|divider| clock_hz / divider)
            .min_by_key(|hz| (hz.abs_diff(self.tick_hz), u32::MAX - hz))
    }
}

/// A tick may be off by one part in this many: clocks such as 79.96 MHz do not have an exact one.
const TICK_PARTS: u32 = 1_000;

/// The sampling time that a device gets: at least as long as requested, because too short a time
/// spoils the reading; none if the converter has none that long.
#[must_use]
pub fn sampling(facts: &Adcs, asked: Option<u16>) -> Option<Cycles> {
    let asked = asked.map_or(facts.sample_cycles_default, |asked| Cycles::new(asked.into()));
    facts.sample_cycles.iter().copied().find(|cycles| *cycles >= asked)
}

/// The clock of a board's converters.
pub(crate) fn converter_hz(context: &Context<'_>) -> Option<u32> {
    let facts = &context.board.profile()?.adc;
    context.clock_hz(facts.clock.as_deref()?)?.checked_div(facts.clock_divider)
}

/// The clock that drives a timer.
pub(crate) fn timer_hz(context: &Context<'_>, timer: &Timer) -> Option<u32> {
    context.clock_hz(&timer.clock)
}

/// The clock that drives a unit.
pub(crate) fn unit_hz(context: &Context<'_>, unit: &Unit) -> Option<u32> {
    context.clock_hz(unit.clock.as_deref()?)
}

/// The divider for the fastest clock not above the requested one; none if all are above it.
fn divider_at_most(dividers: &Dividers, unit_hz: u32, asked_hz: u32) -> Option<u32> {
    let [least, greatest] = dividers.range;
    let wanted = unit_hz.div_ceil(asked_hz.max(1)).max(least);
    let divider = if dividers.powers_of_two { wanted.next_power_of_two() } else { wanted };
    (divider <= greatest).then_some(divider)
}

/// The fastest clock not above the requested one; none if all are above it.
pub(crate) fn at_most(dividers: &Dividers, unit_hz: u32, asked_hz: u32) -> Option<u32> {
    divider_at_most(dividers, unit_hz, asked_hz).map(|divider| unit_hz / divider)
}

/// The divider of an SPI unit's clock that is slow enough for a device; none if the unit cannot go
/// that slow.
#[must_use]
pub fn spi_divider(profile: &TargetProfile, unit_hz: u32, asked_hz: u32) -> Option<u32> {
    divider_at_most(profile.spi_dividers.as_ref()?, unit_hz, asked_hz)
        .filter(|divider| *divider > 0)
}

/// How often a divider, which is a power of two, halves a clock.
#[must_use]
pub const fn power_of_two(divider: u32) -> u32 {
    divider.trailing_zeros()
}

/// The slowest clock.
pub(crate) fn slowest_hz(dividers: &Dividers, unit_hz: u32) -> u32 {
    unit_hz.div_ceil(dividers.range[1].max(1))
}

/// The clock nearest to the requested one, with a divider and a number of steps per bit.
pub(crate) fn nearest(dividers: &Dividers, unit_hz: u32, asked_hz: u32) -> Option<u32> {
    let ([least, greatest], [few, many]) = (dividers.range, dividers.steps);
    let of_steps = (few..=many).filter_map(|steps| {
        let step_hz = asked_hz.checked_mul(steps)?;
        let divider = (unit_hz + step_hz / 2).checked_div(step_hz)?.clamp(least, greatest);
        let clocks = divider.checked_mul(steps)?;
        unit_hz.checked_add(clocks / 2)?.checked_div(clocks)
    });
    of_steps.min_by_key(|hz| hz.abs_diff(asked_hz))
}

/// How far one clock is from another, in parts per million of the other.
pub(crate) fn off_ppm(hz: u32, asked_hz: u32) -> u64 {
    u64::from(hz.abs_diff(asked_hz)) * 1_000_000 / u64::from(asked_hz).max(1)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn dividers(range: [u32; 2], powers_of_two: bool, steps: [u32; 2]) -> Dividers {
        Dividers { range, powers_of_two, steps, source: String::new() }
    }

    #[test]
    fn a_serial_port_gets_the_nearest_rate() {
        let serial = dividers([16, 65_535], false, [1, 1]);
        assert_eq!(nearest(&serial, 42_000_000, 115_200), Some(115_068));
        assert_eq!(nearest(&serial, 42_000_000, 10_000_000), Some(2_625_000));
        assert_eq!(nearest(&serial, 42_000_000, 300), Some(641));
    }

    #[test]
    fn spi_halves_until_the_device_can_follow() {
        let spi = dividers([2, 256], true, [1, 1]);
        assert_eq!(at_most(&spi, 84_000_000, 100_000_000), Some(42_000_000));
        assert_eq!(at_most(&spi, 84_000_000, 1_000_000), Some(656_250));
        assert_eq!(at_most(&spi, 84_000_000, 328_125), Some(328_125));
        assert_eq!(at_most(&spi, 84_000_000, 328_124), None);
        assert_eq!(slowest_hz(&spi, 84_000_000), 328_125);
    }

    #[test]
    fn a_tick_divides_the_timers_clock() {
        let tick = |tick_hz| Tick { clock_hz: 84_000_000, tick_hz };
        assert!(tick(1_000_000).is_possible() && tick(84_000_000).is_possible());
        assert!(!tick(13_000).is_possible() && !tick(1_000).is_possible());
        assert_eq!(tick(13_000).nearest(), Some(13_125));
        assert_eq!(tick(1).nearest(), Some(1_344));
        assert_eq!(tick(100_000_000).nearest(), Some(84_000_000));
    }
}
