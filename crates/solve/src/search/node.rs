//! One node of branch and bound: searches below the domains and keeps a better answer if there is
//! one.

use super::Engine;
use super::branch::Branch;
use crate::domains::{Pruned, streams};

/// Nodes that a search for any answer spends on the flow alone.
const PATIENCE: u64 = 3;

/// What to do at a node according to the prices.
enum Advice {
    /// Nothing better is below.
    Leave,
    /// The domains are smaller now.
    Again,
    Branch(Branch),
}

impl Engine<'_> {
    /// Searches below the current domains; leaves them smaller.
    pub(super) fn node(&mut self, depth: usize) {
        loop {
            self.progress.step();
            if self.dive_is_over() || self.is_stopped() || self.settle().is_err() {
                return;
            }
            let bound = self.bound();
            if bound >= self.goal.limit || !self.streams_may_suffice() {
                return;
            }
            let Some(fallback) = self.try_flow(bound) else { return };
            let branch = match self.advice(fallback, depth) {
                Advice::Leave => return,
                Advice::Again => continue,
                Advice::Branch(branch) => self.nearest(branch),
            };
            let limit = self.goal.limit;
            let refused = self.follow(branch, depth);
            if refused.is_err() || self.goal.is_reached() {
                return;
            }
            // A better limit removes more at the root than anywhere below it.
            if self.goal.limit < limit && !self.goal.first && depth > 0 {
                return;
            }
        }
    }

    /// The branch that decides as the known choice does, as long as that is possible.
    fn nearest(&self, branch: Branch) -> Branch {
        let (Some(near), model) = (&self.goal.near, self.model) else { return branch };
        let known = match branch {
            Branch::Alt(alt) => {
                let known = near[model.alt_device[alt]].alt;
                self.domains.has_alt(known).then_some(Branch::Alt(known))
            }
            Branch::Cand(id) => {
                let alt = model.cand_alt(id);
                let position = model.roles.of(alt).position(model.cand[id].role);
                let chosen = Some(&near[model.alt_device[alt]]).filter(|chosen| chosen.alt == alt);
                let known = chosen.and_then(|chosen| chosen.cands.get(position));
                known.filter(|&&id| self.domains.has_cand(model, id)).map(|&id| Branch::Cand(id))
            }
            Branch::Rule(_) | Branch::Board(_) | Branch::Facility(_) => None,
        };
        known.unwrap_or(branch)
    }

    fn dive_is_over(&self) -> bool {
        let end = self.progress.dive_until;
        end.is_some_and(|end| self.goal.best.is_some() || self.progress.nodes > end)
    }

    pub(super) fn is_stopped(&mut self) -> bool {
        self.progress.stopped |= self.progress.is_spent() || self.cancel.is_over();
        self.progress.stopped
    }

    pub(super) fn streams_may_suffice(&self) -> bool {
        !self.model.dma_matters || streams::may_suffice(self.problem, self.model, &self.domains)
    }

    /// Bounds by prices and rounds the linear program, when it is time for that.
    fn advice(&mut self, fallback: Branch, depth: usize) -> Advice {
        if !self.prices_are_due() {
            return Advice::Branch(fallback);
        }
        match self.price() {
            Err(Pruned) => return Advice::Leave,
            Ok(true) => return Advice::Again,
            Ok(false) => {}
        }
        let limit = self.goal.limit;
        self.round();
        if self.goal.limit < limit {
            return if self.goal.first || depth > 0 { Advice::Leave } else { Advice::Again };
        }
        match self.choose_branch(fallback) {
            Err(Pruned) => Advice::Leave,
            Ok(None) => Advice::Again,
            Ok(Some(branch)) => Advice::Branch(branch),
        }
    }

    /// Whether it is time for the second bound.
    fn prices_are_due(&self) -> bool {
        self.progress.dive_until.is_none()
            && (!self.goal.first
                || self.pricing.is_some()
                || self.progress.of_this_search() > PATIENCE)
    }

    /// Reads a wiring off the flow and keeps it if it is better. Returns what to branch on, if
    /// anything.
    fn try_flow(&mut self, bound: u64) -> Option<Branch> {
        let choices = match self.read() {
            Ok(choices) => choices,
            Err(branch) => return branch,
        };
        let weight = self.model.evaluate(&choices);
        let charge = self.unpaid_charge(&choices);
        let tight = weight == bound && self.goal.counts(weight);
        self.goal.offer((weight, choices));
        if self.goal.is_reached() || tight {
            return None;
        }
        charge.or_else(|| self.any_branch())
    }

    /// Searches with the branch taken, then refuses it here (unless the limit has improved, which
    /// makes the root start again, or the first answer was enough).
    fn follow(&mut self, branch: Branch, depth: usize) -> Result<(), Pruned> {
        let mark = self.domains.mark();
        let saved = self.flow.save();
        let limit = self.goal.limit;
        if self.take(branch).is_ok() {
            self.node(depth + 1);
        }
        if self.goal.is_reached() {
            return Ok(());
        }
        self.back(mark, &saved);
        if self.goal.limit < limit && !self.goal.first { Ok(()) } else { self.refuse(branch) }
    }
}
