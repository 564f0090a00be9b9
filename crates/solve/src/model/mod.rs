//! The flat problem: nested vectors in, ranges of ids with inverse tables out.
//!
//! Whatever can never matter is dropped here (uncontested claims, DMA that always fits), and roles
//! are classified by how they hold their pins. Every cost becomes one number whose order is the
//! lexicographic order of the objective (H. D. Sherali, *Equivalent weights for lexicographic
//! multi-objective programs*, 1982).

mod board_symmetry;
pub(crate) mod bundles;
mod flatten;
mod validate;
mod weights;
mod wires;

use self::board_symmetry::BoardSymmetry;
use self::bundles::Bundles;
pub(crate) use self::weights::Weights;
use crate::answer::{Choice, Fault};
use crate::index::{AltId, Blocks, CandId, DemandId, GateId, Id, IdVec, Ids, RoleId, Rows, WireId};
use crate::matching;
use crate::problem::{
    BoardId, Claim, DeviceId, DmaUserId, Holder, Pin, PinId, Problem, ResourceId, RuleId, SignalId,
};
use std::collections::{BTreeMap, BTreeSet};

/// How a role holds its pin.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Holding {
    /// The device holds it alone.
    Own,
    /// All devices with this wire hold one pin together.
    Wire(WireId),
    /// Shared in a way that no bound models; only propagation and branching see it.
    Irregular,
}

/// An alternative or a candidate: what can claim a resource or violate a rule.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Part {
    Alt(AltId),
    Cand(CandId),
}

/// One candidate, flat.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cand {
    pub(crate) role: RoleId,
    pub(crate) pin: PinId,
    pub(crate) holder: Holder,
    pub(crate) signal: SignalId,
    pub(crate) moved: bool,
    /// Its cost in addition to that of its pin.
    pub(crate) extra: u64,
    /// Resource that at most one wire can pass.
    pub(crate) gate: Option<GateId>,
}

impl Cand {
    /// The properties on which the devices on one wire must agree.
    pub(crate) fn place(&self) -> (PinId, SignalId, Holder) {
        (self.pin, self.signal, self.holder)
    }
}

/// The choice for one device: its alternative and a candidate for each role.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Chosen {
    pub(crate) alt: AltId,
    pub(crate) cands: Vec<CandId>,
}

/// The choices for all devices.
pub(crate) type Choices = IdVec<DeviceId, Chosen>;

/// The flat problem.
#[derive(Clone, Debug, Default)]
pub(crate) struct Model {
    pub(crate) devices: Ids<DeviceId>,
    pub(crate) pins: Ids<PinId>,
    pub(crate) gates: Ids<GateId>,
    pub(crate) wires: Ids<WireId>,
    pub(crate) weights: Weights,
    pub(crate) pin_weight: IdVec<PinId, u64>,
    pub(crate) spare: IdVec<BoardId, bool>,
    /// Boards that can replace each other.
    pub(crate) boards: BoardSymmetry,
    /// First device that is interchangeable with this one.
    pub(crate) class: IdVec<DeviceId, DeviceId>,
    /// Devices that are interchangeable as a whole: those of equal chips, of equal arrays.
    pub(crate) bundles: Bundles,
    pub(crate) alts: Blocks<DeviceId, AltId>,
    pub(crate) alt_device: IdVec<AltId, DeviceId>,
    pub(crate) alt_board: IdVec<AltId, BoardId>,
    pub(crate) alt_claims: Rows<AltId, Claim>,
    /// Claims made as a group, contested or not.
    pub(crate) alt_groups: Rows<AltId, Claim>,
    pub(crate) alt_rules: Rows<AltId, RuleId>,
    pub(crate) alt_dma: Rows<AltId, DmaUserId>,
    pub(crate) roles: Blocks<AltId, RoleId>,
    pub(crate) role_alt: IdVec<RoleId, AltId>,
    pub(crate) holding: IdVec<RoleId, Holding>,
    pub(crate) cands: Blocks<RoleId, CandId>,
    pub(crate) cand: IdVec<CandId, Cand>,
    pub(crate) cand_claims: Rows<CandId, Claim>,
    pub(crate) cand_rules: Rows<CandId, RuleId>,
    /// Rules whose weight is part of `extra`.
    pub(crate) rule_local: IdVec<RuleId, bool>,
    pub(crate) pin_cands: Rows<PinId, CandId>,
    /// The claimants of a resource, and on whose behalf they claim it.
    pub(crate) resource_users: Rows<ResourceId, (Part, Holder)>,
    /// The parts that violate a rule.
    pub(crate) rule_users: Rows<RuleId, Part>,
    pub(crate) wire_cands: Rows<WireId, CandId>,
    pub(crate) gate_cands: Rows<GateId, CandId>,
    pub(crate) board_alts: Rows<BoardId, AltId>,
    /// The demands of a device, one for each role position.
    pub(crate) demands: Blocks<DeviceId, DemandId>,
    pub(crate) demand_cands: Rows<DemandId, CandId>,
    /// A weight that no answer reaches.
    pub(crate) most: u64,
    /// Whether DMA can fail at all.
    pub(crate) dma_matters: bool,
    /// True if every use of this DMA user excludes all others.
    pub(crate) user_private: IdVec<DmaUserId, bool>,
}

/// Whether two devices with these holders may hold the same thing.
#[inline]
pub(crate) fn agree(one: Holder, other: Holder) -> bool {
    matches!((one, other), (Holder::Group(one), Holder::Group(other)) if one == other)
}

impl Model {
    pub(crate) fn new(problem: &Problem) -> Result<Self, Fault> {
        validate::validate(problem)?;
        let weights = Weights::new(problem)?;
        let weight =
            |p: &Pin| u64::from(p.cost) * weights.cost + u64::from(p.shared) * weights.shared;
        let mut model = Self {
            devices: Ids::first(problem.devices.len()),
            pins: Ids::first(problem.pins.len()),
            weights,
            pin_weight: problem.pins.iter().map(weight).collect(),
            spare: problem.boards.iter().map(|b| b.spare).collect(),
            dma_matters: !matching::all_fit(problem),
            ..Self::default()
        };
        model.flatten(problem);
        model.invert(problem);
        model.find_holdings(problem);
        model.find_local_rules();
        model.find_gates();
        model.find_classes();
        model.bundles = Bundles::new(&model);
        model.find_demands();
        model.find_private_users(problem);
        model.most = model.find_most();
        model.boards = BoardSymmetry::new(problem, &model);
        Ok(model)
    }

    pub(crate) fn cand_alt(&self, id: CandId) -> AltId {
        self.role_alt[self.cand[id].role]
    }

    pub(crate) fn cand_device(&self, id: CandId) -> DeviceId {
        self.alt_device[self.cand_alt(id)]
    }

    pub(crate) fn part_alt(&self, part: Part) -> AltId {
        match part {
            Part::Alt(alt) => alt,
            Part::Cand(id) => self.cand_alt(id),
        }
    }

    /// The first device of each class of interchangeable ones.
    pub(crate) fn class_leaders(&self) -> impl Iterator<Item = DeviceId> + Clone + '_ {
        self.devices.iter().filter(|&d| self.class[d] == d)
    }

    /// The devices that are interchangeable with `leader`, which is the first of them.
    pub(crate) fn class_of(&self, leader: DeviceId) -> impl Iterator<Item = DeviceId> + Clone + '_ {
        let from = Ids::from_to(leader, self.devices.at(self.devices.len()));
        from.iter().filter(move |&d| self.class[d] == leader)
    }

    /// The position of the alternative among those of its device.
    pub(crate) fn alt_position(&self, alt: AltId) -> usize {
        self.alts.of(self.alt_device[alt]).position(alt)
    }

    /// The same alternative of an interchangeable device.
    pub(crate) fn twin_alt(&self, alt: AltId, device: DeviceId) -> AltId {
        self.alts.of(device).at(self.alt_position(alt))
    }

    /// The same candidate of an alternative with the same choices.
    pub(crate) fn twin_cand(&self, id: CandId, alt: AltId) -> CandId {
        let role = self.cand[id].role;
        let position = self.roles.of(self.role_alt[role]).position(role);
        let twin = self.roles.of(alt).at(position);
        self.cands.of(twin).at(self.cands.of(role).position(id))
    }

    /// The candidates of all roles of an alternative.
    pub(crate) fn alt_cands(&self, alt: AltId) -> Ids<CandId> {
        self.cands.of_all(self.roles.of(alt))
    }

    /// The shared wires of an alternative.
    pub(crate) fn alt_wires(&self, alt: AltId) -> impl Iterator<Item = WireId> + Clone + '_ {
        self.roles.of(alt).iter().filter_map(|role| match self.holding[role] {
            Holding::Wire(wire) => Some(wire),
            Holding::Own | Holding::Irregular => None,
        })
    }

    fn find_classes(&mut self) {
        self.class = self.devices.iter().collect();
        for device in self.devices {
            let before = Ids::first(device.index());
            let same = before.iter().find(|&d| self.class[d] == d && self.same(d, device));
            self.class[device] = same.unwrap_or(device);
        }
    }

    /// Whether two devices have the same choices.
    fn same(&self, one: DeviceId, other: DeviceId) -> bool {
        let (a, b) = (self.alts.of(one), self.alts.of(other));
        let (p, q) = (self.roles.of_all(a), self.roles.of_all(b));
        let (c, d) = (self.cands.of_all(p), self.cands.of_all(q));
        let shape = |c: &Cand| (c.place(), c.moved, c.extra);
        let cands = || self.cand.of(c).iter().zip(self.cand.of(d));
        self.roles.same_sizes(a, b)
            && self.cands.same_sizes(p, q)
            && self.alt_board.of(a) == self.alt_board.of(b)
            && cands().all(|(c, d)| shape(c) == shape(d))
            && self.alt_claims.equal(a, b)
            && self.alt_rules.equal(a, b)
            && self.alt_dma.equal(a, b)
            && self.cand_claims.equal(c, d)
            && self.cand_rules.equal(c, d)
    }

    /// Gives each device as many demands as it has roles in its largest alternative.
    fn find_demands(&mut self) {
        let mut pairs = Vec::with_capacity(self.cand.len());
        let mut next = 0;
        for device in self.devices {
            let mut most = 0;
            for alt in self.alts.of(device) {
                let roles = self.roles.of(alt);
                most = most.max(roles.len());
                for (position, role) in roles.iter().enumerate() {
                    let demand = DemandId::new(next + position);
                    pairs.extend(self.cands.of(role).iter().map(|c| (demand, c)));
                }
            }
            next += most;
            self.demands.close(next);
        }
        self.demand_cands = Rows::collect(next, &pairs);
    }

    fn find_private_users(&mut self, problem: &Problem) {
        // For each user: its device, if there is only one, and the resources that every alternative
        // with it claims as its own.
        type Users = (Option<DeviceId>, BTreeSet<ResourceId>);
        let mut users: IdVec<DmaUserId, Option<Users>> = IdVec::same(None, problem.dma.len());
        for (alt, &device) in self.alt_device.enumerate() {
            let own = self.alt_claims[alt].iter().filter(|c| c.holder == Holder::Own);
            let own = own.map(|c| c.resource);
            for &user in &self.alt_dma[alt] {
                users[user] = Some(match users[user].take() {
                    None => (Some(device), own.clone().collect()),
                    Some((only, common)) => (
                        only.filter(|only| *only == device),
                        common.into_iter().filter(|&r| own.clone().any(|o| o == r)).collect(),
                    ),
                });
            }
        }
        let private = |user: Option<Users>| {
            user.is_some_and(|(device, common)| device.is_some() || !common.is_empty())
        };
        self.user_private = users.into_iter().map(private).collect();
    }

    fn find_most(&self) -> u64 {
        let moved = u64::from(self.cand.iter().any(|c| c.moved)) * self.weights.moved;
        let dearest = |role| {
            let cands = self.cand.of(self.cands.of(role)).iter();
            cands.map(|c| self.pin_weight[c.pin] + moved).max().unwrap_or(0)
        };
        let of_alt = |alt| self.roles.of(alt).iter().map(dearest).sum::<u64>();
        let of_device = |device| self.alts.of(device).iter().map(of_alt).max().unwrap_or(0);
        let wires: u64 = self.devices.iter().map(of_device).sum();
        let pins = self.pin_weight.iter().map(|w| w + moved).sum();
        wires.min(pins) + self.rule_users.len() as u64 * self.weights.rule + self.weights.cost
    }

    /// The exact objective of complete choices.
    pub(crate) fn evaluate(&self, choices: &Choices) -> u64 {
        let mut pins = BTreeMap::new();
        let mut rules: BTreeSet<RuleId> = BTreeSet::new();
        let mut boards = BTreeSet::new();
        for Chosen { alt, cands } in choices {
            rules.extend(&self.alt_rules[*alt]);
            boards.insert(self.alt_board[*alt]);
            for &id in cands {
                let c = &self.cand[id];
                *pins.entry(c.pin).or_insert(false) |= c.moved;
                rules.extend(&self.cand_rules[id]);
            }
        }
        let cost: u64 = pins.keys().map(|&p| self.pin_weight[p]).sum();
        cost + pins.values().filter(|m| **m).count() as u64 * self.weights.moved
            + rules.len() as u64 * self.weights.rule
            + boards.iter().filter(|b| self.spare[**b]).count() as u64
    }

    /// Converts choices back to indices of the problem.
    pub(crate) fn choices(&self, choices: &Choices) -> Vec<Choice> {
        let choice = |chosen: &Chosen| Choice {
            alternative: self.alt_position(chosen.alt),
            candidates: chosen
                .cands
                .iter()
                .map(|&id| self.cands.of(self.cand[id].role).position(id))
                .collect(),
        };
        choices.iter().map(choice).collect()
    }
}
