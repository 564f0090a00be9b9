//! How a timer makes a frequency: the divider of its clock and the ticks of a period.
//!
//! In: the clock and the frequency. Out: the tick with the best resolution whose period fits 16 bits. The system's
//! driver accepts only a whole number of ticks per second, so the divider must divide the clock.

/// The longest period: one tick less than a 16-bit counter has, so that a pulse can fill it.
const PERIOD_MAX: u32 = 65_535;

/// The greatest divider of a timer's clock.
const DIVIDER_MAX: u32 = 65_536;

/// How many times coarser a tick may be if that makes the period exact.
const COARSER: u32 = 4;

/// The tick and the period of a timer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Rate {
    pub(super) tick_hz: u32,
    pub(super) period_ticks: u32,
}

impl Rate {
    /// `None` if no divider of the clock fits.
    pub(super) fn new(clock_hz: u32, frequency_hz: u32) -> Option<Self> {
        let ticks = |divider: u32| {
            let tick_hz = clock_hz / divider;
            let period_ticks = tick_hz.checked_add(frequency_hz / 2)? / frequency_hz.max(1);
            let fits = (2..=PERIOD_MAX).contains(&period_ticks);
            fits.then_some(Self { tick_hz, period_ticks })
        };
        let dividers = (1..=DIVIDER_MAX).filter(|divider| clock_hz.is_multiple_of(*divider));
        let mut rates = dividers.filter_map(ticks);
        let finest = rates.next()?;
        let near = rates.take_while(|rate| rate.tick_hz >= finest.tick_hz / COARSER);
        let is_exact = |rate: &Self| rate.tick_hz.is_multiple_of(frequency_hz.max(1));
        Some(std::iter::once(finest).chain(near).find(is_exact).unwrap_or(finest))
    }

    /// The number of ticks nearest to a pulse, at most the period.
    pub(super) fn ticks(self, pulse_us: u32) -> u32 {
        let ticks = (u64::from(pulse_us) * u64::from(self.tick_hz) + 500_000) / 1_000_000;
        u32::try_from(ticks).unwrap_or(u32::MAX).min(self.period_ticks)
    }
}

#[cfg(test)]
mod tests {
    use super::Rate;

    #[test]
    fn the_tick_is_the_finest_with_which_the_period_is_exact_and_fits() {
        let cases = [
            (84_000_000, 50, 3_000_000, 60_000),
            (168_000_000, 20_000, 168_000_000, 8_400),
            (72_000_000, 50, 3_000_000, 60_000),
            (48_000_000, 400, 24_000_000, 60_000),
            (170_000_000, 1, 62_500, 62_500),
            (8_000_000, 1_000_000, 8_000_000, 8),
            (84_000_000, 65, 4_200_000, 64_615),
        ];
        for (clock_hz, frequency_hz, tick_hz, period_ticks) in cases {
            let rate = Rate::new(clock_hz, frequency_hz);
            assert_eq!(rate, Some(Rate { tick_hz, period_ticks }), "{clock_hz} {frequency_hz}");
        }
    }

    #[test]
    fn every_rate_fits_the_timer() {
        for clock_hz in [8_000_000, 32_000_000, 36_000_000, 79_960_000, 84_000_000, 216_000_000] {
            for frequency_hz in [1, 3, 49, 50, 333, 400, 1_000, 24_999, 1_000_000] {
                let Some(rate) = Rate::new(clock_hz, frequency_hz) else {
                    // Prime factors of a clock leave gaps between its dividers.
                    assert!(
                        clock_hz == 79_960_000 && frequency_hz == 1,
                        "{clock_hz} {frequency_hz}"
                    );
                    continue;
                };
                assert!(clock_hz.is_multiple_of(rate.tick_hz) && clock_hz / rate.tick_hz <= 65_536);
                assert!((2..=65_535).contains(&rate.period_ticks), "{rate:?}");
                // Rounded to the nearest period: off by at most half a tick.
                let off = rate.tick_hz.abs_diff(rate.period_ticks * frequency_hz);
                assert!(off <= frequency_hz / 2 + 1, "{rate:?} {frequency_hz}");
            }
        }
    }

    #[test]
    fn pulses_are_rounded_and_no_longer_than_the_period() {
        let rate = Rate { tick_hz: 3_000_000, period_ticks: 60_000 };
        assert_eq!(
            [0, 1_000, 2_000, 20_000, 30_000].map(|us| rate.ticks(us)),
            [0, 3_000, 6_000, 60_000, 60_000]
        );
    }
}
