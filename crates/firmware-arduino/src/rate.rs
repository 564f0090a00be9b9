//! How a timer makes a frequency: the divider of its clock and the ticks of a period.

/// A divider, and the bits of `TCCRnB` that select it.
type Divider = (u32, &'static [u8]);

/// The dividers of timers with 16 bits.
const WIDE: &[Divider] = &[(1, &[0]), (8, &[1]), (64, &[0, 1]), (256, &[2]), (1_024, &[0, 2])];
/// The dividers of timer 2.
const NARROW: &[Divider] = &[
    (1, &[0]),
    (8, &[1]),
    (32, &[0, 1]),
    (64, &[2]),
    (128, &[0, 2]),
    (256, &[1, 2]),
    (1_024, &[0, 1, 2]),
];

/// The tick and the period of a timer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Rate {
    pub(crate) tick_hz: u32,
    pub(crate) period_ticks: u32,
    bits: &'static [u8],
}

impl Rate {
    /// The finest tick whose period the counter holds; `None` if there is none.
    pub(crate) fn new(clock_hz: u32, counter_bits: u8, frequency_hz: u32) -> Option<Self> {
        let dividers = if counter_bits > 8 { WIDE } else { NARROW };
        let most = 1_u32 << counter_bits.min(16);
        dividers.iter().find_map(|(divider, bits)| {
            let tick_hz = clock_hz / divider;
            let period_ticks = tick_hz.checked_add(frequency_hz / 2)? / frequency_hz.max(1);
            (2..=most).contains(&period_ticks).then_some(Self { tick_hz, period_ticks, bits })
        })
    }

    /// The number of ticks nearest to a pulse, at most the period.
    pub(crate) fn ticks(self, pulse_us: u32) -> u32 {
        let ticks = (u64::from(pulse_us) * u64::from(self.tick_hz) + 500_000) / 1_000_000;
        u32::try_from(ticks).unwrap_or(u32::MAX).min(self.period_ticks)
    }

    /// What selects the divider of a timer, in C: `_BV(CS11) | _BV(CS10)`.
    pub(crate) fn select(self, timer: &str) -> String {
        let bits: Vec<String> =
            self.bits.iter().map(|bit| format!("_BV(CS{timer}{bit})")).collect();
        bits.join(" | ")
    }
}

#[cfg(test)]
mod tests {
    use super::Rate;

    #[test]
    fn the_tick_is_the_finest_whose_period_fits() {
        let of =
            |bits, hz| Rate::new(16_000_000, bits, hz).map(|one| (one.tick_hz, one.period_ticks));
        assert_eq!(of(16, 50), Some((2_000_000, 40_000)));
        assert_eq!(of(16, 20_000), Some((16_000_000, 800)));
        assert_eq!(of(16, 1), Some((62_500, 62_500)));
        assert_eq!(of(8, 1_000), Some((250_000, 250)));
        assert_eq!(of(8, 20_000), Some((2_000_000, 100)));
        assert_eq!(of(8, 50), None);
        assert_eq!(of(8, 62), Some((15_625, 252)));
    }
}
