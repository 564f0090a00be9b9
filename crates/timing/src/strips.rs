//! LED strips on one wire of SPI: how many of its bits make one bit of a strip, and which of them are high.
//!
//! In: the times that a strip demands, and the clocks that a unit can make. Out: the pulses with the fewest bits whose
//! four times are all within what the strip's data sheet asks for, so that a frame takes the least memory.

use sensedsl_board::profile::{Dividers, TargetProfile};
use sensedsl_diagnostics::Diagnostic;
use sensedsl_diagnostics::codes::e0620_clock_out_of_reach::clock_out_of_reach;
use sensedsl_model::design::{Board, Design};
use sensedsl_model::kind::Kind;
use sensedsl_model::kind::encoding::{Encoding, Window, Windows};
use sensedsl_model::kind::spi::Spi;
use sensedsl_wiring::assignment::BoardAssignment;

use crate::clocks::unit_hz;
use crate::context::{Context, Wired};
use crate::units::SECOND_NS;

/// The most bits of SPI for one bit of a strip.
const BITS_MAX: u32 = 8;
/// Later editions of a WS2812B may take a longer 0 for a 1, whatever the sheet of the first ones says.
const LONG_NS: u64 = 450;
/// Bits of a strip that the wire is low after a frame: more than 300 us for any pulses that a strip takes.
const REST_BITS: u64 = 320;
/// Bytes before the first LED of an APA102 strip.
const APA102_START_BYTES: u64 = 4;
/// Bytes of an LED of an APA102 strip.
const APA102_LED_BYTES: u64 = 4;
/// Columns of a letter, a byte each.
const LETTER_BYTES: u64 = 6;

/// The pulses of a strip.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pulses {
    /// The clock of SPI, rounded up, so that dividing by it gives the divider.
    pub clock_hz: u32,
    /// Bits of SPI for one of the strip.
    pub bits: u8,
    /// How many of them are high for a 0.
    pub short: u8,
    /// How many of them are high for a 1.
    pub long: u8,
}

impl Pulses {
    /// Those of a unit whose clocks are not known.
    #[must_use]
    pub const fn usual(encoding: Encoding) -> Self {
        match encoding {
            Encoding::Sk6812 => Self { clock_hz: 3_333_333, bits: 4, short: 1, long: 2 },
            Encoding::Plain | Encoding::Ws2812 | Encoding::Apa102 | Encoding::Text => {
                Self { clock_hz: 2_500_000, bits: 3, short: 1, long: 2 }
            }
        }
    }
}

/// The pulses that a unit with that clock can make for a strip; none if it can make none.
#[must_use]
pub fn pulses(profile: &TargetProfile, unit_hz: u32, windows: Windows) -> Option<Pulses> {
    let dividers = profile.spi_dividers.as_ref()?;
    best(dividers, unit_hz, windows)
}

/// Those of the fewest bits; among them those whose times are nearest to the middle of what is allowed.
fn best(dividers: &Dividers, unit_hz: u32, windows: Windows) -> Option<Pulses> {
    let [least, greatest] = dividers.range;
    let most = greatest.min(unit_hz / 1_000_000);
    let can = |divider: &u32| !dividers.powers_of_two || divider.is_power_of_two();
    let all = (least.max(1)..=most).filter(can).flat_map(|divider| {
        (1..=BITS_MAX).filter_map(move |bits| of_bits(unit_hz, divider, bits, windows))
    });
    all.min_by_key(|(one, off_ns)| (one.bits, *off_ns)).map(|(one, _)| one)
}

/// The pulses of so many bits at that divider, and how far their times are off the middle together.
fn of_bits(unit_hz: u32, divider: u32, bits: u32, windows: Windows) -> Option<(Pulses, u64)> {
    let tick_ps = SECOND_NS * 1_000 * u64::from(divider) / u64::from(unit_hz.max(1));
    let off = |(high, low): (Window, Window), count: u32| {
        let low_bits = u64::from(bits - count);
        Some(off_ns(high, tick_ps * u64::from(count))? + off_ns(low, tick_ps * low_bits)?)
    };
    let all = |pair: (Window, Window)| {
        (1..bits).filter_map(move |count| Some((off(pair, count)?, count)))
    };
    let is_long = |count: u32| tick_ps * u64::from(count) > LONG_NS * 1_000;
    let (off_zero, short) = all(windows.zero).min_by_key(|(off, count)| (is_long(*count), *off))?;
    let (off_one, long) = all(windows.one).min()?;
    let [bits, short, long] = [bits, short, long].map(|one| u8::try_from(one).ok());
    let clock_hz = unit_hz.div_ceil(divider);
    let made = Pulses { clock_hz, bits: bits?, short: short?, long: long? };
    Some((made, off_zero + off_one))
}

/// How far a time is off the middle of what is allowed; none if it is not allowed.
fn off_ns((least, most): Window, ps: u64) -> Option<u64> {
    let (ns, least, most) = (ps / 1_000, u64::from(least), u64::from(most));
    (least..=most).contains(&ns).then(|| ns.abs_diff(least.midpoint(most)))
}

/// The pulses of a strip on a unit of a board; none if it needs none, or no clock is known.
#[must_use]
pub fn pulses_of(
    design: &Design,
    board: &Board,
    wiring: &BoardAssignment,
    (unit, spi): (&str, &Spi),
) -> Option<Pulses> {
    on_unit(&Context::new(design, board, wiring), unit, spi)
}

/// The same with a context.
pub(crate) fn on_unit(context: &Context<'_>, unit: &str, spi: &Spi) -> Option<Pulses> {
    let windows = spi.encoding.windows()?;
    let profile = context.board.profile()?;
    pulses(profile, unit_hz(context, profile.unit(unit)?)?, windows)
}

/// Bytes that are sent for so many elements: colours, of so many each, or letters; none if they are the value's own.
/// `bits` is how many of SPI make one of a strip.
#[must_use]
pub fn sent_bytes(encoding: Encoding, elements: u64, colours: u64, bits: u64) -> Option<u64> {
    match encoding {
        Encoding::Plain => None,
        Encoding::Ws2812 | Encoding::Sk6812 => {
            Some(1 + elements * colours * bits + REST_BITS / 8 * bits)
        }
        Encoding::Apa102 => {
            let end = APA102_START_BYTES + elements.div_ceil(16);
            Some(APA102_START_BYTES + elements * APA102_LED_BYTES + end)
        }
        Encoding::Text => Some(LETTER_BYTES * elements),
    }
}

/// Bytes that a device of a unit of which nothing is known sends in place of its value; none if they are the value's own.
pub(crate) fn usual_bytes(kind: &Kind, elements: u64) -> Option<u64> {
    let colours = kind.spi().map_or(0, |spi| spi.colours.len() as u64);
    let encoding = kind.encoding();
    sent_bytes(encoding, elements, colours, Pulses::usual(encoding).bits.into())
}

/// Bytes that a command sends in place of its value; none if they are the value's own.
pub(crate) fn sent(context: &Context<'_>, wired: &Wired<'_>) -> Option<u64> {
    let kind = &wired.device.kind;
    let elements = wired.device.value.value.count() as u64;
    let spi = kind.spi();
    let own = spi.and_then(|spi| on_unit(context, wired.wiring.unit.as_deref()?, spi));
    let bits = own.unwrap_or(Pulses::usual(kind.encoding())).bits;
    let colours = spi.map_or(0, |spi| spi.colours.len() as u64);
    sent_bytes(kind.encoding(), elements, colours, bits.into())
}

/// Reports a strip on a unit that can make no pulses for it.
pub(crate) fn out_of_reach(
    context: &Context<'_>,
    unit: &str,
    wired: &Wired<'_>,
) -> Option<Diagnostic> {
    let spi = wired.device.kind.spi()?;
    spi.encoding.windows()?;
    let hz = unit_hz(context, context.board.profile()?.unit(unit)?)?;
    if on_unit(context, unit, spi).is_some() {
        return None;
    }
    let (name, encoding) = (&wired.device.name.value, spi.encoding.name());
    let message = format!(
        "{unit} of {name} runs at {hz} Hz, and no divider of it makes the pulses of `encoding = {encoding}`"
    );
    let help = format!(
        "take an SPI unit with another clock: `avoid unit = {unit};`, or a strip with a clock wire: `driver = apa102;`"
    );
    Some(clock_out_of_reach(wired.device.kind_span, &message, &help))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may panic")]

    use sensedsl_model::{NoFiles, Request, resolve};
    use sensedsl_wiring::{Search, Solved, Wiring};

    use super::*;

    fn made(unit_hz: u32, powers_of_two: bool, encoding: Encoding) -> Option<(u32, u8, u8, u8)> {
        let dividers =
            Dividers { range: [2, 256], powers_of_two, steps: [1, 1], source: String::new() };
        let made = best(&dividers, unit_hz, encoding.windows().unwrap());
        let Pulses { clock_hz, bits, short, long } = made?;
        Some((clock_hz, bits, short, long))
    }

    /// Worked out by hand from the four times of each data sheet.
    #[test]
    fn pulses_are_those_of_the_data_sheet() {
        let ws = Encoding::Ws2812;
        assert_eq!(made(84_000_000, true, ws), Some((2_625_000, 3, 1, 2)));
        assert_eq!(made(72_000_000, true, ws), Some((2_250_000, 3, 1, 2)));
        // 6.25 MHz: 320 and 800 ns high, 800 and 320 ns low.
        assert_eq!(made(100_000_000, true, ws), Some((6_250_000, 7, 2, 5)));
        // 6 MHz: 333 and 833 ns high, 833 and 333 ns low.
        assert_eq!(made(48_000_000, true, ws), Some((6_000_000, 7, 2, 5)));
        // 4 MHz: 250 and 750 ns high, 1000 and 500 ns low.
        assert_eq!(made(64_000_000, true, ws), Some((4_000_000, 5, 1, 3)));
        assert_eq!(made(125_000_000, false, ws).map(|one| one.1), Some(3));
        // 190 ns a bit: 190 and 571 ns high, 952 and 571 ns low.
        assert_eq!(made(84_000_000, true, Encoding::Sk6812), Some((5_250_000, 6, 1, 3)));
        // 4.5 MHz: 444 and 667 ns high, 889 and 667 ns low.
        assert_eq!(made(72_000_000, true, Encoding::Sk6812), Some((4_500_000, 6, 2, 3)));
        assert_eq!(made(1_000_000, true, ws), None);
    }

    /// Built-in boards are all fast enough: this one is slowed down.
    #[test]
    fn a_unit_that_is_too_slow_is_told() {
        let text =
            "board STM32F407G_DISC1 { actuator Ring accepts uint32[4] { driver = ws2812b; } }";
        let request = Request { path: "x.sense", text, ..Request::default() };
        let mut design = resolve(&request, &NoFiles).design.unwrap();
        let reported = |design: &Design| {
            let Solved::Wired(wiring) = Wiring::new(design, None).solve(&Search::default()) else {
                return None;
            };
            let codes = crate::check(design, &wiring).into_iter();
            Some(codes.map(|one| one.code.info().code).collect::<Vec<_>>())
        };
        assert_eq!(reported(&design), Some(Vec::new()));
        let facts = design.boards.first_mut().unwrap().facts.as_mut().unwrap();
        let clocks = facts.system.get_mut("chibios").unwrap().clocks_hz.iter_mut();
        let buses = clocks.filter(|(name, _)| name.starts_with("STM32_PCLK"));
        buses.for_each(|(_, hz)| *hz = 4_000_000);
        assert_eq!(reported(&design), Some(vec!["E0620"]));
    }

    #[test]
    fn a_frame_has_a_rest_of_300_us_whatever_its_clock() {
        for unit_hz in (8..=250).map(|mhz| 1_000_000 * mhz) {
            for encoding in [Encoding::Ws2812, Encoding::Sk6812] {
                let Some((clock_hz, bits, ..)) = made(unit_hz, true, encoding) else { continue };
                let rest_bytes = sent_bytes(encoding, 0, 3, bits.into()).unwrap() - 1;
                let least_us = if encoding == Encoding::Ws2812 { 300 } else { 280 };
                let rest_us = rest_bytes * 8 * 1_000_000 / u64::from(clock_hz);
                assert!(rest_us >= least_us, "{unit_hz} {encoding:?}: {rest_us} us");
            }
        }
        assert_eq!(sent_bytes(Encoding::Apa102, 8, 3, 0), Some(4 + 32 + 5));
        assert_eq!(sent_bytes(Encoding::Apa102, 17, 3, 0), Some(4 + 68 + 6));
        assert_eq!(sent_bytes(Encoding::Text, 21, 0, 0), Some(126));
    }
}
