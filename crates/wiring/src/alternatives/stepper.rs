//! `stepper`: an output of a timer, which it takes, and any pins beside it.

use sensedsl_board::profile::Timer;
use sensedsl_board::signal::TimerLine;
use sensedsl_board::silicon::Ability;
use sensedsl_model::kind::Role;
use sensedsl_model::kind::stepper::Stepper;

use super::timers::{Channel, TimerUse};
use super::{Alternatives, Maker, Served};

impl Served for Stepper {
    fn ways(&self, maker: &mut Maker<'_, '_>) -> Vec<Alternatives> {
        maker.timers(&TimerUse { wires: &[(Role::Step, None)], takes, shared_hz: None })
    }
}

/// The time from a step to the next one is the timer's period, which an interrupt sets at each step; the other channels
/// can serve nobody.
fn takes(_: Option<&Ability>, timer: Option<&Timer>, channel: Channel<'_>) -> bool {
    let is_output = matches!(channel.line, TimerLine::Both | TimerLine::Output);
    is_output
        && timer.is_none_or(|timer| {
            let driver = timer.pwm.as_ref().filter(|_| timer.interrupt);
            driver.is_some_and(|driver| driver.channels.contains(&channel.number))
        })
}
