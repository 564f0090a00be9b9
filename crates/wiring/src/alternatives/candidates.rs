//! The pins that one wire of a device may have, and what each of them claims.

use sensedsl_board::place::Place;
use sensedsl_board::remap::Blocks;
use sensedsl_board::signal::{Function, TimerLine};
use sensedsl_board::table::{Pin, Usage};
use sensedsl_model::kind::{Role, Sharing};
use sensedsl_solve::problem::{Candidate, Claim, Holder, Role as SolverRole, RuleId};

use super::Maker;
use crate::builder::{Chosen, GPIO};
use crate::levels::{Tolerates, stands};
use crate::names::{Group, Resource};
use crate::offer::Offer;
use crate::requested::RequestedWires;

impl Maker<'_, '_> {
    /// The candidates of one role. `bus` is set for a wire that devices share.
    pub(super) fn role(
        &mut self,
        role: Role,
        need: &Need<'_>,
        bus: Option<(&str, &Group)>,
    ) -> (SolverRole, Vec<Chosen>) {
        let mut made: Vec<(Candidate, Chosen)> = Vec::new();
        let (offer, wanted) = (self.offer, self.wanted);
        // A pin on an on-board bus is only for devices that join the bus.
        let joins_buses = wanted.kind.name().spec().sharing != Sharing::Own;
        for (index, pin) in offer.pins().filter(|(_, pin)| pin_fits(offer, wanted, role, pin)) {
            match need {
                Need::Usage(serves) => {
                    for (at, usage) in pin.usages.iter().enumerate() {
                        if serves(usage) && (!offer.bus_only(pin) || joins_buses) {
                            made.push(self.with_signal(role, (index, pin), (at, usage), bus));
                        }
                    }
                }
                Need::Reached(reaches, reads) => {
                    let usage = pin.usages.iter().enumerate().find(|(_, usage)| reads(usage));
                    if let Some(usage) = usage.filter(|_| reaches(pin) && !offer.bus_only(pin)) {
                        made.push(self.reached(role, (index, pin), usage));
                    }
                }
                Need::Gpio | Need::Interrupt | Need::Shared(_) => {
                    let interrupt = matches!(need, Need::Interrupt);
                    let has_line = !interrupt || offer.interrupts_at(pin);
                    if has_line && !offer.bus_only(pin) && offer.is_gpio(pin, role) {
                        let (mut candidate, chosen) = self.bare(role, index, pin, interrupt);
                        let shared = match (need, bus) {
                            (Need::Shared(wire), _) => {
                                let kind = wanted.kind.name();
                                Some((*wire, Group::Bus(offer.index, (*wire).to_owned(), kind, 0)))
                            }
                            (_, Some((unit, group))) => Some((unit, group.clone())),
                            (_, None) => None,
                        };
                        if let Some((unit, group)) = shared {
                            self.share(&mut candidate, role, index, (unit, group));
                        }
                        made.push((candidate, chosen));
                    }
                }
            }
        }
        made.sort_by_key(|(candidate, _)| (candidate.pin, candidate.signal));
        let (candidates, chosen) = made.into_iter().unzip();
        (SolverRole { candidates }, chosen)
    }

    pub(super) fn with_signal(
        &mut self,
        role: Role,
        (index, pin): (usize, &Pin),
        (at, usage): (usize, &Usage),
        bus: Option<(&str, &Group)>,
    ) -> (Candidate, Chosen) {
        let board = self.offer.index;
        let (holder, claim) = match bus {
            Some((unit, group)) => {
                let wire = Resource::BusWire(board, unit.to_owned(), role);
                let on = Group::Pin(board, unit.to_owned(), role, index, at);
                let holder = self.builder.names.group(group.clone());
                (holder, self.builder.names.shared(wire, on))
            }
            None => {
                let signal = Resource::Signal(board, claimed(usage).to_owned());
                (Holder::Own, self.builder.names.own(signal))
            }
        };
        let mut claims = vec![claim];
        claims.extend(self.pad(index));
        claims.extend(self.remap(usage));
        let own = Candidate::new(
            self.builder.pin(board, index),
            self.builder.signal(usage.signal.name()),
        );
        let violates = self.violates(role, pin, Some(usage));
        let candidate = Candidate { holder, claims, violates, ..own };
        (candidate, Chosen { pin: index, usage: Some(at) })
    }

    /// Lets all devices of a bus have a wire without a signal, at one pin.
    fn share(
        &mut self,
        candidate: &mut Candidate,
        role: Role,
        pin: usize,
        (unit, group): (&str, Group),
    ) {
        let board = self.offer.index;
        let wire = Resource::BusWire(board, unit.to_owned(), role);
        let on = Group::Pin(board, unit.to_owned(), role, pin, 0);
        candidate.holder = self.builder.names.group(group);
        candidate.claims.push(self.builder.names.shared(wire, on));
    }

    /// A signal that any number of pins may have at once.
    fn reached(
        &mut self,
        role: Role,
        (index, pin): (usize, &Pin),
        (at, usage): (usize, &Usage),
    ) -> (Candidate, Chosen) {
        let own = Candidate::new(
            self.builder.pin(self.offer.index, index),
            self.builder.signal(usage.signal.name()),
        );
        let claims = self.pad(index).into_iter().collect();
        let violates = self.violates(role, pin, Some(usage));
        (Candidate { claims, violates, ..own }, Chosen { pin: index, usage: Some(at) })
    }

    pub(super) fn bare(
        &mut self,
        role: Role,
        index: usize,
        pin: &Pin,
        interrupt: bool,
    ) -> (Candidate, Chosen) {
        let board = self.offer.index;
        let line = self.profile().and_then(|profile| profile.exti_group(&pin.name));
        let mut claims = Vec::new();
        if let Some(line) = line.filter(|_| interrupt) {
            claims.push(self.builder.names.own(Resource::Exti(board, line)));
        }
        claims.extend(self.pad(index));
        let own = Candidate::new(self.builder.pin(board, index), self.builder.signal(GPIO));
        let candidate = Candidate { claims, violates: self.violates(role, pin, None), ..own };
        (candidate, Chosen { pin: index, usage: None })
    }

    /// The claim of a contact that the pin shares with others: only one of them can be in use.
    pub(super) fn pad(&mut self, pin: usize) -> Option<Claim> {
        let board = self.offer.index;
        let pad = Resource::Pad(board, self.offer.shared_pad(pin)?.to_owned());
        Some(self.builder.names.shared(pad, Group::Pad(board, pin)))
    }

    /// The claims of a usage that is on its pin only in some remap blocks of its peripheral: they
    /// exclude usages that are in none of these blocks.
    pub(super) fn remap(&mut self, usage: &Usage) -> Vec<Claim> {
        let board = self.offer.index;
        let Some((unit, blocks)) = self.offer.blocks(usage) else { return Vec::new() };
        let others = self.offer.other_blocks(&unit, blocks);
        let claim = |other: Blocks| {
            let (first, second) = (blocks.min(other), blocks.max(other));
            let resource = Resource::Remap(board, unit.clone(), first, second);
            self.builder.names.shared(resource, Group::Blocks(board, unit.clone(), blocks))
        };
        others.into_iter().map(claim).collect()
    }

    pub(super) fn violates(&self, role: Role, pin: &Pin, usage: Option<&Usage>) -> Vec<RuleId> {
        self.rules.violated_by(self.offer, role, pin, usage, self.channels())
    }
}

/// The signal that a usage takes: a channel and its complement have one pulse width.
fn claimed(usage: &Usage) -> &str {
    let name = usage.signal.name();
    match usage.signal.function() {
        Function::Timer { line: TimerLine::Inverted, .. } => name.strip_suffix('N').unwrap_or(name),
        Function::Timer { .. }
        | Function::Adc { .. }
        | Function::Dac { .. }
        | Function::I2c { .. }
        | Function::Spi { .. }
        | Function::Uart { .. }
        | Function::Can { .. }
        | Function::Pio { .. }
        | Function::Other => name,
    }
}

/// The requirement of a role on a pin.
pub(super) enum Need<'n> {
    /// A usage for which the function holds.
    Usage(&'n dyn Fn(&Usage) -> bool),
    /// The usage for which the second function holds, of a pin for which the first one does.
    Reached(&'n dyn Fn(&Pin) -> bool, &'n dyn Fn(&Usage) -> bool),
    /// Nothing: any pin that has a digital circuit.
    Gpio,
    /// Any pin that has a digital circuit, and the interrupt line of its number.
    Interrupt,
    /// Any pin that has a digital circuit, the same for all who share the wire of that name.
    Shared(&'n str),
}

/// Whether the pin is where the device must be.
pub(super) fn pin_fits(
    offer: &Offer<'_>,
    wanted: &RequestedWires<'_>,
    role: Role,
    pin: &Pin,
) -> bool {
    let is_there = |place: &Place| {
        wanted.side.is_none_or(|side| place.is_at_side(side))
            && wanted.header.is_none_or(|header| place.is_at_header(header))
    };
    let is_anywhere = wanted.side.is_none() && wanted.header.is_none();
    wanted.fixed(role).is_none_or(|fixed| fixed.on(offer.index) == Some(&pin.name))
        && (is_anywhere || pin.places.iter().any(is_there))
        && stands_level(offer, wanted, role, pin)
}

fn stands_level(offer: &Offer<'_>, wanted: &RequestedWires<'_>, role: Role, pin: &Pin) -> bool {
    let Some(mv) = wanted.level_mv.filter(|_| role.is_driven_by_device()) else { return true };
    !matches!(stands(offer.board, pin, wanted.kind, mv), Tolerates::No(_))
}
