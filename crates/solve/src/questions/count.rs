//! The exact number of answers: a problem in, a number of any size out.
//!
//! Devices of several wires, and those that share, are tried in all alternatives (as many at once
//! as are interchangeable); what is then left is to put single wires on pins, which the frontier
//! count does without enumerating.
#![expect(clippy::indexing_slicing, reason = "all ids come from the model")]

use crate::answer::{Count, Fault};
use crate::cancel::Cancel;
use crate::domains::streams::Matching;
use crate::domains::{Dead, Domains};
use crate::model::{Kind, Model};
use crate::problem::Problem;
use crate::questions::placements::{Class, Counter, Place};
use num_bigint::BigUint;
use std::collections::{BTreeMap, BTreeSet};

/// Counts the answers, which differ in some pin or signal of some device.
///
/// # Errors
/// [`Fault`] when the problem is no proper problem, or when the search was cancelled.
pub fn count(problem: &Problem, cancel: Cancel<'_>) -> Result<Count, Fault> {
    let model = Model::new(problem)?;
    let Ok(domains) = Domains::new(&model) else { return Ok(BigUint::ZERO) };
    let complex = (0..model.devices).filter(|&d| !simple(&model, d));
    let mut order: Vec<usize> = complex.collect();
    order.sort_by_key(|&d| (model.class[d], d));
    let counter = Counter::new(cancel);
    let mut census = Census { problem, model: &model, domains, order, counter, cancel };
    let number = census.alternatives(0, 0, BigUint::from(1u32));
    if cancel.is_over() { Err(Fault::Cancelled) } else { Ok(number) }
}

/// Whether every alternative of the device is one wire of its own.
fn simple(model: &Model, device: usize) -> bool {
    model.alts.range(device).all(|alt| {
        let roles = model.roles.range(alt);
        roles.len() == 1
            && model.role_kind[roles.start] == Kind::Own
            && model.alt_dma.at(alt).is_empty()
    })
}

struct Census<'a> {
    problem: &'a Problem,
    model: &'a Model,
    domains: Domains,
    /// Devices whose alternatives are tried, interchangeable ones together.
    order: Vec<usize>,
    counter: Counter<'a>,
    cancel: Cancel<'a>,
}

impl Census<'_> {
    /// Counts over all alternatives of the devices from `index` on; `run` alike devices before it
    /// have taken the same alternative, and `times` ways to name the devices are meant.
    fn alternatives(&mut self, index: usize, run: u32, times: BigUint) -> BigUint {
        let model = self.model;
        let Some(&device) = self.order.get(index) else {
            return if self.dma_fits() { self.odd_roles() * times } else { BigUint::ZERO };
        };
        let first = model.alts.range(device).start;
        let class = |i: usize| self.order.get(i).map(|&d| model.class[d]);
        let position = (0..index).rev().take_while(|&i| class(i) == class(index)).count();
        let before = position.checked_sub(1).and_then(|_| {
            let twin = self.order[index - 1];
            self.domains.decided(twin).map(|alt| alt - model.alts.range(twin).start)
        });
        let mut total = BigUint::ZERO;
        for offset in before.unwrap_or(0)..model.alts.range(device).len() {
            if self.cancel.is_over() {
                break;
            }
            let mark = self.domains.mark();
            let step = |domains: &mut Domains| -> Result<(), Dead> {
                domains.decide(model, first + offset)?;
                domains.propagate(model)
            };
            if step(&mut self.domains).is_ok() {
                // Alike devices are tried in order only: a multinomial coefficient grows.
                let run = if before == Some(offset) { run + 1 } else { 1 };
                let times = &times * (position as u32 + 1) / run;
                total += self.alternatives(index + 1, run, times);
            }
            self.domains.undo(model, mark);
        }
        total
    }

    fn dma_fits(&self) -> bool {
        let model = self.model;
        let decided = self.order.iter().filter_map(|&d| self.domains.decided(d));
        let users: BTreeSet<usize> =
            decided.flat_map(|alt| model.alt_dma.at(alt)).copied().collect();
        let mut matching = Matching::new(self.problem.streams);
        let mut requests = users.iter().flat_map(|&u| &self.problem.dma[u].requests);
        requests.all(|r| matching.add(&r.streams))
    }

    /// Tries every candidate of the roles that share in a way the frontier does not know.
    fn odd_roles(&mut self) -> BigUint {
        let model = self.model;
        let mut open = None;
        for &device in &self.order {
            let Some(alt) = self.domains.decided(device) else { continue };
            let roles = model.roles.range(alt);
            open = open.or(roles.into_iter().find(|&role| {
                self.domains.pinned(role).is_none()
                    && (model.role_kind[role] == Kind::Odd || self.entangled(alt, role))
            }));
        }
        let Some(role) = open else { return self.place() };
        let mut total = BigUint::ZERO;
        for id in model.cands.range(role) {
            if !self.domains.cand_on(model, id) {
                continue;
            }
            if self.cancel.is_over() {
                break;
            }
            let mark = self.domains.mark();
            let step = |domains: &mut Domains| -> Result<(), Dead> {
                domains.pin(model, id)?;
                domains.propagate(model)
            };
            if step(&mut self.domains).is_ok() {
                total += self.odd_roles();
            }
            self.domains.undo(model, mark);
        }
        total
    }

    /// Whether a role can claim what another role of its device claims too: no quarrel there.
    fn entangled(&self, alt: usize, role: usize) -> bool {
        let model = self.model;
        let claims = |role: usize| {
            model.cands.range(role).flat_map(|id| model.cand_claims.at(id)).map(|c| c.0)
        };
        let others = model.roles.range(alt).filter(|&r| r != role);
        let others: BTreeSet<usize> = others.flat_map(claims).collect();
        claims(role).any(|r| others.contains(&r))
    }

    /// Counts the ways to place the wires of all devices.
    fn place(&mut self) -> BigUint {
        let mut wires: Vec<Vec<Place>> = Vec::new();
        let mut shared: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        let model = self.model;
        for device in 0..model.devices {
            let Some(alt) = self.domains.decided(device).filter(|_| self.order.contains(&device))
            else {
                wires.push(self.free_places(device));
                continue;
            };
            // What is down to one candidate has been propagated and takes no further part.
            for role in model.roles.range(alt).filter(|&r| self.domains.pinned(r).is_none()) {
                match model.role_kind[role] {
                    Kind::Own => wires.push(self.role_places(role, &[role])),
                    Kind::Wire(wire) => shared.entry(wire).or_default().push(role),
                    Kind::Odd => {}
                }
            }
        }
        for roles in shared.values() {
            wires.push(self.role_places(roles[0], roles));
        }
        let mut claimants: BTreeMap<usize, u32> = BTreeMap::new();
        for wire in &wires {
            let all: BTreeSet<usize> =
                wire.iter().flat_map(|p| &p.claims).map(|claim| claim.0).collect();
            for resource in all {
                *claimants.entry(resource).or_default() += 1;
            }
        }
        let mut classes: BTreeMap<Vec<Place>, u32> = BTreeMap::new();
        for mut wire in wires {
            for place in &mut wire {
                place.claims.retain(|claim| claimants.get(&claim.0).is_some_and(|n| *n > 1));
            }
            wire.sort_unstable();
            *classes.entry(wire).or_default() += 1;
        }
        let classes = classes.into_iter().map(|(places, wires)| Class { places, wires });
        self.counter.count(classes.collect())
    }

    /// The places of a device that is one wire in every alternative.
    fn free_places(&self, device: usize) -> Vec<Place> {
        let model = self.model;
        let mut places = Vec::new();
        for alt in self.domains.alts(model, device) {
            for id in self.domains.cands(model, model.roles.range(alt).start) {
                let claims = model.alt_claims.at(alt).iter().chain(model.cand_claims.at(id));
                places.push(Place { pin: model.cand(id).pin, claims: merged(claims) });
            }
        }
        places
    }

    /// The places of a role of a decided device, for all roles on its wire.
    fn role_places(&self, role: usize, together: &[usize]) -> Vec<Place> {
        let model = self.model;
        let mut places = Vec::new();
        for id in self.domains.cands(model, role) {
            let c = model.cand(id);
            let mut claims = Vec::new();
            for &other in together {
                let alt = model.role_alt[other];
                let here = |o: &usize| {
                    let o = model.cand(*o);
                    (o.pin, o.signal) == (c.pin, c.signal)
                };
                // What the alternative claims itself is settled with all others by now.
                let own = |claim: &&(usize, usize)| {
                    let held = model.alt_claims.at(alt).iter().find(|c| c.0 == claim.0);
                    held.is_none_or(|held| held.1 != 0 && held.1 != claim.1)
                };
                let cands = self.domains.cands(model, other).filter(here);
                claims.extend(cands.flat_map(|o| model.cand_claims.at(o)).filter(own));
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
fn quarrel(claims: &[&(usize, usize)], several: bool) -> bool {
    let clash =
        |a: &&(usize, usize), b: &&(usize, usize)| a.0 == b.0 && !crate::model::agree(a.1, b.1);
    several
        && claims.iter().enumerate().any(|(i, a)| claims.iter().skip(i + 1).any(|b| clash(a, b)))
}

/// One claim for each resource; two holders at once exclude everybody.
fn merged<'a>(claims: impl Iterator<Item = &'a (usize, usize)>) -> Vec<(usize, usize)> {
    let mut all: BTreeMap<usize, usize> = BTreeMap::new();
    for &(resource, code) in claims {
        let held = all.entry(resource).or_insert(code);
        if *held != code {
            *held = 0;
        }
    }
    all.into_iter().collect()
}
