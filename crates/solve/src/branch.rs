//! What a node splits on: an open choice in, the domains with it or without it out.
//!
//! A choice is taken, or taken away from the device and all its interchangeable siblings at once,
//! which is what breaks their symmetry.
#![expect(clippy::indexing_slicing, reason = "all ids come from the model")]

use crate::search::{Choices, Engine};
use crate::state::{Dead, Toll};

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
        match branch {
            Branch::Alt(alt) => self.state.decide(self.model, alt),
            Branch::Cand(id) => self.state.pin(self.model, id),
            Branch::Rule(rule) => self.state.close_rule(self.model, rule),
            Branch::Board(board) => self.state.close_board(self.model, board),
            Branch::Facility(facility) => {
                self.state.open(facility);
                Ok(())
            }
        }
    }

    pub(crate) fn refuse(&mut self, branch: Branch) -> Result<(), Dead> {
        let model = self.model;
        match branch {
            Branch::Alt(alt) => {
                let device = model.alt_device[alt];
                let offset = alt - model.alts.range(device).start;
                for twin in self.twins(device) {
                    self.state.kill_alt(model, model.alts.range(twin).start + offset)?;
                }
                Ok(())
            }
            Branch::Cand(id) => {
                let device = model.cand_device(id);
                let offset = id - self.first_cand(device);
                for twin in self.twins(device) {
                    self.state.kill_cand(model, self.first_cand(twin) + offset)?;
                }
                Ok(())
            }
            Branch::Rule(rule) => self.state.pay_rule(model, rule),
            Branch::Board(board) => self.state.pay_board(model, board),
            Branch::Facility(facility) => {
                let Some(prices) = &self.prices else { return Ok(()) };
                let alts = &prices.terms.facilities[facility].alts;
                alts.iter().try_for_each(|&alt| self.state.kill_alt(model, alt))
            }
        }
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
                && (d == device || self.state.same_domain(self.model, d, device))
        };
        (class..self.model.devices).filter(same).collect()
    }

    /// A rule or spare board that the wiring uses although the bound does not pay for it.
    pub(crate) fn open_toll(&self, choices: &Choices) -> Option<Branch> {
        let model = self.model;
        for (alt, cands) in choices {
            let rules = model.alt_rules.at(*alt).iter();
            let open = |r: &&usize| self.state.rule[**r] == Toll::Open && !model.rule_local[**r];
            let mut rules = rules.chain(cands.iter().flat_map(|&c| model.cand_rules.at(c)));
            if let Some(&rule) = rules.find(open) {
                return Some(Branch::Rule(rule));
            }
        }
        for (alt, _) in choices {
            let board = model.alt_board[*alt];
            if model.spare[board] && self.state.board[board] == Toll::Open {
                return Some(Branch::Board(board));
            }
        }
        None
    }

    /// A spare board to do without, where nothing but their number can be better.
    pub(crate) fn deciding_board(&self) -> Option<Branch> {
        let unit = self.model.weights.cost;
        let bound = self.prices.as_ref()?.bound;
        let open = |b: &usize| self.model.spare[*b] && self.state.board[*b] == Toll::Open;
        let tight = (self.limit - 1) / unit == bound / unit;
        (0..self.model.spare.len()).find(open).filter(|_| tight).map(Branch::Board)
    }

    /// Any open choice.
    pub(crate) fn any_branch(&self) -> Option<Branch> {
        let model = self.model;
        let open = (0..model.devices).filter(|&d| self.state.device_left(d) > 1);
        if let Some(device) = open.min_by_key(|&d| self.state.device_left(d)) {
            return self.state.alts(model, device).next().map(Branch::Alt);
        }
        (0..model.devices).find_map(|d| self.open_role(d))
    }

    pub(crate) fn open_role(&self, device: usize) -> Option<Branch> {
        let model = self.model;
        let alt = self.state.decided(device)?;
        let (position, role) = model
            .roles
            .range(alt)
            .enumerate()
            .filter(|(_, r)| self.state.role_left(*r) > 1)
            .min_by_key(|(_, r)| self.state.role_left(*r))?;
        let flow = self.flow.at(model, device, position).map(|(pin, _)| pin);
        let here = |c: &usize| Some(model.cand(*c).pin) == flow;
        let mut cands = self.state.cands(model, role);
        cands.clone().find(here).or_else(|| cands.next()).map(Branch::Cand)
    }
}
