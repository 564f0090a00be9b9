//! How ports must be set up, from the wiring and what the drivers can do, and which of them differ.
//!
//! In: a board's job, and the state of the ports of the emulated MCU. Out: the differences. A real part that is
//! addressed at the wrong speed, or at the wrong edge of its clock, understands nothing, but the parts of the simulated
//! world take bytes and not edges. Nothing here is shared with the generators.

use std::collections::BTreeMap;

use sensedsl_job::BoardJob;
use sensedsl_model::kind::uart::Parity;
use sensedsl_model::kind::{Interface, Kind};

use crate::pads::PadMismatch;
use sensedsl_machine::{PortState, Setting};

/// The greatest error of a serial port's speed, in per cent, at which it still receives characters.
const BAUD_PERCENT: u64 = 2;

/// How a port must be set up.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct PlannedPort {
    unit: String,
    /// The titles of its devices.
    title: String,
    /// The settings, any of which will do: each chip on an SPI bus has its own.
    wanted: Vec<RequiredSettings>,
}

/// The settings that one device needs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum RequiredSettings {
    Serial { baud: u64, data_bits: u8, odd_parity: Option<bool>, stop_bits: u8 },
    Spi { most_hz: u64, mode: u8 },
    I2c { most_hz: u64 },
    Can { bitrate_hz: u64 },
}

/// The ports of all devices and of a serial link.
pub(crate) fn planned(job: &BoardJob<'_>) -> Vec<PlannedPort> {
    let mut ports: BTreeMap<String, PlannedPort> = BTreeMap::new();
    let mut add = |unit: &str, title: &str, wanted: RequiredSettings| {
        let fresh = || PlannedPort { unit: unit.to_owned(), title: String::new(), wanted: vec![] };
        let port = ports.entry(unit.to_owned()).or_insert_with(fresh);
        let and = if port.title.is_empty() { "" } else { " and " };
        port.title.push_str(&format!("{and}{title}"));
        match (port.wanted.first_mut(), wanted) {
            // The slowest part determines the speed of a bus.
            (Some(RequiredSettings::I2c { most_hz }), RequiredSettings::I2c { most_hz: other }) => {
                *most_hz = other.min(*most_hz);
            }
            (_, _) => port.wanted.push(wanted),
        }
    };
    let profile = job.board.profile();
    let fastest_hz = profile.map_or(u64::MAX, |profile| profile.i2c.speed_max_hz.into());
    for one in &job.connections {
        if let (Some(unit), Some(wanted)) = (one.unit, of_kind(&one.connection.kind, fastest_hz)) {
            add(unit, &one.title, wanted);
        }
    }
    if let Some(link) = &job.link {
        let baud = u64::from(job.board.link.baud);
        let plain = RequiredSettings::Serial { baud, data_bits: 8, odd_parity: None, stop_bits: 1 };
        add(link.unit, "the link", plain);
    }
    ports.into_values().collect()
}

/// The settings for a device; `fastest_hz` is the fastest I²C bus that the system's driver accepts.
fn of_kind(kind: &Kind, fastest_hz: u64) -> Option<RequiredSettings> {
    match kind.interface() {
        Interface::Uart(own) => Some(RequiredSettings::Serial {
            baud: u64::from(own.baud),
            data_bits: own.data_bits,
            odd_parity: match own.parity {
                Parity::None => None,
                Parity::Even => Some(false),
                Parity::Odd => Some(true),
            },
            stop_bits: own.stop_bits,
        }),
        // The times of its pulses tell whether the clock of a strip is right.
        Interface::Spi(own) if own.encoding.windows().is_some() => None,
        Interface::Spi(own) => {
            Some(RequiredSettings::Spi { most_hz: u64::from(own.clock_hz), mode: own.mode })
        }
        Interface::I2c(own) => {
            Some(RequiredSettings::I2c { most_hz: u64::from(own.speed_hz).min(fastest_hz) })
        }
        Interface::Can(own) => {
            Some(RequiredSettings::Can { bitrate_hz: u64::from(own.bitrate_hz) })
        }
        Interface::Analog(_)
        | Interface::Dac(_)
        | Interface::Digital(_)
        | Interface::Icu(_)
        | Interface::Encoder(_)
        | Interface::Pwm(_)
        | Interface::OneWire(_)
        | Interface::Stepper(_)
        | Interface::Code(_) => None,
    }
}

/// The ports that are not as planned. A port that was not started shows in the silence of its devices.
pub(crate) fn mismatches(planned: &[PlannedPort], states: &[PortState]) -> Vec<PadMismatch> {
    let differs = |one: &PlannedPort| {
        let state = states.iter().find(|state| state.unit == one.unit)?;
        let is_right = one.wanted.iter().any(|wanted| fits(*wanted, state.setting));
        let expected: Vec<String> =
            one.wanted.iter().map(|wanted| expected(*wanted, state.setting)).collect();
        (!is_right).then(|| PadMismatch {
            title: one.title.clone(),
            place: one.unit.clone(),
            expected: expected.join(" or "),
            found: found(state.setting),
        })
    };
    planned.iter().filter_map(differs).collect()
}

fn fits(wanted: RequiredSettings, state: Setting) -> bool {
    match (wanted, state) {
        (
            RequiredSettings::Serial { baud, data_bits, odd_parity, stop_bits },
            Setting::Serial {
                baud: found,
                data_bits: found_bits,
                odd_parity: found_parity,
                stop_bits: found_stops,
            },
        ) => {
            baud.abs_diff(found) * 100 <= baud * BAUD_PERCENT
                && (data_bits, odd_parity, stop_bits) == (found_bits, found_parity, found_stops)
        }
        (
            RequiredSettings::Spi { most_hz, mode },
            Setting::Spi { clock_hz, fastest_hz, mode: found },
        ) => {
            // Dividers are powers of 2, so a clock above half of the allowed one is always possible.
            let least_hz = (most_hz / 2).min(fastest_hz);
            mode == found && (least_hz..=most_hz).contains(&clock_hz)
        }
        // A driver that only divides without a remainder may have to stay below the allowed speed.
        (RequiredSettings::I2c { most_hz }, Setting::I2c { clock_hz, fastest_hz }) => {
            let most_hz = most_hz.min(fastest_hz);
            (most_hz / 2..=most_hz).contains(&clock_hz)
        }
        (RequiredSettings::Can { bitrate_hz }, Setting::Can { bitrate_hz: found }) => {
            bitrate_hz == found
        }
        (
            RequiredSettings::Serial { .. }
            | RequiredSettings::Spi { .. }
            | RequiredSettings::I2c { .. }
            | RequiredSettings::Can { .. },
            Setting::Serial { .. }
            | Setting::Spi { .. }
            | Setting::I2c { .. }
            | Setting::Can { .. },
        ) => false,
    }
}

fn serial(baud: u64, data_bits: u8, odd_parity: Option<bool>, stop_bits: u8) -> String {
    let parity = match odd_parity {
        None => 'N',
        Some(false) => 'E',
        Some(true) => 'O',
    };
    format!("at {baud} baud, {data_bits}{parity}{stop_bits}")
}

fn expected(wanted: RequiredSettings, state: Setting) -> String {
    match wanted {
        RequiredSettings::Serial { baud, data_bits, odd_parity, stop_bits } => {
            serial(baud, data_bits, odd_parity, stop_bits)
        }
        RequiredSettings::Spi { most_hz, mode } => {
            format!("at {} to {most_hz} Hz in mode {mode}", most_hz / 2)
        }
        RequiredSettings::I2c { most_hz } => {
            let most_hz = match state {
                Setting::I2c { fastest_hz, .. } => most_hz.min(fastest_hz),
                Setting::Serial { .. } | Setting::Spi { .. } | Setting::Can { .. } => most_hz,
            };
            format!("at {} to {most_hz} Hz", most_hz / 2)
        }
        RequiredSettings::Can { bitrate_hz } => format!("at {bitrate_hz} bit/s"),
    }
}

fn found(state: Setting) -> String {
    match state {
        Setting::Serial { baud, data_bits, odd_parity, stop_bits } => {
            serial(baud, data_bits, odd_parity, stop_bits)
        }
        Setting::Spi { clock_hz, mode, .. } => format!("at {clock_hz} Hz in mode {mode}"),
        Setting::I2c { clock_hz, .. } => format!("at {clock_hz} Hz"),
        Setting::Can { bitrate_hz } => format!("at {bitrate_hz} bit/s"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn is_mismatch(wanted: &[RequiredSettings], setting: Setting) -> bool {
        let [unit, title] = ["SPI2", "Angle"].map(str::to_owned);
        let planned = PlannedPort { unit: unit.clone(), title, wanted: wanted.to_vec() };
        !mismatches(&[planned], &[PortState { unit, setting }]).is_empty()
    }

    #[test]
    fn a_clock_of_spi_is_the_fastest_that_is_allowed() {
        let wanted = [RequiredSettings::Spi { most_hz: 1_000_000, mode: 1 }];
        let found = |clock_hz, mode| Setting::Spi { clock_hz, fastest_hz: 21_000_000, mode };
        assert!(!is_mismatch(&wanted, found(656_250, 1)));
        for (clock_hz, mode) in [(656_250, 0), (1_312_500, 1), (328_125, 1)] {
            assert!(is_mismatch(&wanted, found(clock_hz, mode)), "{clock_hz} Hz, {mode}");
        }
        // The port is not asked for more than it can do.
        let slow = Setting::Spi { clock_hz: 250_000, fastest_hz: 250_000, mode: 1 };
        assert!(!is_mismatch(&wanted, slow));
        // Each of two chips on one bus has its own setting.
        let both = [wanted[0], RequiredSettings::Spi { most_hz: 10_000_000, mode: 3 }];
        assert!(
            !is_mismatch(&both, found(5_250_000, 3)) && is_mismatch(&both, found(5_250_000, 1))
        );
    }

    #[test]
    fn characters_and_rates_are_compared() {
        let serial = |baud, odd_parity, stop_bits| Setting::Serial {
            baud,
            data_bits: 8,
            odd_parity,
            stop_bits,
        };
        let wanted = [RequiredSettings::Serial {
            baud: 115_200,
            data_bits: 8,
            odd_parity: None,
            stop_bits: 1,
        }];
        assert!(!is_mismatch(&wanted, serial(115_384, None, 1)));
        let wrong = [serial(57_692, None, 1), serial(115_384, Some(false), 1)];
        for setting in wrong.into_iter().chain([serial(115_384, None, 2)]) {
            assert!(is_mismatch(&wanted, setting), "{setting:?}");
        }
        let found = |clock_hz| Setting::I2c { clock_hz, fastest_hz: 400_000 };
        let bus = [RequiredSettings::I2c { most_hz: 400_000 }];
        assert!(!is_mismatch(&bus, found(280_000)));
        for clock_hz in [100_000, 410_000] {
            assert!(is_mismatch(&bus, found(clock_hz)), "{clock_hz}");
        }
        // A unit that is slower than its part runs at its own highest speed.
        let bus = [RequiredSettings::I2c { most_hz: 1_000_000 }];
        assert!(!is_mismatch(&bus, found(400_000)));
        for clock_hz in [100_000, 1_000_000] {
            assert!(is_mismatch(&bus, found(clock_hz)), "{clock_hz}");
        }
        let bus = [RequiredSettings::Can { bitrate_hz: 500_000 }];
        assert!(!is_mismatch(&bus, Setting::Can { bitrate_hz: 500_000 }));
        assert!(is_mismatch(&bus, Setting::Can { bitrate_hz: 250_000 }));
        assert!(is_mismatch(&bus, found(500_000)));
    }
}
