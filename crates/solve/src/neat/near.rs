//! Search near a wiring: one or two parts leave their contacts, and the others keep the contacts
//! between which they are (P. Shaw, *Using constraint programming and local search methods to solve
//! vehicle routing problems*, 1998).
//!
//! This finds most of what there is to find, so that branch and bound has less to search.

use super::part::{Runs, pins_between, runs_in_use, used};
use super::question::Reply;
use super::search::{Phase, Search, State, goal};
use crate::model::Choices;

/// The work that a search with two parts is worth, about 5 ms.
const TWO: u64 = 100_000;

impl Search<'_, '_> {
    /// Searches near the best wiring until nothing is neater.
    pub(super) fn improve(&mut self, phase: &Phase) {
        let is_complete = self.is_complete;
        let number = self.parts.open.len();
        let pairs = (0..number).flat_map(|step| (0..number - step).map(move |at| (at, at + step)));
        let pairs: Vec<(usize, usize)> = pairs.collect();
        let mut since = 0;
        for (one, other) in pairs.iter().copied().cycle() {
            if since == pairs.len() || self.is_over() {
                break;
            }
            let before = self.neatness;
            self.free(phase, &[one, other]);
            if one == other && !phase.whole {
                while self.shorten(phase, one) && !self.is_over() {}
            }
            since = if self.neatness < before { 0 } else { since + 1 };
        }
        self.is_complete = is_complete;
    }

    /// Searches wirings in which only these parts leave their contacts.
    fn free(&mut self, phase: &Phase, free: &[usize]) {
        let known = self.best.clone();
        let saved = self.engine.flow.save();
        let mark = self.engine.domains.mark();
        let state = self.with_others_kept(phase, free, &known);
        let until = self.until;
        self.until = until.min(self.engine.progress.work + TWO);
        self.node(phase, state, &known);
        self.until = until;
        self.engine.back(mark, &saved);
    }

    /// Leaves all parts but these only the contacts between which they are.
    fn with_others_kept(&mut self, phase: &Phase, free: &[usize], known: &Choices) -> State {
        let mut state = self.nothing_given();
        let parts = self.parts.open.iter().zip(&mut state.given).enumerate();
        for (_, (part, given)) in parts.filter(|(number, _)| !free.contains(number)) {
            let used = used(self.engine.model, self.layout, known, &part.devices);
            let mut runs = runs_in_use(self.layout, &used);
            if phase.whole {
                runs.values_mut().for_each(|run| *run = (0, u32::MAX));
            }
            *given = Some(goal(used.neatness, phase.whole));
            let pins = pins_between(self.layout, &part.live, &runs);
            // The known wiring is always left.
            let _ = self.engine.leave_pins(&part.devices, &pins, self.limit);
        }
        state
    }

    /// Tries to take a contact from an end of what a part uses. True if that was possible.
    fn shorten(&mut self, phase: &Phase, number: usize) -> bool {
        let Some(part) = self.parts.open.get(number) else { return false };
        let known = self.best.clone();
        let before = self.neatness;
        let saved = self.engine.flow.save();
        let mark = self.engine.domains.mark();
        self.with_others_kept(phase, &[number], &known);
        let used = used(self.engine.model, self.layout, &known, &part.devices);
        for shorter in shorter(&runs_in_use(self.layout, &used)) {
            let pins = pins_between(self.layout, &part.live, &shorter);
            let saved = self.engine.flow.save();
            let mark = self.engine.domains.mark();
            if self.engine.leave_pins(&part.devices, &pins, self.limit).is_ok()
                && let Reply::Yes(choices) = self.engine.wiring_within(self.limit, &known)
            {
                self.offer(&choices);
            }
            self.engine.back(mark, &saved);
            if self.neatness < before {
                break;
            }
        }
        self.engine.back(mark, &saved);
        self.neatness < before
    }
}

/// The runs with a contact less at one end of one of them.
fn shorter(runs: &Runs) -> Vec<Runs> {
    let mut all = Vec::new();
    for (side, (first, last)) in runs.iter().filter(|(_, (first, last))| first < last) {
        for run in [(first + 1, *last), (*first, last - 1)] {
            let mut shorter = runs.clone();
            shorter.insert(*side, run);
            all.push(shorter);
        }
    }
    all
}
