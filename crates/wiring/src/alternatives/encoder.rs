//! `encoder`: the first two channels of one timer, which it takes, a state machine, or a handler of
//! the interrupts of two pins.

use sensedsl_board::profile::Timer;
use sensedsl_board::silicon::Ability;
use sensedsl_model::design::Board;
use sensedsl_model::kind::Role;
use sensedsl_model::kind::encoder::Encoder;

use super::timers::{Channel, TimerUse};
use super::{Alternatives, Maker, Served};

impl Served for Encoder {
    fn ways(&self, maker: &mut Maker<'_, '_>) -> Vec<Alternatives> {
        let wires = &[(Role::A, Some(1)), (Role::B, Some(2))];
        let mut all = maker.timers(&TimerUse { wires, takes, shared_hz: None });
        all.extend(maker.machines("decoder", &[Role::A, Role::B]));
        all.extend(maker.handlers(&[Role::A, Role::B]));
        all
    }

    fn ability(&self, board: &Board) -> Option<&'static Ability> {
        board.silicon()?.timers.encoder.as_ref()
    }

    fn takes_handlers(&self) -> bool {
        true
    }

    fn takes_machines(&self) -> bool {
        true
    }

    fn takes_whole_timer(&self) -> bool {
        true
    }
}

fn takes(ability: Option<&Ability>, timer: Option<&Timer>, channel: Channel<'_>) -> bool {
    timer.is_none_or(|timer| timer.encoder) && channel.captures(ability)
}
