//! Timers: capture, encoders, pulses.

use std::collections::BTreeSet;

use sensedsl_board::profile::Timer;
use sensedsl_board::signal::Function;
use sensedsl_board::table::Usage;
use sensedsl_model::kind::Role;

use super::candidates::Need;
use super::cases::MadeRole;
use super::{Made, Maker, unit_fits};
use crate::names::{Group, Resource};

impl Maker<'_, '_> {
    /// Timers: whole ones where a driver takes them whole, channels in the pure pin model.
    pub(super) fn timers(&mut self, using: TimerUse) -> Vec<Made> {
        let whole = self.profile().is_some();
        let (offer, wanted) = (self.offer, self.wanted);
        if !whole && using != TimerUse::Encoder {
            let serves = |usage: &Usage| {
                channel(usage).is_some_and(|(timer, channel)| {
                    using.takes(None, channel) && unit_fits(offer, wanted, &format!("TIM{timer}"))
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

    pub(super) fn timer(
        &mut self,
        using: TimerUse,
        number: u8,
        unit: &str,
        timer: Option<&Timer>,
    ) -> Vec<Made> {
        let on = |wanted: Option<u8>| {
            move |usage: &Usage| {
                channel(usage).is_some_and(|(of, channel)| {
                    of == number
                        && using.takes(timer, channel)
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

    /// Whether the channel can be used; without a timer's facts what the hardware has in general.
    pub(super) fn takes(self, timer: Option<&Timer>, channel: u8) -> bool {
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

/// Timer and channel of a timer's plain output or input.
pub(super) fn channel(usage: &Usage) -> Option<(u8, u8)> {
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
