//! `pwm`: a timer output; the outputs of one timer share its frequency.

use sensedsl_board::profile::Timer;
use sensedsl_board::signal::TimerLine;
use sensedsl_board::silicon::Ability;
use sensedsl_model::kind::pwm::Pwm;
use sensedsl_model::kind::{Kind, Role};

use super::timers::{Channel, TimerUse};
use super::{Alternatives, Maker, Served};

impl Served for Pwm {
    fn ways(&self, maker: &mut Maker<'_, '_>) -> Vec<Alternatives> {
        let shared_hz = Some(self.frequency_hz);
        maker.timers(&TimerUse { wires: &[(Role::Out, None)], takes, shared_hz })
    }

    fn frequency_hz(&self) -> Option<u32> {
        Some(self.frequency_hz)
    }

    fn retuned(&self, hz: u32) -> Option<Kind> {
        Some(Kind::Pwm(Pwm { frequency_hz: hz, ..self.clone() }))
    }
}

fn takes(_: Option<&Ability>, timer: Option<&Timer>, channel: Channel<'_>) -> bool {
    let driver = timer.map(|timer| timer.pwm.as_ref());
    match channel.line {
        TimerLine::Both | TimerLine::Output => driver.is_none_or(|driver| {
            driver.is_some_and(|driver| driver.channels.contains(&channel.number))
        }),
        TimerLine::Inverted => {
            let driver = driver.flatten();
            driver.is_some_and(|driver| driver.complementary.contains(&channel.number))
        }
        TimerLine::Input => false,
    }
}
