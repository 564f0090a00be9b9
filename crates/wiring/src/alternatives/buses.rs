//! Buses and serial ports: all wires of one instance of a peripheral.

use sensedsl_board::pin::natural;
use sensedsl_board::signal::UnitName;
use sensedsl_board::table::Usage;
use sensedsl_model::kind::Role;

use super::candidates::Need;
use super::{Alternatives, Maker, unit_fits};
use crate::names::{Group, Resource};

/// How a device uses an instance of a peripheral.
pub(super) struct Bus {
    /// The instance to which a usage belongs, and which of its wires the usage is.
    pub(super) wire: fn(&Usage) -> Option<(&UnitName, Role)>,
    /// How devices share it.
    pub(super) sharing: Sharing,
    /// The address that no other device on it may have.
    pub(super) address: Option<u8>,
}

/// How the devices on one peripheral instance share it.
pub(super) enum Sharing {
    /// Not at all.
    Exclusive,
    /// As a bus; the number is a setting on which they must agree.
    Bus(u32),
}

impl Maker<'_, '_> {
    /// The alternatives on all instances.
    pub(super) fn units(&mut self, bus: &Bus) -> Vec<Alternatives> {
        let mut made = Vec::new();
        for unit in self.unit_names(bus) {
            let known = self.profile().is_none_or(|profile| profile.unit(&unit).is_some());
            if known && unit_fits(self.offer, self.wanted, &unit) {
                made.extend(self.unit(bus, &unit));
            }
        }
        made
    }

    fn unit(&mut self, bus: &Bus, unit: &str) -> Vec<Alternatives> {
        let board = self.offer.index;
        let names = &mut self.builder.names;
        let address = bus.address.map(|at| Resource::Address(board, unit.to_owned(), at));
        let mut claims: Vec<_> = address.into_iter().map(|address| names.own(address)).collect();
        let resource = Resource::Unit(board, unit.to_owned());
        let group = match bus.sharing {
            Sharing::Exclusive => {
                claims.push(names.own(resource));
                None
            }
            Sharing::Bus(setting) => {
                let kind = self.wanted.kind.name();
                let group = Group::Bus(board, unit.to_owned(), kind, setting);
                claims.push(names.shared(resource, group.clone()));
                Some(group)
            }
        };
        let roles = self.wanted.kind.roles(self.wanted.direction);
        let roles = roles.into_iter().map(|role| {
            if role.is_on_any_pin() {
                // A chip select is the device's own; what says who has the line is the line's.
                let shared = group.as_ref().filter(|_| role == Role::Direction);
                return self.role(role, &Need::Gpio, shared.map(|group| (unit, group)));
            }
            let serves = |usage: &Usage| {
                (bus.wire)(usage).is_some_and(|(of, wire)| of.as_str() == unit && wire == role)
            };
            self.role(role, &Need::Usage(&serves), group.as_ref().map(|group| (unit, group)))
        });
        let roles: Vec<_> = roles.collect();
        self.finish(Some(unit), &claims, roles)
    }

    /// The instances that the offered pins name, in natural order.
    fn unit_names(&self, bus: &Bus) -> Vec<String> {
        let roles = self.wanted.kind.roles(self.wanted.direction);
        let usages = self.offer.pins().flat_map(|(_, pin)| &pin.usages);
        let wires = usages.filter_map(bus.wire).filter(|(_, wire)| roles.contains(wire));
        let mut names: Vec<String> = wires.map(|(unit, _)| unit.to_string()).collect();
        names.sort_by(|a, b| natural(a, b));
        names.dedup();
        names
    }
}
