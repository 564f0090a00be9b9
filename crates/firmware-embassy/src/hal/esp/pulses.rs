//! Pulses of the LED controller: two channels behind each of its timers.

use sensedsl_job::snake;

use super::settings::Settings;
use crate::context::Context;
use crate::hal::contract::outputs::{Output, Pulse, Pulses, Timer};
use crate::missing::{Missing, Printed};
use crate::section::Field;

/// The clock of the controller.
const CLOCK_HZ: u64 = 80_000_000;
/// The most steps of a period, as a power of two.
const BITS: u8 = 14;
/// The divisors of the clock, in 256ths.
const DIVISORS: std::ops::RangeInclusive<u64> = 0x100..=0x3_FFFF;

/// The power of two that a period has in steps, and the divisor of the clock in 256ths.
fn period(frequency_hz: u32) -> Option<(u8, u64)> {
    let divisor = |bits: u8| {
        let step_hz = u64::from(frequency_hz.max(1)) << bits;
        ((CLOCK_HZ << 8) + step_hz / 2) / step_hz
    };
    (1..=BITS).rev().map(|bits| (bits, divisor(bits))).find(|(_, own)| DIVISORS.contains(own))
}

/// The controller's number of a channel, which is counted from 1 elsewhere.
fn channel(pulse: &Pulse) -> u8 {
    pulse.channel.saturating_sub(1)
}

impl Pulses for Settings {
    fn timer(&self, _context: &Context<'_>, unit: &str, outputs: &[Output<'_>]) -> Printed<Timer> {
        let lacks_output = || Missing::wire(format!("an output of {unit}"));
        let first = outputs.first().ok_or_else(lacks_output)?;
        let frequency_hz = first.pwm.frequency_hz;
        let (bits, divisor) = period(frequency_hz)
            .ok_or_else(|| Missing::unit(format!("{frequency_hz} pulses a second")))?;
        let number = unit.trim_start_matches(|c: char| c.is_ascii_alphabetic());
        let channels = (0..2).map(|at| match outputs.get(at) {
            Some(one) => format!("Some(({}, p.{}.into()))", channel(&one.pulse), one.pin),
            None => "None".to_owned(),
        });
        let channels: Vec<String> = channels.collect();
        let places: Vec<String> = outputs.iter().map(|one| one.wire.place()).collect();
        let field = Field {
            name: snake(unit),
            comment: format!("{unit}: {}", places.join("; ")),
            type_: "crate::rt::pwm::Pulses".to_owned(),
            make: format!(
                "{{ static TIMER: static_cell::StaticCell<crate::rt::pwm::Timer> = static_cell::StaticCell::new(); \
                 crate::rt::pwm::Pulses::new(TIMER.init(crate::rt::pwm::timer({number}, {bits}, {divisor})), {bits}, \
                 [{}]) }}",
                channels.join(", ")
            ),
        };
        Ok(Timer { fields: vec![field], hold: None })
    }

    fn set(&self, pulse: &Pulse, level: &str) -> String {
        let Pulse { name, min_us, max_us, period_us, .. } = pulse;
        let channel = channel(pulse);
        format!("outputs.{name}.set({channel}, [{min_us}, {max_us}, {period_us}], {level});")
    }
}

#[cfg(test)]
mod tests {
    use super::period;

    #[test]
    fn periods_are_as_fine_as_the_controller_makes_them() {
        assert_eq!(period(50), Some((14, 25_000)));
        assert_eq!(period(20_000), Some((11, 500)));
        assert_eq!(period(5), Some((14, 250_000)));
        assert_eq!(period(4), None);
        assert_eq!(period(40_000_000), Some((1, 256)));
        assert_eq!(period(80_000_000), None);
    }
}
