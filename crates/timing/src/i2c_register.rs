//! The timing register of an I2C unit (`TIMINGR`): the unit's clock and the bus clock that devices
//! support in, the five fields and the resulting clock of the bus out.
//!
//! A phase of a bus clock is as long as its count of prescaled clocks, plus the time that the unit
//! needs to see the edge: the analog filter (50 ns to 260 ns) and two to three clocks. The
//! calculation uses the shortest of these times, and no time for the slopes of the wires. So a real
//! bus is a little slower than calculated, never faster, and its low and high phases are never
//! shorter than the specification allows (UM10204, table 10). The formulas are from the reference
//! manuals (RM0091, 26.4.9).

use sensedsl_board::profile::I2cTiming;

use crate::units::SECOND_NS;

/// The fields of the register, as they are written to it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TimingRegister {
    /// `PRESC`: the prescaler minus one.
    pub prescaler: u32,
    /// `SCLDEL`: the delay from data to the clock's rising edge.
    pub data_setup: u32,
    /// `SDADEL`: the delay from the clock's falling edge to data.
    pub data_hold: u32,
    /// `SCLH`: the high phase minus one.
    pub high: u32,
    /// `SCLL`: the low phase minus one.
    pub low: u32,
    /// Bus clocks per second, rounded down to whole hertz.
    pub speed_hz: u32,
}

/// The requirements of the specification for a mode.
struct Mode {
    low_ns: u64,
    high_ns: u64,
    /// Setup time of data, including the longest rise time of the wire.
    setup_ns: u64,
    /// The latest time at which data may become valid, minus the longest rise time.
    valid_ns: u64,
}

const STANDARD: Mode =
    Mode { low_ns: 4_700, high_ns: 4_000, setup_ns: 250 + 1_000, valid_ns: 3_450 - 1_000 };
const FAST: Mode = Mode { low_ns: 1_300, high_ns: 600, setup_ns: 100 + 300, valid_ns: 900 - 300 };

/// The fastest bus clock in standard mode.
const STANDARD_HZ: u32 = 100_000;
/// The longest fall time of a wire, in both modes.
const FALL_NS: u64 = 300;
/// The shortest and the longest delay of the analog filter.
const FILTER_NS: [u64; 2] = [50, 260];
/// Fewest clocks until the unit sees an edge.
const EDGE_CLOCKS: u64 = 2;
/// Greatest counts of the fields.
const COUNT_MAX: u64 = 256;
const DELAY_MAX: u64 = 15;
const PRESCALER_MAX: u64 = 16;

/// The register values for the fastest clock up to a limit; none if no values are possible.
pub(crate) fn fastest(facts: I2cTiming, unit_hz: u32, speed_max_hz: u32) -> Option<TimingRegister> {
    let prescalers = 1..=u64::from(facts.prescaler_max);
    let all = prescalers.filter_map(|prescaler| register(prescaler, unit_hz, speed_max_hz));
    // Of equal clocks, the one with the finest steps wins.
    all.reduce(|best, one| if one.speed_hz > best.speed_hz { one } else { best })
}

/// The slowest clock that the register allows.
pub(crate) fn slowest_hz(facts: I2cTiming, unit_hz: u32) -> u32 {
    // Rounded up, so that this speed is reached when it is requested.
    speed_hz(u64::from(facts.prescaler_max) * 2 * COUNT_MAX, unit_hz).saturating_add(1)
}

/// The bus clock for this many counted clocks, including what the edges add.
fn speed_hz(clocks: u64, unit_hz: u32) -> u32 {
    let unit_hz = u64::from(unit_hz);
    let period = (clocks + 2 * EDGE_CLOCKS) * SECOND_NS + 2 * FILTER_NS[0] * unit_hz;
    u32::try_from(SECOND_NS * unit_hz / period).unwrap_or(u32::MAX)
}

/// The fastest register values with a given prescaler.
fn register(prescaler: u64, unit_hz: u32, speed_max_hz: u32) -> Option<TimingRegister> {
    let mode = if speed_max_hz <= STANDARD_HZ { STANDARD } else { FAST };
    let hz = u64::from(unit_hz);
    // Steps of the prescaled clock that last this long, including a number of unprescaled clocks.
    let steps = |ns: u64, clocks: u64| {
        let whole = (ns * hz).div_ceil(SECOND_NS);
        whole.saturating_sub(clocks).div_ceil(prescaler)
    };
    let part = |ns: u64| steps(ns - FILTER_NS[0], EDGE_CLOCKS).max(1);
    let (low_min, high_min) = (part(mode.low_ns), part(mode.high_ns));
    let period_ns = SECOND_NS.div_ceil(u64::from(speed_max_hz.max(1)));
    let whole = steps(period_ns.saturating_sub(2 * FILTER_NS[0]), 2 * EDGE_CLOCKS);
    // The time left over after the minimum phases is divided equally between the two.
    let spare = whole.saturating_sub(low_min + high_min);
    let mut low = low_min + spare.div_ceil(2);
    let mut high = high_min + spare / 2;
    if low > COUNT_MAX {
        high += low - COUNT_MAX;
        low = COUNT_MAX;
    }
    // Units faster than 200 MHz cannot count the longest rise time; they wait as long as they can.
    let is_coarsest = prescaler == PRESCALER_MAX;
    let setup =
        steps(mode.setup_ns, 0).clamp(1, if is_coarsest { DELAY_MAX + 1 } else { u64::MAX });
    // Data is held as long as the clock may take to fall; if that would make it late, as long as
    // possible.
    let hold = steps(FALL_NS - FILTER_NS[0], 3);
    let late = (mode.valid_ns.saturating_sub(FILTER_NS[1]) * hz / SECOND_NS).saturating_sub(4);
    let hold = hold.min(late / prescaler);
    let fits = high <= COUNT_MAX && setup <= DELAY_MAX + 1 && hold <= DELAY_MAX;
    let speed_hz = speed_hz(prescaler * (low + high), unit_hz);
    // The filter must finish in a quarter of the low phase.
    let keeps_up = 4 * SECOND_NS < hz * (mode.low_ns - FILTER_NS[1]);
    let field = |count: u64| u32::try_from(count).unwrap_or(u32::MAX);
    (fits && keeps_up && speed_hz <= speed_max_hz).then(|| TimingRegister {
        prescaler: field(prescaler - 1),
        data_setup: field(setup - 1),
        data_hold: field(hold),
        high: field(high - 1),
        low: field(low - 1),
        speed_hz,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const FACTS: I2cTiming = I2cTiming { prescaler_max: 16 };

    /// The manual's requirements, calculated in a different way: in picoseconds, phase by phase.
    fn check(register: TimingRegister, unit_hz: u32, asked_hz: u32) {
        let TimingRegister { prescaler, data_setup, data_hold, high, low, speed_hz } = register;
        let clock_ps = 1e12 / f64::from(unit_hz);
        let step_ps = clock_ps * f64::from(prescaler + 1);
        let edge_ps = 50_000.0 + 2.0 * clock_ps;
        let part = |field: u32| f64::from(field + 1) * step_ps + edge_ps;
        let is_fast = asked_hz > 100_000;
        let (least_low, least_high, setup) =
            if is_fast { (1.3e6, 0.6e6, 0.4e6) } else { (4.7e6, 4.0e6, 1.25e6) };
        let reported = format!("{unit_hz} {asked_hz}: {register:?}");
        assert!(part(low) >= least_low - 1.0 && part(high) >= least_high - 1.0, "{reported}");
        let real_hz = 1e12 / (part(low) + part(high));
        assert!(real_hz <= f64::from(asked_hz) + 1e-3, "{reported}");
        assert!((real_hz - f64::from(speed_hz)).abs() <= 1.0, "{reported}");
        let is_longest = (prescaler, data_setup) == (15, 15);
        assert!(is_longest || f64::from(data_setup + 1) * step_ps >= setup - 1.0, "{reported}");
        let hold_ps = f64::from(data_hold) * step_ps + 260_000.0 + 4.0 * clock_ps;
        let late_ps = if is_fast { 0.6e6 } else { 2.45e6 };
        assert!(data_hold == 0 || hold_ps <= late_ps + 1.0, "{reported}");
        assert!(
            prescaler <= 15 && data_setup <= 15 && data_hold <= 15 && high <= 255 && low <= 255
        );
    }

    #[test]
    fn every_register_keeps_the_specification() {
        let units = [8, 16, 32, 36, 48, 54, 64, 72, 80, 85, 100, 110, 120, 130, 260];
        for unit_hz in units.map(|mhz| mhz * 1_000_000) {
            let slowest_hz = slowest_hz(FACTS, unit_hz).max(20_000).next_multiple_of(1_000);
            for asked_hz in (slowest_hz..=400_000).step_by(1_000) {
                let found = fastest(FACTS, unit_hz, asked_hz);
                let found = found.unwrap_or_else(|| panic!("{asked_hz} of {unit_hz}"));
                check(found, unit_hz, asked_hz);
                // At most two steps away from the requested clock, if the mode allows that.
                let step = f64::from(asked_hz) * (1.0 / f64::from(unit_hz)) * f64::from(asked_hz);
                let slow = f64::from(asked_hz) - f64::from(found.speed_hz);
                let is_tight = (95_000..=100_000).contains(&asked_hz) || asked_hz > 380_000;
                let coarse = f64::from(found.prescaler + 1);
                assert!(
                    is_tight || slow <= 2.0 * coarse * step + 1.0,
                    "{asked_hz} {unit_hz} {found:?}"
                );
            }
        }
    }

    #[test]
    fn the_slowest_is_reached() {
        for unit_hz in [8_000_000, 48_000_000, 120_000_000] {
            let slowest = slowest_hz(FACTS, unit_hz);
            let found = fastest(FACTS, unit_hz, slowest).unwrap();
            assert_eq!((found.high, found.low, found.prescaler), (255, 255, 15));
            assert_eq!(fastest(FACTS, unit_hz, slowest - 2), None);
        }
    }

    #[test]
    fn a_clock_of_the_internal_oscillator() {
        // STM32F0: HSI of 8 MHz. The manual's example (RM0091, table 77) is 0, 9, 3 with longer edges.
        let found = fastest(FACTS, 8_000_000, 400_000).unwrap();
        assert_eq!((found.prescaler, found.low + found.high + 2), (0, 16));
        assert_eq!(found.speed_hz, 384_615);
    }
}
