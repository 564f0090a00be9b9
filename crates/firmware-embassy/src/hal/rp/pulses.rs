//! Pulses of the slices of the PWM unit: two outputs a slice, which change together.

use sensedsl_job::snake;

use super::settings::Settings;
use crate::context::Context;
use crate::hal::contract::outputs::{Output, Pins as _, Pulse, Pulses, Timer};
use crate::missing::{Missing, Printed};
use crate::section::Field;

/// The most steps that a slice counts in a period.
const COUNTS: u32 = 65_535;
/// The greatest divider of a slice's clock.
const DIVIDER: u32 = 255;

/// The divider of a slice, and its last count.
fn period(clock_hz: u32, frequency_hz: u32) -> Option<(u32, u32)> {
    let frequency_hz = frequency_hz.max(1);
    let clocks = clock_hz / frequency_hz;
    let divider = clocks.div_ceil(COUNTS).max(1);
    let step_hz = clock_hz / divider;
    let counts = (step_hz + frequency_hz / 2) / frequency_hz;
    (divider <= DIVIDER && counts > 1).then(|| (divider, counts.min(COUNTS) - 1))
}

/// The clock of a slice.
pub(super) fn timer_hz(context: &Context<'_>, unit: &str) -> Printed<u32> {
    let clock = context.profile.timer(unit).map(|timer| timer.clock.as_str());
    let hz = clock.and_then(|clock| context.profile.clocks_hz.get(clock)).copied();
    hz.ok_or_else(|| Missing::name(format!("the clock of {unit}")))
}

impl Pulses for Settings {
    fn timer(&self, context: &Context<'_>, unit: &str, outputs: &[Output<'_>]) -> Printed<Timer> {
        let lacks_output = || Missing::wire(format!("an output of {unit}"));
        let first = outputs.first().ok_or_else(lacks_output)?;
        let (name, hal) = (snake(unit), context.peripheral(unit));
        let (clock_hz, frequency_hz) = (timer_hz(context, unit)?, first.pwm.frequency_hz);
        let (divider, top) = period(clock_hz, frequency_hz)
            .ok_or_else(|| Missing::unit(format!("{frequency_hz} pulses a second")))?;
        let pin = |channel: u8| {
            let own = outputs.iter().find(|one| one.pulse.channel == channel);
            own.map(|one| format!(", p.{}", self.pin(one.pin)))
        };
        let (which, pins) = match (pin(1), pin(2)) {
            (Some(a), Some(b)) => ("ab", a + &b),
            (Some(a), None) => ("a", a),
            (None, Some(b)) => ("b", b),
            (None, None) => return Err(lacks_output()),
        };
        let config = format!("crate::rt::pwm::config({divider}, {top})");
        let places: Vec<String> = outputs.iter().map(|one| one.wire.place()).collect();
        let field = Field {
            name,
            comment: format!("{unit}: {}", places.join("; ")),
            type_: "crate::rt::pwm::Slice".to_owned(),
            make: format!(
                "crate::rt::pwm::Slice::new(hal::pwm::Pwm::new_output_{which}(p.{hal}{pins}, {config}), {config})"
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

    fn stop(&self, pulse: &Pulse) -> String {
        let Pulse { name, channel, .. } = pulse;
        format!("outputs.{name}.stop({channel});")
    }
}

#[cfg(test)]
mod tests {
    use super::period;

    #[test]
    fn periods_are_as_fine_as_a_slice_makes_them() {
        assert_eq!(period(125_000_000, 50), Some((39, 64_102)));
        assert_eq!(period(125_000_000, 20_000), Some((1, 6_249)));
        assert_eq!(period(150_000_000, 8), None);
        assert_eq!(period(125_000_000, 8), Some((239, 65_376)));
        assert_eq!(period(125_000_000, 62_500_000), Some((1, 1)));
    }
}
