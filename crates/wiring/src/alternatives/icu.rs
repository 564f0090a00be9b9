//! `icu`: an input-capture channel, whose whole timer a driver takes, a state machine, or a
//! handler of a pin's interrupts.

use sensedsl_board::profile::Timer;
use sensedsl_board::silicon::Ability;
use sensedsl_model::design::Board;
use sensedsl_model::kind::Role;
use sensedsl_model::kind::icu::{Icu, Mode};

use super::timers::{Channel, TimerUse};
use super::{Alternatives, Maker, Served};

/// The channels with which a timer can be both reset and captured.
const CHANNELS: [u8; 2] = [1, 2];

impl Served for Icu {
    fn ways(&self, maker: &mut Maker<'_, '_>) -> Vec<Alternatives> {
        let is_gated = matches!(self.mode, Mode::Width | Mode::Count);
        let gates = maker.profile().is_some_and(|all| all.timers.iter().any(|timer| timer.gate));
        let mut all = Vec::new();
        if is_gated || !gates {
            all = maker.timers(&TimerUse { wires: &[(Role::In, None)], takes, shared_hz: None });
        }
        if self.mode != Mode::Count {
            all.extend(maker.machines("capture", &[Role::In]));
        }
        all.extend(maker.handlers(&[Role::In]));
        all
    }

    fn takes_handlers(&self) -> bool {
        true
    }

    fn takes_machines(&self) -> bool {
        self.mode != Mode::Count
    }

    fn ability(&self, board: &Board) -> Option<&'static Ability> {
        board.silicon()?.timers.capture.as_ref()
    }
}

fn takes(ability: Option<&Ability>, timer: Option<&Timer>, channel: Channel<'_>) -> bool {
    let driven = match timer {
        None => CHANNELS.contains(&channel.number),
        Some(timer) => {
            timer.icu.as_ref().is_some_and(|driver| driver.channels.contains(&channel.number))
        }
    };
    driven && channel.captures(ability)
}
