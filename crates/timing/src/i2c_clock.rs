//! The clock of an I2C bus: a device's requested clock and the driver's dividers in, the speed of
//! the bus out.
//!
//! The driver divides its unit's clock by whole numbers and halts the board if there is a
//! remainder. A device states the fastest clock it supports, so the bus gets the fastest clock that
//! the driver can produce and that is not above it. Units with a timing register use counts instead
//! ([`TimingRegister`]).

use std::ops::RangeInclusive;

use sensedsl_board::profile::{I2cMode, I2cs};

use crate::i2c_register;
pub use crate::i2c_register::TimingRegister;

/// The clock of a bus.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BusClock {
    /// Bus clocks per second.
    pub speed_hz: u32,
    /// The driver's word for the duty cycle; empty if the driver takes register values.
    pub duty: String,
    /// Steps of the divider in one bus clock.
    pub clocks: u32,
    /// The dividers that the driver accepts.
    pub dividers: RangeInclusive<u32>,
    /// The register values, for a unit with a timing register.
    pub register: Option<TimingRegister>,
}

/// The fastest clock up to `speed_max_hz` that a unit can produce from its own.
#[must_use]
pub fn fastest(facts: &I2cs, unit_hz: u32, speed_max_hz: u32) -> Option<BusClock> {
    let mut best: Option<BusClock> = None;
    for clock in all(facts, unit_hz).filter(|clock| clock.speed_hz <= speed_max_hz) {
        if best.as_ref().is_none_or(|best| best.speed_hz < clock.speed_hz) {
            best = Some(clock);
        }
    }
    let counted = || i2c_register::fastest(facts.timing?, unit_hz, speed_max_hz).map(of_register);
    best.or_else(counted)
}

/// The slowest clock that a unit can produce from its own.
#[must_use]
pub fn slowest_hz(facts: &I2cs, unit_hz: u32) -> Option<u32> {
    let divided = all(facts, unit_hz).map(|clock| clock.speed_hz).min();
    divided.or_else(|| Some(i2c_register::slowest_hz(facts.timing?, unit_hz)))
}

/// All clocks that a driver with dividers accepts.
fn all(facts: &I2cs, unit_hz: u32) -> impl Iterator<Item = BusClock> + '_ {
    facts.modes.iter().flat_map(move |mode| {
        let [least, greatest] = mode.dividers;
        (least..=greatest).filter_map(move |divider| clock(mode, unit_hz, divider))
    })
}

fn of_register(register: TimingRegister) -> BusClock {
    BusClock {
        speed_hz: register.speed_hz,
        duty: String::new(),
        clocks: 0,
        dividers: 1..=1,
        register: Some(register),
    }
}

fn clock(mode: &I2cMode, unit_hz: u32, divider: u32) -> Option<BusClock> {
    let steps = mode.clocks.checked_mul(divider)?;
    let [slowest_hz, fastest_hz] = mode.speeds_hz;
    let speed_hz = unit_hz.checked_div(steps)?;
    let is_whole = unit_hz.checked_rem(steps) == Some(0);
    (is_whole && (slowest_hz..=fastest_hz).contains(&speed_hz)).then(|| BusClock {
        speed_hz,
        duty: mode.duty.clone(),
        clocks: mode.clocks,
        dividers: mode.dividers[0]..=mode.dividers[1],
        register: None,
    })
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use sensedsl_board::catalog;
    use sensedsl_board::profile::{DEFAULT, Target, TargetProfile, find};

    use super::*;

    /// The assertions of `i2c_lld_set_clock` in the first I2C driver, with its names.
    fn driver_accepts(pclk1: u32, clock_speed: u32, duty: &str) -> bool {
        let divides = |clocks: u32, least: u32| {
            let clock_div = pclk1 / (clock_speed * clocks);
            pclk1.is_multiple_of(clock_speed * clocks) && (least..=0xFFF).contains(&clock_div)
        };
        match (clock_speed, duty) {
            (1..=100_000, "STD_DUTY_CYCLE") => divides(2, 0x04),
            (100_001..=400_000, "FAST_DUTY_CYCLE_2") => divides(3, 0x01),
            (100_001..=400_000, "FAST_DUTY_CYCLE_16_9") => divides(25, 0x01),
            _ => false,
        }
    }

    fn profile(mcu: &str) -> TargetProfile {
        let Ok(Target::Profile(profile)) = find(DEFAULT, mcu) else { panic!("{mcu}") };
        *profile
    }

    /// The clocks of I2C units on boards whose driver divides them.
    fn unit_clocks_hz() -> BTreeSet<u32> {
        let mut clocks_hz = BTreeSet::new();
        for facts in catalog::all().iter().map(|entry| entry.board().unwrap()) {
            let Some(system) = facts.system.get(DEFAULT) else { continue };
            let Ok(Target::Profile(profile)) = find(DEFAULT, &facts.mcu) else { continue };
            if !profile.i2c.modes.is_empty() {
                let clocks = profile.i2cs.iter().map(|unit| unit.clock.as_deref().unwrap());
                clocks_hz.extend(clocks.map(|clock| system.clocks_hz[clock]));
            }
        }
        clocks_hz
    }

    #[test]
    #[expect(clippy::disallowed_methods, reason = "a test asks the environment how much is wanted")]
    fn every_speed_is_one_that_the_driver_accepts_or_too_slow() {
        let facts = profile("STM32F407VG").i2c;
        let clocks_hz = unit_clocks_hz();
        assert!(clocks_hz.len() >= 4, "{clocks_hz:?}");
        let step = if std::env::var("SENSEDSL_THOROUGH").is_ok() { 250 } else { 2_500 };
        for unit_hz in clocks_hz {
            let slowest_hz = slowest_hz(&facts, unit_hz).unwrap();
            for asked_hz in (1_000..=400_000).step_by(step).chain([99_999, 100_001, 399_999]) {
                let Some(clock) = fastest(&facts, unit_hz, asked_hz) else {
                    assert!(asked_hz < slowest_hz, "{asked_hz} of {unit_hz}");
                    continue;
                };
                assert!(
                    driver_accepts(unit_hz, clock.speed_hz, &clock.duty),
                    "{unit_hz}: {clock:?}"
                );
                assert!(clock.speed_hz <= asked_hz);
                // If the requested clock is possible, it is used.
                for mode in &facts.modes {
                    let as_asked = driver_accepts(unit_hz, asked_hz, &mode.duty);
                    assert!(!as_asked || clock.speed_hz == asked_hz, "{asked_hz} of {unit_hz}");
                }
            }
        }
    }

    #[test]
    fn the_discovery_board_gets_the_next_slower_clock() {
        let facts = profile("STM32F407VG").i2c;
        let speed_hz = |asked_hz| fastest(&facts, 42_000_000, asked_hz).map(|clock| clock.speed_hz);
        assert_eq!(speed_hz(400_000), Some(400_000));
        assert_eq!(speed_hz(300_000), Some(280_000));
        assert_eq!(speed_hz(100_000), Some(100_000));
        assert_eq!(speed_hz(5_250), Some(5_250));
        assert_eq!(speed_hz(5_249), None);
        assert_eq!(speed_hz(1_000), None);
    }

    #[test]
    fn a_timing_register_counts_to_any_speed_in_reach() {
        let facts = profile("STM32G071RB").i2c;
        let speed_hz = |asked_hz| fastest(&facts, 64_000_000, asked_hz).map(|clock| clock.speed_hz);
        assert_eq!(speed_hz(400_000), Some(399_002));
        assert_eq!(speed_hz(300_000), Some(299_906));
        assert_eq!(speed_hz(100_000), Some(99_937));
        assert_eq!(speed_hz(5_000), None);
        assert_eq!(slowest_hz(&facts, 64_000_000), Some(7_803));
    }
}
