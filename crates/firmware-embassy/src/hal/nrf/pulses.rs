//! Pulses of the PWM units: up to four outputs a unit, which change together.

use sensedsl_job::snake;

use super::settings::Settings;
use super::timers::CLOCK_HZ;
use crate::context::Context;
use crate::hal::contract::outputs::{Output, Pins as _, Pulse, Pulses, Timer};
use crate::missing::{Missing, Printed};
use crate::section::Field;

/// The most steps that a unit counts in a period.
const COUNTS: u32 = 0x7FFF;
/// The greatest power of two by which its clock is divided.
const POWER: u8 = 7;

/// The power of two by which the clock is divided, and the steps of a period.
fn period(frequency_hz: u32) -> Option<(u8, u32)> {
    let counts = |power: u8| {
        let step_hz = CLOCK_HZ >> power;
        (step_hz + frequency_hz / 2) / frequency_hz.max(1)
    };
    let power = (0..=POWER).find(|power| counts(*power) <= COUNTS)?;
    (counts(power) > 1).then(|| (power, counts(power)))
}

impl Pulses for Settings {
    fn timer(&self, context: &Context<'_>, unit: &str, outputs: &[Output<'_>]) -> Printed<Timer> {
        let lacks_output = || Missing::wire(format!("an output of {unit}"));
        let first = outputs.first().ok_or_else(lacks_output)?;
        let (name, hal) = (snake(unit), context.peripheral(unit));
        let frequency_hz = first.pwm.frequency_hz;
        let (power, counts) = period(frequency_hz)
            .ok_or_else(|| Missing::unit(format!("{frequency_hz} pulses a second")))?;
        // Any pin can be any output, so those in use are the first ones.
        let mut ordered: Vec<&Output<'_>> = outputs.iter().collect();
        ordered.sort_by_key(|one| one.pulse.channel);
        let pins: Vec<String> =
            ordered.iter().map(|one| format!("p.{}", self.pin(one.pin))).collect();
        let channels = (0..4).map(|at| ordered.get(at).map_or(0, |one| one.pulse.channel));
        let channels: Vec<String> = channels.map(|channel| channel.to_string()).collect();
        let places: Vec<String> = outputs.iter().map(|one| one.wire.place()).collect();
        let field = Field {
            name,
            comment: format!("{unit}: {}", places.join("; ")),
            type_: "crate::rt::pwm::Pulses".to_owned(),
            make: format!(
                "crate::rt::pwm::Pulses::new(hal::pwm::SimplePwm::new_{}ch(p.{hal}, {}, \
                 &crate::rt::pwm::config({power}, {counts})), hal::pac::{hal}, [{}])",
                pins.len(),
                pins.join(", "),
                channels.join(", ")
            ),
        };
        Ok(Timer { fields: vec![field], hold: None })
    }

    fn set(&self, pulse: &Pulse, level: &str) -> String {
        let Pulse { name, channel, min_us, max_us, period_us, .. } = pulse;
        format!("outputs.{name}.set({channel}, [{min_us}, {max_us}, {period_us}], {level});")
    }

    fn apply(&self, pulse: &Pulse) -> Option<String> {
        Some(format!("outputs.{}.apply();", pulse.name))
    }

    /// The unit takes new levels at the end of a period alone.
    fn stop(&self, pulse: &Pulse) -> String {
        format!("{} outputs.{}.apply();", self.set(pulse, "0"), pulse.name)
    }
}

#[cfg(test)]
mod tests {
    use super::period;

    #[test]
    fn periods_are_as_fine_as_a_unit_makes_them() {
        assert_eq!(period(50), Some((4, 20_000)));
        assert_eq!(period(20_000), Some((0, 800)));
        assert_eq!(period(4), Some((7, 31_250)));
        assert_eq!(period(3), None);
        assert_eq!(period(16_000_000), None);
    }
}
