//! Timers: whole timers if a driver takes them whole, channels in the pure pin model.

use std::collections::BTreeSet;

use sensedsl_board::profile::Timer;
use sensedsl_board::signal::{Function, TimerLine, UnitName};
use sensedsl_board::silicon::Ability;
use sensedsl_board::table::Usage;
use sensedsl_model::kind::Role;

use super::candidates::Need;
use super::cases::RoleCandidates;
use super::{Alternatives, Maker, served, unit_fits};
use crate::names::{Group, Resource};
use crate::wishes::Channels;

/// A device's use of a timer.
pub(super) struct TimerUse {
    /// The wires that are channels, each with its number if only one will do.
    pub(super) wires: &'static [(Role, Option<u8>)],
    /// Whether a channel can be used, given the ability of the silicon and the facts of the timer.
    pub(super) takes: fn(Option<&Ability>, Option<&Timer>, Channel<'_>) -> bool,
    /// The frequency at which devices share the timer; `None` if a device takes it alone.
    pub(super) shared_hz: Option<u32>,
}

impl Maker<'_, '_> {
    pub(super) fn timers(&mut self, using: &TimerUse) -> Vec<Alternatives> {
        let whole = self.profile().is_some();
        let (offer, wanted) = (self.offer, self.wanted);
        if self.channels() == Channels::Single {
            let ability = served(wanted.kind).ability(offer.board);
            let serves = |usage: &Usage| {
                channel(usage).is_some_and(|channel| {
                    (using.takes)(ability, None, channel)
                        && unit_fits(offer, wanted, channel.unit.as_str())
                })
            };
            let wires = using.wires.iter();
            let mut roles = wires
                .map(|(role, _)| self.role(*role, &Need::Usage(&serves), None))
                .collect::<Vec<_>>();
            self.push_gpios(&mut roles);
            return self.finish(None, &[], roles);
        }
        let mut made = Vec::new();
        for unit in self.timer_names() {
            let unit = unit.as_str();
            let timer = self.profile().and_then(|profile| profile.timer(unit)).cloned();
            let slowest_hz = timer.as_ref().and_then(|timer| timer.slowest_hz);
            let is_too_fast = slowest_hz > using.shared_hz && using.shared_hz.is_some();
            if !unit_fits(self.offer, self.wanted, unit)
                || (whole && timer.is_none())
                || is_too_fast
            {
                continue;
            }
            made.extend(self.timer(using, unit, timer.as_ref()));
        }
        made
    }

    /// Drivers take timers whole, and so does a kind that needs several channels of one.
    pub(super) fn channels(&self) -> Channels {
        let is_whole = self.profile().is_some() || self.are_timers_shared();
        if is_whole || served(self.wanted.kind).takes_whole_timer() {
            Channels::OfWholeTimer
        } else {
            Channels::Single
        }
    }

    /// Whether timers are claimed without a system that drives them.
    fn are_timers_shared(&self) -> bool {
        self.offer.board.silicon().is_some_and(|silicon| silicon.timers.are_shared)
    }

    fn timer(&mut self, using: &TimerUse, unit: &str, timer: Option<&Timer>) -> Vec<Alternatives> {
        let ability = served(self.wanted.kind).ability(self.offer.board);
        let on = |role: Role, wanted: Option<u8>| {
            // A complementary output is only for a device that names its pin.
            let is_named = self.wanted.fixed(role).is_some();
            move |usage: &Usage| {
                channel(usage).is_some_and(|channel| {
                    channel.unit.as_str() == unit
                        && (is_named || channel.line != TimerLine::Inverted)
                        && (using.takes)(ability, timer, channel)
                        && wanted.is_none_or(|wanted| wanted == channel.number)
                })
            }
        };
        let wires: Vec<_> =
            using.wires.iter().map(|(role, number)| (*role, on(*role, *number))).collect();
        let mut roles = wires
            .iter()
            .map(|(role, on)| self.role(*role, &Need::Usage(on), None))
            .collect::<Vec<_>>();
        self.push_gpios(&mut roles);
        let board = self.offer.index;
        let resource = Resource::Unit(board, unit.to_owned());
        let claim = match using.shared_hz {
            Some(frequency_hz) => {
                let group = Group::Frequency(board, unit.to_owned(), frequency_hz);
                self.builder.names.shared(resource, group)
            }
            None => self.builder.names.own(resource),
        };
        let is_claimed = timer.is_some() || self.are_timers_shared();
        let claims = if is_claimed { vec![claim] } else { Vec::new() };
        self.finish(Some(unit), &claims, roles)
    }

    pub(super) fn push_gpios(&mut self, roles: &mut Vec<RoleCandidates>) {
        let all = self.wanted.kind.roles(self.wanted.direction);
        for role in all.into_iter().filter(|role| role.is_on_any_pin()) {
            roles.push(self.role(role, &Need::Gpio, None));
        }
    }

    /// The timers that the offered pins name.
    fn timer_names(&self) -> BTreeSet<UnitName> {
        let usages = self.offer.pins().flat_map(|(_, pin)| &pin.usages);
        usages.filter_map(|usage| channel(usage).map(|channel| channel.unit.clone())).collect()
    }
}

/// A timer's channel at a pin.
#[derive(Clone, Copy)]
pub(crate) struct Channel<'a> {
    pub(crate) unit: &'a UnitName,
    pub(super) number: u8,
    pub(super) line: TimerLine,
}

impl Channel<'_> {
    /// Whether it can be an input of the timer, as far as the silicon allows.
    pub(crate) fn captures(self, ability: Option<&Ability>) -> bool {
        let able = ability.is_none_or(|ability| ability.is_of(self.unit.as_str(), self.number));
        able && self.line.is_input()
    }
}

/// The timer's channel that a usage is, or is the complement of.
pub(crate) fn channel(usage: &Usage) -> Option<Channel<'_>> {
    let Function::Timer { unit, channel, line } = usage.signal.function() else { return None };
    Some(Channel { unit, number: *channel, line: *line })
}
