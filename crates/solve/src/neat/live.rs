//! What the wires of a part can still be: the domains in, sets of pins out.

use super::pins::PinSet;
use crate::domains::Domains;
use crate::index::RoleId;
use crate::model::Model;
use crate::problem::{DeviceId, Holder, PinId};
use std::collections::BTreeMap;

/// The pins that the wires of a part can still be on.
#[derive(Clone, Debug, Default)]
pub(super) struct Live {
    /// For each device, each of its alternatives, and each role of that.
    devices: Vec<Vec<Vec<PinSet>>>,
    /// For each wire that its device has for itself whatever alternative it takes.
    own: Vec<PinSet>,
    /// The work of finding all this out, a unit for about 50 ns.
    pub(super) made: u64,
}

impl Live {
    pub(super) fn new(model: &Model, domains: &Domains, devices: &[DeviceId]) -> Self {
        let mut live = Self::default();
        for &device in devices {
            let alts: Vec<Vec<RoleId>> = domains
                .alts(model, device)
                .map(|alt| model.roles.of(alt).iter().collect())
                .collect();
            let set = |role: &RoleId| {
                domains.cands(model, *role).map(|id| model.cand[id].pin).collect::<PinSet>()
            };
            let cands = alts.iter().flatten().map(|role| domains.cands_left(*role) as u64);
            live.made += cands.sum::<u64>() + 10;
            let least = alts.iter().map(Vec::len).min().unwrap_or(0);
            for position in 0..least {
                let roles = || alts.iter().filter_map(|roles| roles.get(position));
                let is_own = |role: &RoleId| {
                    domains.cands(model, *role).all(|id| model.cand[id].holder == Holder::Own)
                };
                if roles().all(is_own) {
                    let mut all = PinSet::default();
                    roles().for_each(|role| all.add_all(&set(role)));
                    live.own.push(all);
                }
            }
            let sets = alts.iter().map(|roles| roles.iter().map(set).collect());
            live.devices.push(sets.collect());
        }
        live
    }

    /// The most wires that the part can have.
    pub(super) fn most_wires(&self) -> usize {
        let of = |alts: &Vec<Vec<PinSet>>| alts.iter().map(Vec::len).max().unwrap_or(0);
        self.devices.iter().map(of).sum()
    }

    /// All pins that any of its wires can be on.
    pub(super) fn pins(&self) -> PinSet {
        let mut all = PinSet::default();
        self.devices.iter().flatten().flatten().for_each(|pins| all.add_all(pins));
        all
    }

    /// Whether the part may have all its wires on these pins. It may not even if this says so.
    pub(super) fn fits(&self, pins: &PinSet) -> bool {
        let fits = |roles: &Vec<PinSet>| roles.iter().all(|role| role.meets(pins));
        self.devices.iter().all(|alts| alts.iter().any(fits)) && self.own_fit(pins)
    }

    /// The work of asking whether it fits, a unit for about 50 ns.
    pub(super) fn work(&self) -> u64 {
        2 + 10 * self.own.len() as u64
    }

    /// Whether each wire that a device has for itself can have a pin of its own (J. Edmonds'
    /// augmenting paths, in the simple form of H. W. Kuhn).
    fn own_fit(&self, pins: &PinSet) -> bool {
        let mut taken = BTreeMap::new();
        self.own.len() < 2
            || (0..self.own.len()).all(|wire| {
                let mut tried = PinSet::default();
                self.place(wire, pins, &mut taken, &mut tried)
            })
    }

    fn place(
        &self,
        wire: usize,
        pins: &PinSet,
        taken: &mut BTreeMap<PinId, usize>,
        tried: &mut PinSet,
    ) -> bool {
        let Some(own) = self.own.get(wire) else { return false };
        for pin in own.common(pins) {
            if tried.has(pin) {
                continue;
            }
            tried.add(pin);
            let other = taken.get(&pin).copied();
            if other.is_none_or(|other| self.place(other, pins, taken, tried)) {
                taken.insert(pin, wire);
                return true;
            }
        }
        false
    }
}
