//! How roles hold their pins: finds shared wires, gates, and rules that only one wire can violate.
#![expect(clippy::indexing_slicing, reason = "all ids come from the model")]

use crate::index::Rows;
use crate::model::{Cand, Kind, Model, NONE, User, code};
use crate::problem::{Holder, Problem, Role};
use std::collections::{BTreeMap, BTreeSet};

impl Model {
    /// Finds the wires: roles all of whose candidates claim one resource as a group of their pin,
    /// so that all devices on it must take one pin.
    pub(crate) fn find_kinds(&mut self, problem: &Problem) {
        let shares = |o: &Cand, c: &Cand| (o.holder, o.signal) == (c.holder, c.signal);
        let shared = |c: &Cand| {
            let device = self.alt_device[self.role_alt[c.role]];
            c.holder != 0
                && self
                    .pin_cands
                    .at(c.pin)
                    .iter()
                    .any(|&o| shares(self.cand(o), c) && self.cand_device(o) != device)
        };
        self.role_kind = (0..self.role_alt.len())
            .map(|r| if self.cands.at(r).iter().any(shared) { Kind::Odd } else { Kind::Own })
            .collect();
        if self.role_kind.iter().all(|k| *k == Kind::Own) {
            self.wire_cands = Rows::default();
            return;
        }
        let mut wires = Ties::default();
        let all = problem.devices.iter().flat_map(|d| &d.alternatives).flat_map(|a| &a.roles);
        for (role, r) in all.enumerate() {
            if self.role_kind[role] == Kind::Odd {
                wires.read(role, r);
            }
        }
        self.wires = wires.number(self);
        let mut pairs = Vec::new();
        for (id, c) in self.cands.items.iter().enumerate() {
            if let Kind::Wire(wire) = self.role_kind[c.role] {
                pairs.push((wire, id));
            }
        }
        self.wire_cands = Rows::collect(self.wires, &pairs);
        self.cheapen_wires();
    }

    /// Devices of one wire may disagree on whether a pin is a move: the bound takes the least.
    fn cheapen_wires(&mut self) {
        let place = |c: &Cand| (c.pin, c.signal, c.holder);
        for wire in 0..self.wires {
            let mut least = BTreeMap::new();
            for &id in self.wire_cands.at(wire) {
                let c = self.cand(id);
                let entry = least.entry(place(c)).or_insert(c.extra);
                *entry = c.extra.min(*entry);
            }
            for &id in self.wire_cands.at(wire) {
                let c = &mut self.cands.items[id];
                c.extra = least.get(&place(c)).copied().unwrap_or(c.extra);
            }
        }
    }

    /// A rule that one wire alone can violate costs that wire; no branching is needed.
    pub(crate) fn find_local_rules(&mut self) {
        self.rule_local = vec![false; self.rule_users.len()];
        for rule in 0..self.rule_users.len() {
            let users = self.rule_users.at(rule);
            let place = |user: &User| {
                let alt = self.user_alt(user);
                let first = self.roles.range(alt).start;
                let role = if user.is_candidate { self.cand(user.id).role } else { first };
                let empty = self.roles.range(alt).is_empty();
                let own = !empty && self.role_kind[role] == Kind::Own;
                own.then(|| (self.alt_device[alt], role - first))
            };
            let pin = |user: &User| {
                let own = user.is_candidate && self.role_kind[self.cand(user.id).role] == Kind::Own;
                own.then(|| self.cand(user.id).pin)
            };
            let Some(first) = users.first() else { continue };
            let one_wire = place(first).is_some() && users.iter().all(|u| place(u) == place(first));
            let one_pin = pin(first).is_some() && users.iter().all(|u| pin(u) == pin(first));
            self.rule_local[rule] = one_wire || one_pin;
        }
        for rule in (0..self.rule_users.len()).filter(|&r| self.rule_local[r]) {
            let mut charged = BTreeSet::new();
            for user in self.rule_users.at(rule) {
                let range = if user.is_candidate {
                    user.id..user.id + 1
                } else {
                    self.cands.range(self.roles.range(user.id).start)
                };
                charged.extend(range);
            }
            for id in charged {
                self.cands.items[id].extra += self.weights.rule;
            }
        }
    }

    /// Gives each own wire the most contested resource that only one device can hold.
    pub(crate) fn find_gates(&mut self) {
        let mut numbers = BTreeMap::new();
        let crowd = |r: usize| self.resource_users.at(r).len();
        let mut pairs = Vec::new();
        for id in 0..self.cand_count() {
            let role = self.cand(id).role;
            if self.role_kind[role] != Kind::Own {
                continue;
            }
            let alt = self.role_alt[role];
            let own = |claims: &[(usize, usize)]| {
                let owned = claims.iter().filter(|c| c.1 == 0).map(|c| c.0);
                owned.max_by_key(|&r| (crowd(r), std::cmp::Reverse(r)))
            };
            let position = role - self.roles.range(alt).start;
            let key = own(self.alt_claims.at(alt)).map(|r| (r, position)).or_else(|| {
                let resource = own(self.cand_claims.at(id))?;
                self.claimed_by_one_role(resource, alt).then_some((resource, NONE))
            });
            if let Some(key) = key {
                let next = numbers.len();
                pairs.push((*numbers.entry(key).or_insert(next), id));
            }
        }
        for &(gate, id) in &pairs {
            self.cands.items[id].gate = gate;
        }
        self.gates = numbers.len();
        self.gate_cands = Rows::collect(self.gates, &pairs);
    }

    /// Whether no other role of the alternative can claim the resource too.
    fn claimed_by_one_role(&self, resource: usize, alt: usize) -> bool {
        let claims = |id: usize| self.cand_claims.at(id).iter().any(|c| c.0 == resource);
        self.roles.range(alt).filter(|&r| self.cands.range(r).any(claims)).count() == 1
    }
}

/// Which resource ties which roles to one pin.
#[derive(Default)]
struct Ties {
    /// Role and the resources that may tie it.
    roles: Vec<(usize, Vec<usize>)>,
    /// Resource and group to the one pin that all its claimants mean.
    pins: BTreeMap<(usize, usize), BTreeSet<usize>>,
}

impl Ties {
    fn read(&mut self, role: usize, r: &Role) {
        let mut common: Option<Vec<usize>> = None;
        for c in &r.candidates {
            let grouped = c.claims.iter().filter(|claim| claim.holder != Holder::Own);
            let mut resources = Vec::new();
            for claim in grouped.filter(|_| c.holder != Holder::Own) {
                let (resource, pin) = (claim.resource.0 as usize, c.pin.0 as usize);
                resources.push(resource);
                self.pins.entry((resource, code(claim.holder))).or_default().insert(pin);
            }
            common = Some(match common {
                None => resources,
                Some(old) => old.into_iter().filter(|r| resources.contains(r)).collect(),
            });
        }
        self.roles.push((role, common.unwrap_or_default()));
    }

    /// Writes the kinds into the model and returns the number of wires.
    fn number(&self, model: &mut Model) -> usize {
        let tie = |resources: &[usize]| {
            let groups = |r: usize| self.pins.range((r, 0)..(r + 1, 0));
            resources.iter().find(|&&r| groups(r).all(|(_, pins)| pins.len() == 1)).copied()
        };
        let mut found: Vec<(usize, Option<usize>)> =
            self.roles.iter().map(|(role, r)| (*role, tie(r))).collect();
        loop {
            // A pin held by one group on two wires would be one pin of two wires: leave both. As
            // another signal it is held by somebody else: a table may well have the data and the
            // clock of one bus in one row.
            let mut owners: BTreeMap<_, BTreeSet<Option<usize>>> = BTreeMap::new();
            for (role, wire) in &found {
                for c in model.cands.at(*role) {
                    owners.entry((c.pin, c.holder, c.signal)).or_default().insert(*wire);
                }
            }
            let mut mixed: BTreeSet<usize> =
                owners.values().filter(|s| s.len() > 1).flatten().flatten().copied().collect();
            // Two roles of one alternative on one wire may differ, so it is no wire either.
            let mut seen = BTreeSet::new();
            for (role, wire) in &found {
                mixed.extend(wire.filter(|w| !seen.insert((model.role_alt[*role], *w))));
            }
            if mixed.is_empty() {
                break;
            }
            for (_, wire) in &mut found {
                *wire = wire.filter(|w| !mixed.contains(w));
            }
        }
        let mut numbers = BTreeMap::new();
        for (role, wire) in found {
            if let Some(resource) = wire {
                let next = numbers.len();
                model.role_kind[role] = Kind::Wire(*numbers.entry(resource).or_insert(next));
            }
        }
        numbers.len()
    }
}
