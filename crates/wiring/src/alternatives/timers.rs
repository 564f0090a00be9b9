//! Timers: capture, encoders, pulses.

use std::collections::BTreeSet;

use sensedsl_board::profile::Timer;
use sensedsl_board::signal::Function;
use sensedsl_board::silicon::Ability;
use sensedsl_board::table::Usage;
use sensedsl_model::design::Board;
use sensedsl_model::kind::{Kind, KindName, Role};

use super::candidates::Need;
use super::cases::MadeRole;
use super::{Made, Maker, unit_fits};
use crate::names::{Group, Resource};
use crate::wishes::Channels;

impl Maker<'_, '_> {
    /// Timers: whole ones where a driver takes them whole, channels in the pure pin model.
    pub(super) fn timers(&mut self, using: TimerUse) -> Vec<Made> {
        let whole = self.profile().is_some();
        let (offer, wanted) = (self.offer, self.wanted);
        if self.channels() == Channels::Single {
            let ability = using.ability(offer.board);
            let serves = |usage: &Usage| {
                channel(usage).is_some_and(|(timer, channel)| {
                    using.takes(ability, None, channel)
                        && unit_fits(offer, wanted, &format!("TIM{timer}"))
                })
            };
            let mut roles = vec![self.role(using.role(), &Need::Usage(&serves), None)];
            self.push_trigger(&mut roles);
            return self.finish(None, &[], roles);
        }
        let mut made = Vec::new();
        for number in self.timer_numbers() {
            let unit = format!("TIM{number}");
            let timer = self.profile().and_then(|profile| profile.timer(number)).cloned();
            if !unit_fits(self.offer, self.wanted, &unit) || (whole && timer.is_none()) {
                continue;
            }
            made.extend(self.timer(using, number, &unit, timer.as_ref()));
        }
        made
    }

    /// Drivers take timers whole, and an encoder needs two channels of one.
    pub(super) fn channels(&self) -> Channels {
        if self.profile().is_some() || matches!(self.wanted.kind, Kind::Encoder(_)) {
            Channels::OfWholeTimer
        } else {
            Channels::Single
        }
    }

    pub(super) fn timer(
        &mut self,
        using: TimerUse,
        number: u8,
        unit: &str,
        timer: Option<&Timer>,
    ) -> Vec<Made> {
        let ability = using.ability(self.offer.board);
        let on = |wanted: Option<u8>| {
            move |usage: &Usage| {
                channel(usage).is_some_and(|(of, channel)| {
                    of == number
                        && using.takes(ability, timer, channel)
                        && wanted.is_none_or(|wanted| wanted == channel)
                })
            }
        };
        let mut roles = match using {
            TimerUse::Encoder => vec![
                self.role(Role::A, &Need::Usage(&on(Some(1))), None),
                self.role(Role::B, &Need::Usage(&on(Some(2))), None),
            ],
            TimerUse::Icu | TimerUse::Pwm(_) => {
                vec![self.role(using.role(), &Need::Usage(&on(None)), None)]
            }
        };
        self.push_trigger(&mut roles);
        let board = self.offer.index;
        let resource = Resource::Unit(board, unit.to_owned());
        let claim = match using {
            TimerUse::Pwm(frequency_hz) => {
                let group = Group::Frequency(board, unit.to_owned(), frequency_hz);
                self.builder.names.shared(resource, group)
            }
            TimerUse::Icu | TimerUse::Encoder => self.builder.names.own(resource),
        };
        let claims = if timer.is_some() { vec![claim] } else { Vec::new() };
        self.finish(Some(unit), &claims, roles)
    }

    pub(super) fn push_trigger(&mut self, roles: &mut Vec<MadeRole>) {
        if self.wanted.kind.roles(self.wanted.direction).contains(&Role::Trigger) {
            roles.push(self.role(Role::Trigger, &Need::Gpio, None));
        }
    }

    /// The timers that the offered pins name.
    pub(super) fn timer_numbers(&self) -> BTreeSet<u8> {
        let usages = self.offer.pins().flat_map(|(_, pin)| &pin.usages);
        usages.filter_map(|usage| channel(usage).map(|(timer, _)| timer)).collect()
    }
}

/// What a timer is taken for.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum TimerUse {
    Icu,
    Encoder,
    Pwm(u32),
}

impl TimerUse {
    pub(super) fn role(self) -> Role {
        match self {
            Self::Icu | Self::Encoder => Role::In,
            Self::Pwm(_) => Role::Out,
        }
    }

    /// What the board's silicon is able to, where that differs from most.
    fn ability(self, board: &Board) -> Option<&'static Ability> {
        match self {
            Self::Icu => ability(board, KindName::Icu),
            Self::Encoder => ability(board, KindName::Encoder),
            Self::Pwm(_) => None,
        }
    }

    /// Whether the channel can be used; without a timer's facts what the silicon can do.
    pub(super) fn takes(
        self,
        ability: Option<&Ability>,
        timer: Option<&Timer>,
        channel: u8,
    ) -> bool {
        if ability.is_some_and(|ability| !ability.channels.contains(&channel)) {
            return false;
        }
        match (self, timer) {
            (Self::Icu | Self::Encoder, None) => matches!(channel, 1 | 2),
            (Self::Pwm(_), None) => true,
            (Self::Icu, Some(timer)) => {
                timer.icu.as_ref().is_some_and(|driver| driver.channels.contains(&channel))
            }
            (Self::Encoder, Some(timer)) => timer.encoder && matches!(channel, 1 | 2),
            (Self::Pwm(_), Some(timer)) => {
                timer.pwm.as_ref().is_some_and(|driver| driver.channels.contains(&channel))
            }
        }
    }
}

/// Which channels of the board's timers can serve the kind, where its silicon differs from most.
pub(crate) fn ability(board: &Board, kind: KindName) -> Option<&'static Ability> {
    let timers = &board.silicon()?.timers;
    match kind {
        KindName::Icu => timers.capture.as_ref(),
        KindName::Encoder => timers.encoder.as_ref(),
        KindName::Analog
        | KindName::I2c
        | KindName::Digital
        | KindName::Uart
        | KindName::Spi
        | KindName::Pwm
        | KindName::Dac
        | KindName::Can => None,
    }
}

/// Timer and channel of a timer's plain output or input.
pub(crate) fn channel(usage: &Usage) -> Option<(u8, u8)> {
    match usage.signal.function() {
        Function::Timer { timer, channel, complementary: false } => Some((*timer, *channel)),
        Function::Timer { .. }
        | Function::Adc { .. }
        | Function::I2c { .. }
        | Function::Uart { .. }
        | Function::Spi { .. }
        | Function::Can { .. }
        | Function::Dac { .. }
        | Function::Other => None,
    }
}
