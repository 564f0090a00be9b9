//! How roles hold their pins: finds a model's shared wires, its gates and the rules that only one
//! wire can violate.

use crate::index::{AltId, CandId, Id, Ids, RoleId, Rows, WireId};
use crate::model::{Cand, Holding, Model, Part};
use crate::problem::{Claim, Holder, PinId, Problem, ResourceId, Role, RuleId};
use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet};

impl Model {
    /// Finds the shared wires: roles of which all candidates claim one resource as a group of their
    /// pin, so that all devices on the wire must take the same pin.
    pub(super) fn find_holdings(&mut self, problem: &Problem) {
        self.holding = self.role_alt.ids().iter().map(|role| self.own_or_irregular(role)).collect();
        if self.holding.iter().all(|holding| *holding == Holding::Own) {
            return;
        }
        let mut ties = Ties::default();
        let all = problem.devices.iter().flat_map(|d| &d.alternatives).flat_map(|a| &a.roles);
        for (role, r) in self.holding.ids().iter().zip(all) {
            if self.holding[role] == Holding::Irregular {
                ties.read(role, r);
            }
        }
        self.wires = Ids::first(ties.number(self));
        let mut pairs = Vec::new();
        for (id, c) in self.cand.enumerate() {
            if let Holding::Wire(wire) = self.holding[c.role] {
                pairs.push((wire, id));
            }
        }
        self.wire_cands = Rows::collect(self.wires.len(), &pairs);
        self.cheapen_wires();
    }

    /// Irregular if another device may hold the same pin together with this one.
    fn own_or_irregular(&self, role: RoleId) -> Holding {
        let device = self.alt_device[self.role_alt[role]];
        let shared = |c: &Cand| {
            let joins = |&o: &CandId| {
                let other = &self.cand[o];
                (other.holder, other.signal) == (c.holder, c.signal)
                    && self.cand_device(o) != device
            };
            c.holder != Holder::Own && self.pin_cands[c.pin].iter().any(joins)
        };
        let shares = self.cand.of(self.cands.of(role)).iter().any(shared);
        if shares { Holding::Irregular } else { Holding::Own }
    }

    /// Devices on one wire may disagree on whether a pin is a move: the bound takes the lowest
    /// cost.
    fn cheapen_wires(&mut self) {
        for wire in self.wires {
            let mut least = BTreeMap::new();
            for &id in &self.wire_cands[wire] {
                let c = &self.cand[id];
                let entry = least.entry(c.place()).or_insert(c.extra);
                *entry = c.extra.min(*entry);
            }
            for &id in &self.wire_cands[wire] {
                let c = &mut self.cand[id];
                c.extra = least.get(&c.place()).copied().unwrap_or(c.extra);
            }
        }
    }

    /// A rule that only one wire can violate is charged to that wire; no branching is needed.
    pub(super) fn find_local_rules(&mut self) {
        let rules = self.rule_users.ids();
        self.rule_local = rules.iter().map(|rule| self.is_local(rule)).collect();
        for rule in rules.iter().filter(|&rule| self.rule_local[rule]) {
            let mut charged = BTreeSet::new();
            for part in &self.rule_users[rule] {
                match *part {
                    Part::Cand(id) => {
                        charged.insert(id);
                    }
                    Part::Alt(alt) => {
                        let role = self.roles.of(alt).at(0);
                        charged.extend(self.cands.of(role));
                    }
                }
            }
            for id in charged {
                self.cand[id].extra += self.weights.rule;
            }
        }
    }

    /// Whether the rule can be violated only by one role position of one device, or only by one
    /// pin.
    fn is_local(&self, rule: RuleId) -> bool {
        let users = &self.rule_users[rule];
        let Some(&first) = users.first() else { return false };
        let position = |part: Part| {
            let alt = self.part_alt(part);
            let roles = self.roles.of(alt);
            let role = match part {
                Part::Cand(id) => self.cand[id].role,
                Part::Alt(_) => roles.nth(0)?,
            };
            let own = self.holding[role] == Holding::Own;
            own.then(|| (self.alt_device[alt], roles.position(role)))
        };
        let pin = |part: Part| match part {
            Part::Cand(id) => {
                let c = &self.cand[id];
                (self.holding[c.role] == Holding::Own).then_some(c.pin)
            }
            Part::Alt(_) => None,
        };
        let one_wire = position(first)
            .is_some_and(|first| users.iter().all(|&part| position(part) == Some(first)));
        one_wire
            || pin(first).is_some_and(|first| users.iter().all(|&part| pin(part) == Some(first)))
    }

    /// Gives each unshared wire the most contested resource that only one device can hold.
    pub(super) fn find_gates(&mut self) {
        let mut numbers = BTreeMap::new();
        let mut pairs = Vec::new();
        for id in self.cand.ids() {
            if let Some(gate) = self.gate_of(id) {
                let next = numbers.len();
                pairs.push((Id::new(*numbers.entry(gate).or_insert(next)), id));
            }
        }
        for &(gate, id) in &pairs {
            self.cand[id].gate = Some(gate);
        }
        self.gates = Ids::first(numbers.len());
        self.gate_cands = Rows::collect(self.gates.len(), &pairs);
    }

    /// The resource that a candidate must pass: one that its alternative claims, for the wires at
    /// one position, or one that it claims itself and that no other role of the alternative may
    /// claim.
    fn gate_of(&self, id: CandId) -> Option<(ResourceId, Option<usize>)> {
        let role = self.cand[id].role;
        if self.holding[role] != Holding::Own {
            return None;
        }
        let alt = self.role_alt[role];
        let position = self.roles.of(alt).position(role);
        if let Some(resource) = self.most_contested(&self.alt_claims[alt]) {
            return Some((resource, Some(position)));
        }
        let resource = self.most_contested(&self.cand_claims[id])?;
        self.claimed_by_one_role(resource, alt).then_some((resource, None))
    }

    /// Of the resources claimed for the device alone, the one with the most claimants.
    fn most_contested(&self, claims: &[Claim]) -> Option<ResourceId> {
        let owned = claims.iter().filter(|c| c.holder == Holder::Own).map(|c| c.resource);
        owned.max_by_key(|&r| (self.resource_users[r].len(), Reverse(r)))
    }

    /// Whether no other role of the alternative can claim the resource too.
    fn claimed_by_one_role(&self, resource: ResourceId, alt: AltId) -> bool {
        let claims = |id: CandId| self.cand_claims[id].iter().any(|c| c.resource == resource);
        let claimant = |&role: &RoleId| self.cands.of(role).iter().any(claims);
        self.roles.of(alt).iter().filter(claimant).count() == 1
    }
}

/// The resources that tie roles to one pin.
#[derive(Default)]
struct Ties {
    /// Each role, with the resources that may tie it.
    roles: Vec<(RoleId, Vec<ResourceId>)>,
    /// For each resource and group, the pins that its claimants name: exactly one if the resource
    /// ties.
    pins: BTreeMap<ResourceId, BTreeMap<Holder, BTreeSet<PinId>>>,
}

impl Ties {
    fn read(&mut self, role: RoleId, r: &Role) {
        let mut common: Option<Vec<ResourceId>> = None;
        for c in &r.candidates {
            let grouped = c.claims.iter().filter(|claim| claim.holder != Holder::Own);
            let mut resources = Vec::new();
            for claim in grouped.filter(|_| c.holder != Holder::Own) {
                resources.push(claim.resource);
                let groups = self.pins.entry(claim.resource).or_default();
                groups.entry(claim.holder).or_default().insert(c.pin);
            }
            common = Some(match common {
                None => resources,
                Some(old) => old.into_iter().filter(|r| resources.contains(r)).collect(),
            });
        }
        self.roles.push((role, common.unwrap_or_default()));
    }

    /// Writes the wires into the model and returns their number.
    fn number(&self, model: &mut Model) -> usize {
        let one_pin = |r: &ResourceId| {
            let mut groups = self.pins.get(r).into_iter().flatten();
            groups.all(|(_, pins)| pins.len() == 1)
        };
        let tie = |resources: &[ResourceId]| resources.iter().copied().find(one_pin);
        let mut found: Vec<(RoleId, Option<ResourceId>)> =
            self.roles.iter().map(|(role, r)| (*role, tie(r))).collect();
        loop {
            let mixed = mixed(model, &found);
            if mixed.is_empty() {
                break;
            }
            for (_, wire) in &mut found {
                *wire = wire.filter(|w| !mixed.contains(w));
            }
        }
        let mut numbers: BTreeMap<ResourceId, WireId> = BTreeMap::new();
        for (role, wire) in found {
            if let Some(resource) = wire {
                let next = WireId::new(numbers.len());
                model.holding[role] = Holding::Wire(*numbers.entry(resource).or_insert(next));
            }
        }
        numbers.len()
    }
}

/// The resources that cannot represent a wire.
fn mixed(model: &Model, found: &[(RoleId, Option<ResourceId>)]) -> BTreeSet<ResourceId> {
    // A pin held by one group on two wires would belong to both: leave both alone. With another
    // signal, it has another owner: a table may well have the data and the clock of one bus in one
    // row.
    let mut owners: BTreeMap<_, BTreeSet<Option<ResourceId>>> = BTreeMap::new();
    for (role, wire) in found {
        for c in model.cand.of(model.cands.of(*role)) {
            owners.entry((c.pin, c.holder, c.signal)).or_default().insert(*wire);
        }
    }
    let mut mixed: BTreeSet<ResourceId> =
        owners.values().filter(|s| s.len() > 1).flatten().flatten().copied().collect();
    // Two roles of one alternative on one wire may differ, so it is not a wire either.
    let mut seen = BTreeSet::new();
    for (role, wire) in found {
        mixed.extend(wire.filter(|w| !seen.insert((model.role_alt[*role], *w))));
    }
    mixed
}
