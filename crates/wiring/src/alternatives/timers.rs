//! Timers: capture, encoders, pulses.

use std::collections::BTreeSet;

use sensedsl_board::profile::Timer;
use sensedsl_board::signal::{Function, TimerLine, UnitName};
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
                channel(usage).is_some_and(|channel| {
                    using.takes(ability, None, channel)
                        && unit_fits(offer, wanted, channel.unit.as_str())
                })
            };
            let mut roles = vec![self.role(using.role(), &Need::Usage(&serves), None)];
            self.push_trigger(&mut roles);
            return self.finish(None, &[], roles);
        }
        let mut made = Vec::new();
        for unit in self.timer_names() {
            let unit = unit.as_str();
            let timer = self.profile().and_then(|profile| profile.timer(unit)).cloned();
            if !unit_fits(self.offer, self.wanted, unit) || (whole && timer.is_none()) {
                continue;
            }
            made.extend(self.timer(using, unit, timer.as_ref()));
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
        unit: &str,
        timer: Option<&Timer>,
    ) -> Vec<Made> {
        let ability = using.ability(self.offer.board);
        let on = |wanted: Option<u8>| {
            move |usage: &Usage| {
                channel(usage).is_some_and(|channel| {
                    channel.unit.as_str() == unit
                        && using.takes(ability, timer, channel)
                        && wanted.is_none_or(|wanted| wanted == channel.number)
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
    pub(super) fn timer_names(&self) -> BTreeSet<UnitName> {
        let usages = self.offer.pins().flat_map(|(_, pin)| &pin.usages);
        usages.filter_map(|usage| channel(usage).map(|channel| channel.unit.clone())).collect()
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
        channel: Channel<'_>,
    ) -> bool {
        let able = match self {
            Self::Icu | Self::Encoder => channel.captures(ability),
            Self::Pwm(_) => channel.line.is_output(),
        };
        let channel = channel.number;
        if !able {
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

/// A timer's channel at a pin.
#[derive(Clone, Copy)]
pub(crate) struct Channel<'a> {
    pub(crate) unit: &'a UnitName,
    number: u8,
    line: TimerLine,
}

impl Channel<'_> {
    /// Whether it can be an input of the timer, as far as the silicon goes.
    pub(crate) fn captures(self, ability: Option<&Ability>) -> bool {
        let able = ability.is_none_or(|ability| ability.channels.contains(&self.number));
        able && self.line.is_input()
    }
}

/// The timer's channel that a usage is; inverted outputs serve nothing.
pub(crate) fn channel(usage: &Usage) -> Option<Channel<'_>> {
    match usage.signal.function() {
        Function::Timer { line: TimerLine::Inverted, .. } => None,
        Function::Timer { unit, channel, line } => {
            Some(Channel { unit, number: *channel, line: *line })
        }
        Function::Adc { .. }
        | Function::I2c { .. }
        | Function::Uart { .. }
        | Function::Spi { .. }
        | Function::Can { .. }
        | Function::Dac { .. }
        | Function::Other => None,
    }
}
