//! Pulses of timers: the outputs of one timer are one object of the HAL, without the complements of its channels.

use sensedsl_job::snake;

use super::settings::Settings;
use crate::context::Context;
use crate::hal::contract::outputs::{Hold, Output, Pulse, Pulses, Timer};
use crate::missing::{Missing, Printed};
use crate::section::Field;

impl Pulses for Settings {
    fn timer(&self, context: &Context<'_>, unit: &str, outputs: &[Output<'_>]) -> Printed<Timer> {
        let first = outputs.first();
        let first = first.ok_or_else(|| Missing::wire(format!("an output of {unit}")))?;
        let hal = context.peripheral(unit);
        let slots: Vec<String> = (1..=4).map(|channel| slot(outputs, channel)).collect();
        let places: Vec<String> = outputs.iter().map(|one| one.wire.place()).collect();
        let mut fields = vec![Field {
            name: snake(unit),
            comment: format!("{unit}: {}", places.join("; ")),
            type_: format!("hal::timer::simple_pwm::SimplePwm<'static, {hal}>"),
            make: format!(
                "hal::timer::simple_pwm::SimplePwm::new{}(p.{hal}, {}, hz({}), CountingMode::EdgeAlignedUp)",
                self.generics(context, unit, &[]),
                slots.join(", "),
                first.pwm.frequency_hz
            ),
        }];
        let complements = outputs.iter().filter(|one| one.pulse.is_complement);
        fields.extend(complements.map(|one| self.complement(context, unit, one)));
        let hold = Some(Hold { begin: hold(&hal, true), end: hold(&hal, false) });
        Ok(Timer { fields, hold })
    }

    fn set(&self, pulse: &Pulse, level: &str) -> String {
        let Pulse { name, channel, min_us, max_us, period_us, .. } = pulse;
        format!(
            "rt::pwm::set_width(&mut outputs.{name}.ch{channel}(), [{min_us}, {max_us}, {period_us}], {level}); {}",
            turn_on(pulse)
        )
    }

    fn stop(&self, pulse: &Pulse) -> String {
        let Pulse { name, timer, channel, .. } = pulse;
        let (bank, place) = ((channel - 1) / 2, (channel - 1) % 2);
        let preload = |is_on| {
            format!(
                "hal::pac::{timer}.ccmr_output({bank}).modify(|mode| mode.set_ocpe({place}, {is_on}));"
            )
        };
        format!(
            "{} outputs.{name}.ch{channel}().set_duty_cycle(0); {} {}",
            preload(false),
            turn_on(pulse),
            preload(true)
        )
    }
}

impl Settings {
    /// The pin of a channel's complement. The HAL's own driver turns each channel on together with its complement, and
    /// makes the one the opposite of the other; here the complement is alone, and is set as the channel would be.
    fn complement(&self, context: &Context<'_>, unit: &str, one: &Output<'_>) -> Field {
        let (hal, channel) = (context.peripheral(unit), one.pulse.channel);
        let types = ["'static", &hal, &format!("hal::timer::Ch{channel}")].map(str::to_owned);
        let types = self.generics(context, unit, &types.each_ref().map(String::as_str));
        let type_ = format!("hal::timer::complementary_pwm::ComplementaryPwmPin{types}");
        Field {
            name: format!("{}_ch{channel}n", snake(unit)),
            comment: one.wire.place(),
            make: format!("{type_}::new(p.{}, OutputType::PushPull)", one.pin),
            type_,
        }
    }
}

/// The constructor's argument for a channel.
fn slot(outputs: &[Output<'_>], channel: u8) -> String {
    let is_own = |one: &&Output<'_>| one.pulse.channel == channel && !one.pulse.is_complement;
    match outputs.iter().find(is_own) {
        Some(one) => format!(
            "Some(hal::timer::simple_pwm::PwmPin::new(p.{}, OutputType::PushPull))",
            one.pin
        ),
        None => "None".to_owned(),
    }
}

/// Keeps a timer from taking new levels, or lets it.
fn hold(hal: &str, is_held: bool) -> String {
    format!("hal::pac::{hal}.cr1().modify(|control| control.set_udis({is_held}));")
}

/// Turns an output on.
fn turn_on(pulse: &Pulse) -> String {
    let Pulse { name, timer, channel, .. } = pulse;
    if pulse.is_complement {
        let place = channel - 1;
        format!("hal::pac::{timer}.ccer().modify(|on| on.set_ccne({place}, true));")
    } else {
        format!("outputs.{name}.ch{channel}().enable();")
    }
}
