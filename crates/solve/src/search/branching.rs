//! What a node splits on: an open choice in, the domains with it or without it out.
//!
//! A choice is taken, or taken away from the device and all its interchangeable siblings at once,
//! which is what breaks their symmetry.
#![expect(clippy::indexing_slicing, reason = "all ids come from the model")]

use crate::domains::{Charge, Dead};
use crate::search::{Choices, Engine};

/// What a node splits on: taken first, then refused.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Branch {
    Alt(usize),
    Cand(usize),
    Rule(usize),
    Board(usize),
    /// Somebody uses the facility, or nobody.
    Facility(usize),
}

impl Engine<'_> {
    pub(crate) fn take(&mut self, branch: Branch) -> Result<(), Dead> {
        for board in self.boards_of(branch) {
            self.domains.touch(board);
        }
        match branch {
            Branch::Alt(alt) => self.domains.decide(self.model, alt),
            Branch::Cand(id) => self.domains.pin(self.model, id),
            Branch::Rule(rule) => self.domains.close_rule(self.model, rule),
            Branch::Board(board) => self.domains.close_board(self.model, board),
            Branch::Facility(facility) => {
                self.domains.open(facility);
                Ok(())
            }
        }
    }

    pub(crate) fn refuse(&mut self, branch: Branch) -> Result<(), Dead> {
        let model = self.model;
        match branch {
            Branch::Alt(alt) => {
                let device = model.alt_device[alt];
                let twins = self.twins(device);
                for alt in self.equals(branch).filter_map(|b| model.boards.alt_on(model, alt, b)) {
                    let offset = alt - model.alts.range(device).start;
                    for &twin in &twins {
                        self.domains.kill_alt(model, model.alts.range(twin).start + offset)?;
                    }
                }
                Ok(())
            }
            Branch::Cand(id) => {
                let device = model.cand_device(id);
                let twins = self.twins(device);
                for id in self.equals(branch).filter_map(|b| model.boards.cand_on(model, id, b)) {
                    let offset = id - self.first_cand(device);
                    for &twin in &twins {
                        self.domains.kill_cand(model, self.first_cand(twin) + offset)?;
                    }
                }
                Ok(())
            }
            Branch::Rule(rule) => self.domains.pay_rule(model, rule),
            Branch::Board(_) => {
                self.equals(branch).try_for_each(|board| self.domains.pay_board(model, board))
            }
            Branch::Facility(facility) => {
                let Some(prices) = &self.prices else { return Ok(()) };
                let alts = &prices.terms.facilities[facility].alts;
                // What several boards share is refused as it is: the boards need not be equal.
                let boards = self.boards_of(branch);
                let [_] = boards.as_slice() else {
                    return alts.iter().try_for_each(|&alt| self.domains.kill_alt(model, alt));
                };
                for board in self.equals(branch) {
                    let here = |alt: &usize| model.boards.alt_on(model, *alt, board);
                    for alt in alts.iter().filter_map(here) {
                        self.domains.kill_alt(model, alt)?;
                    }
                }
                Ok(())
            }
        }
    }

    /// The boards that a branch is about. Rules are the same on equal boards.
    fn boards_of(&self, branch: Branch) -> Vec<usize> {
        let model = self.model;
        match branch {
            Branch::Alt(alt) => vec![model.alt_board[alt]],
            Branch::Cand(id) => vec![model.alt_board[model.cand_alt(id)]],
            Branch::Rule(_) => Vec::new(),
            Branch::Board(board) => vec![board],
            Branch::Facility(facility) => {
                let terms = self.prices.as_ref().map(|prices| &prices.terms);
                let alts = terms.iter().flat_map(|terms| &terms.facilities[facility].alts);
                let mut boards: Vec<usize> = alts.map(|&alt| model.alt_board[alt]).collect();
                boards.sort_unstable();
                boards.dedup();
                boards
            }
        }
    }

    /// The board of a branch and those that are equal to it here and now: nothing is decided of
    /// any of them. An answer with what is refused on one of them has its like with that on the
    /// board where it was tried.
    fn equals(&self, branch: Branch) -> impl Iterator<Item = usize> + use<> {
        let first = &self.model.boards.first_equal;
        let mut boards = self.boards_of(branch);
        if let &[board] = boards.as_slice()
            && self.mirrors
            && !self.domains.is_touched(board)
        {
            let equal = |b: &usize| first[*b] == first[board] && !self.domains.is_touched(*b);
            boards = (0..first.len()).filter(equal).collect();
        }
        boards.into_iter()
    }

    fn first_cand(&self, device: usize) -> usize {
        let role = self.model.roles.range(self.model.alts.range(device).start).start;
        if role < self.model.role_alt.len() { self.model.cands.range(role).start } else { 0 }
    }

    /// The device and those that are interchangeable with it here and now.
    fn twins(&self, device: usize) -> Vec<usize> {
        let class = self.model.class[device];
        let same = |&d: &usize| {
            self.model.class[d] == class
                && (d == device || self.domains.same_domain(self.model, d, device))
        };
        (class..self.model.devices).filter(same).collect()
    }

    /// A rule or spare board that the wiring uses although the bound does not pay for it.
    pub(crate) fn open_toll(&self, choices: &Choices) -> Option<Branch> {
        let model = self.model;
        for (alt, cands) in choices {
            let rules = model.alt_rules.at(*alt).iter();
            let open =
                |r: &&usize| self.domains.rule[**r] == Charge::Open && !model.rule_local[**r];
            let mut rules = rules.chain(cands.iter().flat_map(|&c| model.cand_rules.at(c)));
            if let Some(&rule) = rules.find(open) {
                return Some(Branch::Rule(rule));
            }
        }
        for (alt, _) in choices {
            let board = model.alt_board[*alt];
            if model.spare[board] && self.domains.board[board] == Charge::Open {
                return Some(Branch::Board(board));
            }
        }
        None
    }

    /// A spare board to do without, where nothing but their number can be better.
    pub(crate) fn deciding_board(&self) -> Option<Branch> {
        let unit = self.model.weights.cost;
        let bound = self.prices.as_ref()?.bound;
        let open = |b: &usize| self.model.spare[*b] && self.domains.board[*b] == Charge::Open;
        let tight = (self.limit - 1) / unit == bound / unit;
        (0..self.model.spare.len()).find(open).filter(|_| tight).map(Branch::Board)
    }

    /// Any open choice.
    pub(crate) fn any_branch(&self) -> Option<Branch> {
        let model = self.model;
        let open = (0..model.devices).filter(|&d| self.domains.device_left(d) > 1);
        if let Some(device) = open.min_by_key(|&d| self.domains.device_left(d)) {
            return self.domains.alts(model, device).next().map(Branch::Alt);
        }
        (0..model.devices).find_map(|d| self.open_role(d))
    }

    pub(crate) fn open_role(&self, device: usize) -> Option<Branch> {
        let model = self.model;
        let alt = self.domains.decided(device)?;
        let (position, role) = model
            .roles
            .range(alt)
            .enumerate()
            .filter(|(_, r)| self.domains.role_left(*r) > 1)
            .min_by_key(|(_, r)| self.domains.role_left(*r))?;
        let flow = self.flow.at(model, device, position).map(|(pin, _)| pin);
        let here = |c: &usize| Some(model.cand(*c).pin) == flow;
        let mut cands = self.domains.cands(model, role);
        cands.clone().find(here).or_else(|| cands.next()).map(Branch::Cand)
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test may panic")]
mod tests {
    use super::*;
    use crate::cancel::Cancel;
    use crate::model::Model;
    use crate::problem::{
        Alternative, Board, BoardId, Candidate, Claim, Device, Holder, Pin, PinId, Problem,
        ResourceId, Role, SignalId,
    };

    /// One pin of a board, and the group as which it holds the resource, if it does.
    fn on(board: u32, pin: u32, group: Option<u32>) -> Alternative {
        let candidate = Candidate {
            pin: PinId(pin),
            holder: Holder::Own,
            signal: SignalId(pin),
            claims: Vec::new(),
            violates: Vec::new(),
            moved: false,
        };
        let claim = |group| Claim { resource: ResourceId(0), holder: Holder::Group(group) };
        Alternative {
            board: BoardId(board),
            claims: group.map(claim).into_iter().collect(),
            violates: Vec::new(),
            dma: Vec::new(),
            roles: vec![Role { candidates: vec![candidate] }],
        }
    }

    #[test]
    fn a_facility_of_unequal_boards_is_refused_where_it_is_and_nowhere_else() {
        let first = vec![on(0, 0, Some(1)), on(0, 1, None), on(1, 2, None), on(1, 3, Some(1))];
        let second = vec![on(0, 1, Some(2)), on(1, 2, None)];
        let devices = [first, second].map(|alternatives| Device { alternatives });
        let pin = |pin: u32| Pin { board: BoardId(pin / 2), cost: 1, shared: false };
        let problem = Problem {
            pins: (0..4).map(pin).collect(),
            boards: vec![Board { spare: false }, Board { spare: false }],
            devices: devices.to_vec(),
            dma: Vec::new(),
            rules: 0,
            resources: 1,
            streams: 0,
        };
        let model = Model::new(&problem).unwrap();
        let mut engine = Engine::new(&problem, &model, Cancel::NEVER).ok().unwrap();
        engine.mirrors = true;
        engine.limit = model.most;
        engine.settle().ok().unwrap();
        engine.bound_by_prices(1).ok().unwrap();
        let facilities = &engine.prices.as_ref().unwrap().terms.facilities;
        let of_both = facilities.iter().position(|facility| facility.alts == [0, 3]).unwrap();
        engine.refuse(Branch::Facility(of_both)).ok().unwrap();
        let alive: Vec<usize> = (0..6).filter(|&alt| engine.domains.alt_on(alt)).collect();
        assert_eq!(alive, [1, 2, 4, 5]);
    }
}
