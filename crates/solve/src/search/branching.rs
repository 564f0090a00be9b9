//! Branching: an open choice in, the domains with it or without it out.
//!
//! A choice is taken, or it is refused to the device and all devices that are interchangeable with
//! it at once, on all boards that can replace each other. This breaks the symmetry of devices and
//! boards; integer programming calls it orbital branching (J. Ostrowski, J. Linderoth, F. Rossi and
//! S. Smriglio, *Orbital branching*, 2011), constraint programming calls it symmetry breaking
//! during search (I. P. Gent and B. M. Smith, *Symmetry breaking in constraint programming*, 2000).

use super::Engine;
use super::branch::Branch;
use crate::domains::{Charge, Pruned};
use crate::index::{AltId, CandId, FacilityId};
use crate::model::bundles::Bundle;
use crate::model::{Choices, Chosen};
use crate::problem::{BoardId, DeviceId, RuleId};
use std::collections::BTreeSet;

impl Engine<'_> {
    pub(crate) fn take(&mut self, branch: Branch) -> Result<(), Pruned> {
        for board in self.boards_of(branch) {
            self.domains.touch(board);
        }
        match branch {
            Branch::Alt(alt) => self.domains.choose_alt(self.model, alt),
            Branch::Cand(id) => self.domains.choose_cand(self.model, id),
            Branch::Rule(rule) => self.domains.close_rule(self.model, rule),
            Branch::Board(board) => self.domains.close_board(self.model, board),
            Branch::Facility(facility) => {
                self.domains.open(facility);
                Ok(())
            }
        }
    }

    pub(crate) fn refuse(&mut self, branch: Branch) -> Result<(), Pruned> {
        let model = self.model;
        match branch {
            Branch::Alt(alt) => {
                let twins = self.twins(model.alt_device[alt]);
                for alt in self.equals(branch).filter_map(|b| model.boards.alt_on(model, alt, b)) {
                    for &twin in &twins {
                        self.domains.remove_alt(model, model.twin_alt(alt, twin))?;
                    }
                }
                Ok(())
            }
            Branch::Cand(id) => {
                let twins = self.twins(model.cand_device(id));
                for id in self.equals(branch).filter_map(|b| model.boards.cand_on(model, id, b)) {
                    for &twin in &twins {
                        let alt = model.twin_alt(model.cand_alt(id), twin);
                        self.domains.remove_cand(model, model.twin_cand(id, alt))?;
                    }
                }
                Ok(())
            }
            Branch::Rule(rule) => self.domains.pay_rule(model, rule),
            Branch::Board(_) => {
                self.equals(branch).try_for_each(|board| self.domains.pay_board(model, board))
            }
            Branch::Facility(facility) => self.shut(facility),
        }
    }

    /// Lets no device use the facility.
    fn shut(&mut self, facility: FacilityId) -> Result<(), Pruned> {
        let model = self.model;
        let branch = Branch::Facility(facility);
        let Some(pricing) = &self.pricing else { return Ok(()) };
        let alts = &pricing.dualized.facilities[facility].alts;
        // A facility of several boards is refused only where it is: these boards need not be equal.
        let boards = self.boards_of(branch);
        let [_] = boards.as_slice() else {
            return alts.iter().try_for_each(|&alt| self.domains.remove_alt(model, alt));
        };
        let mut all = self.equal_facilities(alts);
        all.push(alts.clone());
        for board in self.equals(branch) {
            let here = |alt: &AltId| model.boards.alt_on(model, *alt, board);
            for alt in all.iter().flatten().filter_map(here) {
                self.domains.remove_alt(model, alt)?;
            }
        }
        Ok(())
    }

    /// The boards that a branch is about. Rules are the same on equal boards.
    pub(super) fn boards_of(&self, branch: Branch) -> Vec<BoardId> {
        let model = self.model;
        match branch {
            Branch::Alt(alt) => vec![model.alt_board[alt]],
            Branch::Cand(id) => vec![model.alt_board[model.cand_alt(id)]],
            Branch::Rule(_) => Vec::new(),
            Branch::Board(board) => vec![board],
            Branch::Facility(facility) => {
                let dualized = self.pricing.as_ref().map(|pricing| &pricing.dualized);
                let alts = dualized.iter().flat_map(|d| &d.facilities[facility].alts);
                let mut boards: Vec<BoardId> = alts.map(|&alt| model.alt_board[alt]).collect();
                boards.sort_unstable();
                boards.dedup();
                boards
            }
        }
    }

    /// The board of a branch and the boards that are equal to it at this node because nothing has
    /// been decided about any of them. If an answer had the refused choice on another of these
    /// boards, swapping the two boards would give an answer with the choice where it was tried.
    pub(super) fn equals(&self, branch: Branch) -> impl Iterator<Item = BoardId> + use<> {
        let first = &self.model.boards.first_equal;
        let mut boards = self.boards_of(branch);
        if let &[board] = boards.as_slice()
            && self.board_symmetry
            && !self.domains.is_touched(board)
        {
            let equal = |b: &BoardId| first[*b] == first[board] && !self.domains.is_touched(*b);
            boards = first.ids().iter().filter(equal).collect();
        }
        boards.into_iter()
    }

    /// The device and those that are interchangeable with it at this node, by themselves or with
    /// their bundles.
    fn twins(&self, device: DeviceId) -> Vec<DeviceId> {
        let model = self.model;
        let own = self.alike(device);
        let mut twins = own.clone();
        for bundle in self.equal_bundles(device) {
            let there = |twin: &DeviceId| {
                let place = model.bundles.place(*twin)?;
                bundle.devices.get(place.position).copied()
            };
            twins.extend(own.iter().filter_map(there));
        }
        twins
    }

    /// The device and those that are interchangeable with it at this node by themselves.
    pub(super) fn alike(&self, device: DeviceId) -> Vec<DeviceId> {
        let model = self.model;
        let same = |&d: &DeviceId| d == device || self.domains.same_domain(model, d, device);
        model.class_of(model.class[device]).filter(same).collect()
    }

    /// The bundles that are interchangeable at this node with the device's own.
    pub(super) fn equal_bundles(&self, device: DeviceId) -> Vec<&Bundle> {
        let bundles = &self.model.bundles;
        let Some(place) = bundles.place(device).filter(|_| self.bundle_symmetry) else {
            return Vec::new();
        };
        let family = bundles.family(place);
        let Some(own) = family.get(place.bundle) else { return Vec::new() };
        family.iter().filter(|other| *other != own && self.are_equal(own, other)).collect()
    }

    /// Whether two bundles that can replace each other have the same choices left.
    fn are_equal(&self, one: &Bundle, other: &Bundle) -> bool {
        let mut devices = one.devices.iter().zip(&other.devices);
        let mut rules = one.rules.iter().zip(&other.rules);
        rules.all(|(&r, &s)| self.domains.rule[r] == self.domains.rule[s])
            && devices.all(|(&d, &e)| self.domains.same_domain(self.model, d, e))
            && self.are_opened_alike(one, other)
    }

    /// Whether swapping the bundles leaves the same facilities open.
    fn are_opened_alike(&self, one: &Bundle, other: &Bundle) -> bool {
        let (model, opened) = (self.model, &self.domains.opened);
        let Some(pricing) = self.pricing.as_ref().filter(|_| !opened.is_empty()) else {
            return true;
        };
        let partner = |device: DeviceId| {
            let here = |from: &Bundle, to: &Bundle| {
                let at = from.devices.iter().position(|d| *d == device)?;
                to.devices.get(at).copied()
            };
            here(one, other).or_else(|| here(other, one)).unwrap_or(device)
        };
        let alts = |f: &FacilityId| -> BTreeSet<AltId> {
            pricing.dualized.facilities[*f].alts.iter().copied().collect()
        };
        let image = |f: &FacilityId| -> BTreeSet<AltId> {
            let swapped = |&alt: &AltId| model.twin_alt(alt, partner(model.alt_device[alt]));
            pricing.dualized.facilities[*f].alts.iter().map(swapped).collect()
        };
        opened.iter().all(|f| {
            let image = image(f);
            opened.iter().any(|g| alts(g) == image)
        })
    }

    /// The same facility of the bundles that are interchangeable with the one that it belongs to.
    pub(super) fn equal_facilities(&self, alts: &[AltId]) -> Vec<Vec<AltId>> {
        let model = self.model;
        let Some(&first) = alts.first() else { return Vec::new() };
        let device = model.alt_device[first];
        let Some(place) = model.bundles.place(device) else { return Vec::new() };
        let positions: Option<Vec<usize>> = alts
            .iter()
            .map(|&alt| {
                let at = model.bundles.place(model.alt_device[alt])?;
                (at.family == place.family && at.bundle == place.bundle).then_some(at.position)
            })
            .collect();
        // A facility that other devices have too stays the same whatever changes places.
        let Some(positions) = positions else { return Vec::new() };
        let there = |bundle: &Bundle| {
            let twins = alts.iter().zip(&positions);
            let twin = |(&alt, &at): (&AltId, &usize)| {
                bundle.devices.get(at).map(|device| model.twin_alt(alt, *device))
            };
            twins.filter_map(twin).collect()
        };
        self.equal_bundles(device).into_iter().map(there).collect()
    }

    /// A rule that the wiring violates, or a spare board that it uses, that the bound does not
    /// include.
    pub(super) fn unpaid_charge(&self, choices: &Choices) -> Option<Branch> {
        let model = self.model;
        for Chosen { alt, cands } in choices {
            let rules = model.alt_rules[*alt].iter();
            let open =
                |r: &&RuleId| self.domains.rule[**r] == Charge::Open && !model.rule_local[**r];
            let mut rules = rules.chain(cands.iter().flat_map(|&c| &model.cand_rules[c]));
            if let Some(&rule) = rules.find(open) {
                return Some(Branch::Rule(rule));
            }
        }
        for chosen in choices {
            let board = model.alt_board[chosen.alt];
            if model.spare[board] && self.domains.board[board] == Charge::Open {
                return Some(Branch::Board(board));
            }
        }
        None
    }

    /// A spare board to close, if an answer below the limit can only save spare boards.
    pub(super) fn deciding_board(&self) -> Option<Branch> {
        let unit = self.model.weights.cost;
        let bound = self.pricing.as_ref()?.bound;
        let spare = &self.model.spare;
        let open = |b: &BoardId| spare[*b] && self.domains.board[*b] == Charge::Open;
        let tight = (self.goal.limit - 1) / unit == bound / unit;
        spare.ids().iter().find(open).filter(|_| tight).map(Branch::Board)
    }

    /// Any open choice.
    pub(super) fn any_branch(&self) -> Option<Branch> {
        let open = self.model.devices.iter().filter(|&d| self.domains.alts_left(d) > 1);
        if let Some(device) = open.min_by_key(|&d| self.domains.alts_left(d)) {
            return self.domains.alts(self.model, device).next().map(Branch::Alt);
        }
        self.model.devices.iter().find_map(|d| self.open_role(d))
    }

    /// A candidate of an open role of a decided device: the flow's, if it has one.
    pub(super) fn open_role(&self, device: DeviceId) -> Option<Branch> {
        let model = self.model;
        let roles = model.roles.of(self.domains.decided(device)?);
        let open = roles.iter().filter(|&role| self.domains.cands_left(role) > 1);
        let role = open.min_by_key(|&role| self.domains.cands_left(role))?;
        let flow = self.flow.at(model, device, roles.position(role)).map(|(pin, _)| pin);
        let here = |c: &CandId| Some(model.cand[*c].pin) == flow;
        let mut cands = self.domains.cands(model, role);
        cands.clone().find(here).or_else(|| cands.next()).map(Branch::Cand)
    }
}

#[cfg(feature = "inside")]
#[expect(
    missing_docs,
    clippy::unwrap_used,
    reason = "a test says by its name what it holds, and may panic"
)]
pub(crate) mod tests {
    use super::*;
    use crate::cancel::Cancel;
    use crate::model::Model;
    use crate::problem::{
        Alternative, Board, BoardId, Candidate, Claim, Device, Holder, Pin, PinId, Problem,
        ResourceId, Role, SignalId,
    };

    /// One pin of a board, and the group as which the alternative holds the resource, if it does.
    fn on(board: u32, pin: u32, group: Option<u32>) -> Alternative {
        let candidate = Candidate::new(PinId(pin), SignalId(pin));
        let claim = |group| Claim { resource: ResourceId(0), holder: Holder::Group(group) };
        Alternative {
            board: BoardId(board),
            claims: group.map(claim).into_iter().collect(),
            violates: Vec::new(),
            dma: Vec::new(),
            roles: vec![Role { candidates: vec![candidate] }],
        }
    }

    pub fn a_facility_of_unequal_boards_is_refused_where_it_is() {
        let first = vec![on(0, 0, Some(1)), on(0, 1, None), on(1, 2, None), on(1, 3, Some(1))];
        let second = vec![on(0, 1, Some(2)), on(1, 2, None)];
        let devices = [first, second].map(|alternatives| Device { alternatives });
        let pin = |pin: u32| Pin { board: BoardId(pin / 2), cost: 1, shared: false };
        let problem = Problem {
            pins: (0..4).map(pin).collect(),
            boards: vec![Board { spare: false }, Board { spare: false }],
            devices: devices.to_vec(),
            resources: 1,
            ..Problem::default()
        };
        let model = Model::new(&problem).unwrap();
        let mut engine = Engine::new(&problem, &model, Cancel::NEVER).ok().unwrap();
        engine.board_symmetry = true;
        engine.goal.limit = model.most;
        engine.settle().ok().unwrap();
        engine.bound_by_prices(1).ok().unwrap();
        let facilities = &engine.pricing.as_ref().unwrap().dualized.facilities;
        let of_both = facilities.enumerate().find(|f| f.1.alts == [AltId(0), AltId(3)]).unwrap().0;
        engine.refuse(Branch::Facility(of_both)).ok().unwrap();
        let alive: Vec<u32> = (0..6).filter(|&alt| engine.domains.has_alt(AltId(alt))).collect();
        assert_eq!(alive, [1, 2, 4, 5]);
    }
}
