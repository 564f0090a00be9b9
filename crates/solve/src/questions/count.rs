//! The exact number of answers: a problem in, a number of any size out.
//!
//! Devices with several wires, and those that share, are tried in all alternatives (interchangeable
//! ones together). This leaves single wires to put on pins, which [`super::placements`] counts
//! without enumerating them.

use super::placements::{Class, Counter, Place};
use crate::answer::{Count, Fault};
use crate::cancel::Cancel;
use crate::domains::{Domains, Pruned};
use crate::index::{AltId, IdVec, RoleId, WireId};
use crate::matching;
use crate::model::{Holding, Model, agree};
use crate::problem::{Claim, DeviceId, Holder, Problem, ResourceId};
use num_bigint::BigUint;
use std::collections::{BTreeMap, BTreeSet};

/// Counts the answers. Two answers differ in a pin or signal of at least one device.
///
/// # Errors
/// [`Fault`] when the problem is not well-formed, or when the search was cancelled.
pub fn count(problem: &Problem, cancel: Cancel<'_>) -> Result<Count, Fault> {
    let model = Model::new(problem)?;
    let Ok(domains) = Domains::new(&model) else { return Ok(BigUint::ZERO) };
    let mut order: Vec<DeviceId> = model.devices.iter().filter(|&d| !simple(&model, d)).collect();
    order.sort_by_key(|&d| (model.class[d], d));
    let mut complex = IdVec::same(false, model.devices.len());
    order.iter().for_each(|&d| complex[d] = true);
    let counter = Counter::new(cancel);
    let mut census =
        Census { problem, model: &model, domains, order: &order, complex, counter, cancel };
    let number = census.alternatives(&order, Run::default(), BigUint::from(1u32));
    if cancel.is_over() { Err(Fault::Cancelled) } else { Ok(number) }
}

/// Whether every alternative of the device is a single unshared wire.
fn simple(model: &Model, device: DeviceId) -> bool {
    model.alts.of(device).iter().all(|alt| {
        let roles = model.roles.of(alt);
        roles.len() == 1
            && model.holding[roles.at(0)] == Holding::Own
            && model.alt_dma[alt].is_empty()
    })
}

struct Census<'a> {
    problem: &'a Problem,
    model: &'a Model,
    domains: Domains,
    /// Devices whose alternatives are tried, interchangeable ones together.
    order: &'a [DeviceId],
    /// Whether each device is in `order`.
    complex: IdVec<DeviceId, bool>,
    counter: Counter<'a>,
    cancel: Cancel<'a>,
}

/// The interchangeable devices just before the next one in order.
#[derive(Clone, Copy, Default)]
struct Run {
    /// The last of them.
    last: Option<DeviceId>,
    /// Their number.
    devices: u32,
    /// How many of them, at the end, have taken the same alternative.
    same: u32,
}

impl Census<'_> {
    /// Counts over all alternatives of the devices that are left. `run` describes the
    /// interchangeable devices before them, and each way found stands for `times` ways.
    fn alternatives(&mut self, left: &[DeviceId], run: Run, times: BigUint) -> BigUint {
        let model = self.model;
        let Some((&device, left)) = left.split_first() else {
            return if self.dma_fits() { self.irregular_roles() * times } else { BigUint::ZERO };
        };
        let last = run.last.filter(|&last| model.class[last] == model.class[device]);
        let devices = if last.is_some() { run.devices } else { 0 };
        // Interchangeable devices are tried only in order; `times` makes up for it, as a
        // multinomial coefficient.
        let before = last.and_then(|last| self.domains.decided(last));
        let before = before.map(|alt| model.alt_position(alt));
        let alts = model.alts.of(device);
        let mut total = BigUint::ZERO;
        for position in before.unwrap_or(0)..alts.len() {
            if self.cancel.is_over() {
                break;
            }
            let mark = self.domains.mark();
            if self.decide(alts.at(position)).is_ok() {
                let same = if before == Some(position) { run.same + 1 } else { 1 };
                let times = &times * (devices + 1) / same;
                let run = Run { last: Some(device), devices: devices + 1, same };
                total += self.alternatives(left, run, times);
            }
            self.domains.undo(model, mark);
        }
        total
    }

    fn decide(&mut self, alt: AltId) -> Result<(), Pruned> {
        self.domains.choose_alt(self.model, alt)?;
        self.domains.propagate(self.model)
    }

    fn dma_fits(&self) -> bool {
        let decided = self.order.iter().filter_map(|&d| self.domains.decided(d));
        let users = decided.flat_map(|alt| &self.model.alt_dma[alt]).copied().collect();
        matching::users_fit(self.problem, &users)
    }

    /// Tries every candidate of the roles that share in a way that the count of placements does not
    /// model.
    fn irregular_roles(&mut self) -> BigUint {
        let model = self.model;
        let Some(role) = self.open_irregular_role() else { return self.place() };
        let mut total = BigUint::ZERO;
        for id in model.cands.of(role) {
            if !self.domains.has_cand(model, id) {
                continue;
            }
            if self.cancel.is_over() {
                break;
            }
            let mark = self.domains.mark();
            let chosen = self.domains.choose_cand(model, id);
            if chosen.and_then(|()| self.domains.propagate(model)).is_ok() {
                total += self.irregular_roles();
            }
            self.domains.undo(model, mark);
        }
        total
    }

    fn open_irregular_role(&self) -> Option<RoleId> {
        let model = self.model;
        let open = |alt: AltId, role: RoleId| {
            self.domains.chosen(role).is_none()
                && (model.holding[role] == Holding::Irregular || self.entangled(alt, role))
        };
        let mut decided = self.order.iter().filter_map(|&d| self.domains.decided(d));
        decided.find_map(|alt| model.roles.of(alt).iter().find(|&role| open(alt, role)))
    }

    /// Whether a role can claim what another role of its device claims too. That is not a conflict.
    fn entangled(&self, alt: AltId, role: RoleId) -> bool {
        let model = self.model;
        let claims = |role: RoleId| {
            let cands = model.cands.of(role).iter();
            cands.flat_map(|id| &model.cand_claims[id]).map(|c| c.resource)
        };
        let others = model.roles.of(alt).iter().filter(|&r| r != role);
        let others: BTreeSet<ResourceId> = others.flat_map(claims).collect();
        claims(role).any(|r| others.contains(&r))
    }

    /// Counts the ways to place the wires of all devices.
    fn place(&mut self) -> BigUint {
        let wires = self.open_wires();
        let mut claimants: BTreeMap<ResourceId, u32> = BTreeMap::new();
        for wire in &wires {
            let all: BTreeSet<ResourceId> =
                wire.iter().flat_map(|p| &p.claims).map(|claim| claim.resource).collect();
            for resource in all {
                *claimants.entry(resource).or_default() += 1;
            }
        }
        let mut classes: BTreeMap<Vec<Place>, u32> = BTreeMap::new();
        for mut wire in wires {
            for place in &mut wire {
                place.claims.retain(|c| claimants.get(&c.resource).is_some_and(|n| *n > 1));
            }
            wire.sort_unstable();
            *classes.entry(wire).or_default() += 1;
        }
        let classes = classes.into_iter().map(|(places, wires)| Class { places, wires });
        self.counter.count(classes.collect())
    }

    /// The places of each wire that is not placed yet. A wire that is down to one candidate has
    /// been propagated and takes no further part.
    fn open_wires(&self) -> Vec<Vec<Place>> {
        let model = self.model;
        let mut wires: Vec<Vec<Place>> = Vec::new();
        let mut shared: BTreeMap<WireId, Vec<RoleId>> = BTreeMap::new();
        for device in model.devices {
            let decided = self.domains.decided(device).filter(|_| self.complex[device]);
            let Some(alt) = decided else {
                wires.push(self.free_places(device));
                continue;
            };
            let open = |&role: &RoleId| self.domains.chosen(role).is_none();
            for role in model.roles.of(alt).iter().filter(open) {
                match model.holding[role] {
                    Holding::Own => wires.push(self.role_places(role, &[role])),
                    Holding::Wire(wire) => shared.entry(wire).or_default().push(role),
                    Holding::Irregular => {}
                }
            }
        }
        for roles in shared.values() {
            wires.extend(roles.first().map(|&role| self.role_places(role, roles)));
        }
        wires
    }

    /// The places of a device that is a single wire in every alternative.
    fn free_places(&self, device: DeviceId) -> Vec<Place> {
        let model = self.model;
        let mut places = Vec::new();
        for alt in self.domains.alts(model, device) {
            for id in self.domains.cands(model, model.roles.of(alt).at(0)) {
                let claims = model.alt_claims[alt].iter().chain(&model.cand_claims[id]);
                places.push(Place { pin: model.cand[id].pin, claims: merged(claims) });
            }
        }
        places
    }

    /// The places of a role of a decided device, for all roles on its wire.
    fn role_places(&self, role: RoleId, together: &[RoleId]) -> Vec<Place> {
        let model = self.model;
        let mut places = Vec::new();
        for id in self.domains.cands(model, role) {
            let c = &model.cand[id];
            let mut claims = Vec::new();
            for &other in together {
                let held = &model.alt_claims[model.role_alt[other]];
                let here = |&o: &_| {
                    let o = &model.cand[o];
                    (o.pin, o.signal) == (c.pin, c.signal)
                };
                // The claims of the alternative itself have been settled with all others by now.
                let own = |claim: &&Claim| {
                    let held = held.iter().find(|c| c.resource == claim.resource);
                    held.is_none_or(|held| held.holder != Holder::Own && held != *claim)
                };
                let cands = self.domains.cands(model, other).filter(here);
                claims.extend(cands.flat_map(|o| &model.cand_claims[o]).filter(own));
            }
            if quarrel(&claims, together.len() > 1) {
                continue;
            }
            places.push(Place { pin: c.pin, claims: merged(claims.into_iter()) });
        }
        places
    }
}

/// Whether devices on one wire claim one resource for different holders.
fn quarrel(claims: &[&Claim], several: bool) -> bool {
    let clash = |a: &&Claim, b: &&Claim| a.resource == b.resource && !agree(a.holder, b.holder);
    several
        && claims.iter().enumerate().any(|(i, a)| claims.iter().skip(i + 1).any(|b| clash(a, b)))
}

/// One claim for each resource; two holders at once exclude everybody else.
fn merged<'a>(claims: impl Iterator<Item = &'a Claim>) -> Vec<Claim> {
    let mut all: BTreeMap<ResourceId, Holder> = BTreeMap::new();
    for &Claim { resource, holder } in claims {
        let held = all.entry(resource).or_insert(holder);
        if *held != holder {
            *held = Holder::Own;
        }
    }
    all.into_iter().map(|(resource, holder)| Claim { resource, holder }).collect()
}
