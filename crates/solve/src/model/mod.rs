//! The problem made flat: nested vectors in, index ranges with inverse tables out.
//!
//! What can never matter is dropped here (claims nobody contests, DMA that always fits), roles are
//! told apart by how they hold their pins, and every cost becomes one number whose order is the
//! lexicographic order of the objective.
#![expect(clippy::indexing_slicing, reason = "all ids are checked once by `validate`")]

mod board_symmetry;
mod validate;
mod wires;

use self::board_symmetry::Boards;
use crate::answer::{Choice, Fault, Objective};
use crate::domains::streams;
use crate::index::Rows;
use crate::problem::{Claim, Holder, Pin, Problem};
use std::collections::{BTreeMap, BTreeSet};

/// No gate, no candidate, no owner.
pub(crate) const NONE: usize = usize::MAX;

/// How a role holds its pin.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// The device alone.
    Own,
    /// All devices with this wire hold one pin together.
    Wire(usize),
    /// Shared in a way that no bound knows; only propagation and branching see it.
    Odd,
}

/// Who claims a resource or violates a rule: an alternative or a candidate.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct User {
    /// Alternative or candidate id.
    pub(crate) id: usize,
    /// Which of the two.
    pub(crate) is_candidate: bool,
    /// Holder code (0 is the device alone).
    pub(crate) holder: usize,
}

/// The weights that pack an [`Objective`] into one number.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Weights {
    pub(crate) moved: u64,
    pub(crate) rule: u64,
    pub(crate) shared: u64,
    pub(crate) cost: u64,
}

impl Weights {
    pub(crate) fn unpack(self, weight: u64) -> Objective {
        Objective {
            moved: (weight / self.moved) as u32,
            violated: (weight % self.moved / self.rule) as u32,
            shared: (weight % self.rule / self.shared) as u32,
            cost: (weight % self.shared / self.cost) as u32,
            spares: (weight % self.cost) as u32,
        }
    }
}

/// One candidate, flat.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cand {
    pub(crate) role: usize,
    pub(crate) pin: usize,
    /// 0 is the device alone, else the group's number + 1.
    pub(crate) holder: usize,
    pub(crate) signal: usize,
    pub(crate) moved: bool,
    /// What it costs beside its pin.
    pub(crate) extra: u64,
    /// Resource that at most one wire can pass, or [`NONE`].
    pub(crate) gate: usize,
}

/// The flat problem.
#[derive(Clone, Debug, Default)]
pub(crate) struct Model {
    pub(crate) devices: usize,
    pub(crate) pins: usize,
    pub(crate) gates: usize,
    pub(crate) wires: usize,
    pub(crate) weights: Weights,
    pub(crate) pin_weight: Vec<u64>,
    pub(crate) spare: Vec<bool>,
    /// Boards that can stand for each other.
    pub(crate) boards: Boards,
    /// First device that is interchangeable with this one.
    pub(crate) class: Vec<usize>,
    /// Device to its alternatives (ids are consecutive).
    pub(crate) alts: Rows<()>,
    pub(crate) alt_device: Vec<usize>,
    pub(crate) alt_board: Vec<usize>,
    pub(crate) alt_claims: Rows<(usize, usize)>,
    /// Claims as a group, contested or not.
    pub(crate) alt_groups: Rows<(usize, usize)>,
    pub(crate) alt_rules: Rows<usize>,
    pub(crate) alt_dma: Rows<usize>,
    /// Alternative to its roles (ids are consecutive).
    pub(crate) roles: Rows<()>,
    pub(crate) role_alt: Vec<usize>,
    pub(crate) role_kind: Vec<Kind>,
    /// Role to its candidates (ids are consecutive).
    pub(crate) cands: Rows<Cand>,
    pub(crate) cand_claims: Rows<(usize, usize)>,
    pub(crate) cand_rules: Rows<usize>,
    /// Rules whose weight is part of `extra`.
    pub(crate) rule_local: Vec<bool>,
    pub(crate) pin_cands: Rows<usize>,
    pub(crate) resource_users: Rows<User>,
    pub(crate) rule_users: Rows<User>,
    pub(crate) wire_cands: Rows<usize>,
    pub(crate) gate_cands: Rows<usize>,
    pub(crate) board_alts: Rows<usize>,
    /// First demand of each device; demand = role position of a device.
    pub(crate) demand: Vec<usize>,
    pub(crate) demand_cands: Rows<usize>,
    /// More than any answer weighs.
    pub(crate) most: u64,
    /// Whether DMA can fail at all.
    pub(crate) dma_matters: bool,
    /// Every use of this DMA user excludes all others.
    pub(crate) user_private: Vec<bool>,
}

/// 0 for the device alone, else the group's number + 1.
pub(crate) fn code(holder: Holder) -> usize {
    match holder {
        Holder::Own => 0,
        Holder::Group(number) => number as usize + 1,
    }
}

/// Whether two devices may hold one thing with these holder codes.
pub(crate) fn agree(one: usize, other: usize) -> bool {
    one != 0 && one == other
}

impl Model {
    pub(crate) fn new(problem: &Problem) -> Result<Self, Fault> {
        validate::validate(problem)?;
        let mut model = Self {
            devices: problem.devices.len(),
            pins: problem.pins.len(),
            weights: validate::weights(problem)?,
            spare: problem.boards.iter().map(|b| b.spare).collect(),
            dma_matters: !streams::all_fit(problem),
            ..Self::default()
        };
        let Weights { shared, cost, .. } = model.weights;
        let weight = |p: &Pin| u64::from(p.cost) * cost + u64::from(p.shared) * shared;
        model.pin_weight = problem.pins.iter().map(weight).collect();
        model.flatten(problem, &contested(problem));
        model.invert(problem);
        model.find_kinds(problem);
        model.find_local_rules();
        model.find_gates();
        model.find_classes();
        model.find_demands();
        model.find_private_users(problem);
        model.most = model.find_most();
        model.boards = Boards::new(problem, &model);
        Ok(model)
    }

    pub(crate) fn cand(&self, id: usize) -> &Cand {
        &self.cands.items[id]
    }

    pub(crate) fn cand_count(&self) -> usize {
        self.cands.items.len()
    }

    pub(crate) fn cand_alt(&self, id: usize) -> usize {
        self.role_alt[self.cand(id).role]
    }

    pub(crate) fn cand_device(&self, id: usize) -> usize {
        self.alt_device[self.cand_alt(id)]
    }

    pub(crate) fn user_alt(&self, user: &User) -> usize {
        if user.is_candidate { self.cand_alt(user.id) } else { user.id }
    }

    fn flatten(&mut self, problem: &Problem, contested: &[bool]) {
        let keep = |claim: &&Claim| contested[claim.resource.0 as usize];
        let pair = |claim: &Claim| (claim.resource.0 as usize, code(claim.holder));
        for (device, d) in problem.devices.iter().enumerate() {
            for a in &d.alternatives {
                let alt = self.alt_device.len();
                self.alts.add(());
                self.alt_device.push(device);
                self.alt_board.push(a.board.0 as usize);
                a.claims.iter().filter(keep).for_each(|c| self.alt_claims.add(pair(c)));
                self.alt_claims.close();
                let groups = a.claims.iter().filter(|c| c.holder != Holder::Own);
                groups.for_each(|c| self.alt_groups.add(pair(c)));
                self.alt_groups.close();
                a.violates.iter().for_each(|r| self.alt_rules.add(r.0 as usize));
                self.alt_rules.close();
                if self.dma_matters {
                    a.dma.iter().for_each(|u| self.alt_dma.add(u.0 as usize));
                }
                self.alt_dma.close();
                for r in &a.roles {
                    let role = self.role_alt.len();
                    self.roles.add(());
                    self.role_alt.push(alt);
                    for c in &r.candidates {
                        self.cands.add(Cand {
                            role,
                            pin: c.pin.0 as usize,
                            holder: code(c.holder),
                            signal: c.signal.0 as usize,
                            moved: c.moved,
                            extra: if c.moved { self.weights.moved } else { 0 },
                            gate: NONE,
                        });
                        c.claims.iter().filter(keep).for_each(|c| self.cand_claims.add(pair(c)));
                        self.cand_claims.close();
                        c.violates.iter().for_each(|r| self.cand_rules.add(r.0 as usize));
                        self.cand_rules.close();
                    }
                    self.cands.close();
                }
                self.roles.close();
            }
            self.alts.close();
        }
    }

    fn invert(&mut self, problem: &Problem) {
        let mut pins = Vec::with_capacity(self.cand_count());
        let mut resources = Vec::new();
        let mut rules = Vec::new();
        let mut boards = Vec::new();
        for alt in 0..self.alt_device.len() {
            let user = User { id: alt, is_candidate: false, holder: 0 };
            let claims = self.alt_claims.at(alt).iter();
            resources.extend(claims.map(|&(r, holder)| (r, User { holder, ..user })));
            rules.extend(self.alt_rules.at(alt).iter().map(|&r| (r, user)));
            boards.push((self.alt_board[alt], alt));
        }
        for (id, c) in self.cands.items.iter().enumerate() {
            pins.push((c.pin, id));
            let user = User { id, is_candidate: true, holder: 0 };
            let claims = self.cand_claims.at(id).iter();
            resources.extend(claims.map(|&(r, holder)| (r, User { holder, ..user })));
            rules.extend(self.cand_rules.at(id).iter().map(|&r| (r, user)));
        }
        self.pin_cands = Rows::collect(self.pins, &pins);
        self.resource_users = Rows::collect(problem.resources as usize, &resources);
        self.rule_users = Rows::collect(problem.rules as usize, &rules);
        self.board_alts = Rows::collect(problem.boards.len(), &boards);
    }

    fn find_classes(&mut self) {
        self.class = (0..self.devices).collect();
        for device in 1..self.devices {
            let same = (0..device).find(|&d| self.class[d] == d && self.same(d, device));
            self.class[device] = same.unwrap_or(device);
        }
    }

    /// Whether two devices have the same choices.
    fn same(&self, one: usize, other: usize) -> bool {
        let (a, b) = (self.alts.range(one), self.alts.range(other));
        let (p, q) = (self.roles.span(&a), self.roles.span(&b));
        let (c, d) = (self.cands.span(&p), self.cands.span(&q));
        let look = |c: &Cand| (c.pin, c.holder, c.signal, c.moved, c.extra);
        let cands = || self.cands.items[c.clone()].iter().zip(&self.cands.items[d.clone()]);
        self.roles.alike(&a, &b)
            && self.cands.alike(&p, &q)
            && self.alt_board[a.clone()] == self.alt_board[b.clone()]
            && cands().all(|(c, d)| look(c) == look(d))
            && self.alt_claims.equal(&a, &b)
            && self.alt_rules.equal(&a, &b)
            && self.alt_dma.equal(&a, &b)
            && self.cand_claims.equal(&c, &d)
            && self.cand_rules.equal(&c, &d)
    }

    fn find_demands(&mut self) {
        let mut pairs = Vec::with_capacity(self.cand_count());
        let mut next = 0;
        for device in 0..self.devices {
            self.demand.push(next);
            let mut most = 0;
            for alt in self.alts.range(device) {
                let roles = self.roles.range(alt);
                most = most.max(roles.len());
                for (position, role) in roles.enumerate() {
                    pairs.extend(self.cands.range(role).map(|c| (next + position, c)));
                }
            }
            next += most;
        }
        self.demand.push(next);
        self.demand_cands = Rows::collect(next, &pairs);
    }

    fn find_private_users(&mut self, problem: &Problem) {
        // Of each user: the device if there is one only, and what all who use it claim alone.
        let mut users: Vec<Option<(usize, BTreeSet<usize>)>> = vec![None; problem.dma.len()];
        for alt in 0..self.alt_device.len() {
            let own = self.alt_claims.at(alt).iter().filter(|c| c.1 == 0).map(|c| c.0);
            for &user in self.alt_dma.at(alt) {
                users[user] = Some(match users[user].take() {
                    None => (self.alt_device[alt], own.clone().collect()),
                    Some((device, common)) => (
                        if device == self.alt_device[alt] { device } else { NONE },
                        common.into_iter().filter(|&r| own.clone().any(|o| o == r)).collect(),
                    ),
                });
            }
        }
        let private = |user: Option<(usize, BTreeSet<usize>)>| {
            user.is_some_and(|(device, common)| device != NONE || !common.is_empty())
        };
        self.user_private = users.into_iter().map(private).collect();
    }

    fn find_most(&self) -> u64 {
        let moved = self.cands.items.iter().any(|c| c.moved);
        let dearest = |role| {
            let cands = self.cands.at(role).iter();
            let wire = |c: &Cand| self.pin_weight[c.pin] + u64::from(moved) * self.weights.moved;
            cands.map(wire).max().unwrap_or(0)
        };
        let of_alt = |alt| self.roles.range(alt).map(dearest).sum::<u64>();
        let of_device = |device| self.alts.range(device).map(of_alt).max().unwrap_or(0);
        let wires: u64 = (0..self.devices).map(of_device).sum();
        let pins = self.pin_weight.iter().map(|w| w + u64::from(moved) * self.weights.moved).sum();
        wires.min(pins) + self.rule_users.len() as u64 * self.weights.rule + self.weights.cost
    }

    /// The exact objective of complete choices.
    pub(crate) fn evaluate(&self, choices: &[(usize, Vec<usize>)]) -> u64 {
        let mut pins = BTreeMap::new();
        let mut rules: BTreeSet<usize> = BTreeSet::new();
        let mut boards = BTreeSet::new();
        for (alt, cands) in choices {
            rules.extend(self.alt_rules.at(*alt));
            boards.insert(self.alt_board[*alt]);
            for &id in cands {
                let c = self.cand(id);
                *pins.entry(c.pin).or_insert(false) |= c.moved;
                rules.extend(self.cand_rules.at(id));
            }
        }
        let cost: u64 = pins.keys().map(|&p| self.pin_weight[p]).sum();
        cost + pins.values().filter(|m| **m).count() as u64 * self.weights.moved
            + rules.len() as u64 * self.weights.rule
            + boards.iter().filter(|b| self.spare[**b]).count() as u64
    }

    /// Back to indices of the problem.
    pub(crate) fn choices(&self, flat: &[(usize, Vec<usize>)]) -> Vec<Choice> {
        flat.iter()
            .enumerate()
            .map(|(device, (alt, cands))| Choice {
                alternative: alt - self.alts.range(device).start,
                candidates: cands
                    .iter()
                    .map(|&c| c - self.cands.range(self.cand(c).role).start)
                    .collect(),
            })
            .collect()
    }
}

/// Resources that two devices may quarrel about.
fn contested(problem: &Problem) -> Vec<bool> {
    let mut first: Vec<Option<(usize, usize)>> = vec![None; problem.resources as usize];
    let mut contested = vec![false; problem.resources as usize];
    for (device, d) in problem.devices.iter().enumerate() {
        for a in &d.alternatives {
            let wires = a.roles.iter().flat_map(|r| &r.candidates).flat_map(|c| &c.claims);
            for claim in a.claims.iter().chain(wires) {
                let (r, holder) = (claim.resource.0 as usize, code(claim.holder));
                match first[r] {
                    None => first[r] = Some((device, holder)),
                    Some((d, h)) => contested[r] |= d != device && !agree(h, holder),
                }
                // One device with two holders: remember the quarrelsome one.
                if first[r].is_some_and(|(d, h)| d == device && h != holder) {
                    first[r] = Some((device, 0));
                }
            }
        }
    }
    contested
}
