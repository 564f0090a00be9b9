//! Stepper motors: a timer with one output, which makes one pulse at a time.

use sensedsl_job::JobConnection;
use sensedsl_model::kind::Role;

use super::settings::Settings;
use crate::context::Context;
use crate::hal::contract::motors::{MotorTimer, Motors};
use crate::missing::{self, Printed};
use crate::section::Constructor;

/// The pulses a second that the HAL starts the timer with, which stops before the first one.
const FIRST_HZ: u32 = 1_000;

impl Motors for Settings {
    fn timer(&self, context: &Context<'_>, wire: &JobConnection<'_>) -> Printed<MotorTimer> {
        let (unit, pad) = (missing::unit(wire)?, missing::pad(wire, Role::Step)?);
        let (channel, hal) = (missing::channel(pad)?, context.peripheral(unit));
        // Timers without an interrupt of their own for it have one for everything.
        let interrupt = context.interrupt(unit, "UP").or_else(|_| context.interrupt(unit, "CC"))?;
        let slot = |number: u8| {
            if number == channel {
                format!(
                    "Some(hal::timer::simple_pwm::PwmPin::new(p.{}, OutputType::PushPull))",
                    pad.pin.name
                )
            } else {
                "None".to_owned()
            }
        };
        let slots: Vec<String> = (1..=4).map(slot).collect();
        let made = Constructor {
            type_: format!("hal::timer::simple_pwm::SimplePwm<'static, {hal}>"),
            make: format!(
                "hal::timer::simple_pwm::SimplePwm::new{}(p.{hal}, {}, hz({FIRST_HZ}), CountingMode::EdgeAlignedUp)",
                self.generics(context, unit, &[]),
                slots.join(", ")
            ),
        };
        Ok(MotorTimer { made, channel, interrupt: interrupt.to_owned() })
    }
}
