//! Pseudo-costs: gains of earlier branches in, the probable gain of the next one out.
//!
//! The idea is from M. Bénichou et al., *Experiments in mixed-integer linear programming*, 1971.

use super::branch::Branch;
use crate::index::{AltId, FacilityId, PenaltyId};
use std::collections::BTreeMap;

/// Identifies a variable. Devices of one class share their variables.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Key {
    Facility(FacilityId),
    Alt(AltId),
    Penalty(PenaltyId),
}

/// A variable that is fractional in the linear program, and the branch that decides it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fractional {
    pub(super) branch: Branch,
    pub(super) key: Key,
    /// Its fractional part.
    pub(super) part: f64,
}

impl Fractional {
    /// Its distance to the next whole number, up and down.
    fn missing(&self) -> [f64; 2] {
        [1.0 - self.part, self.part]
    }
}

/// The gain of each variable for each unit of distance, when it is taken and when it is refused.
/// One trial is enough: *Branching rules revisited* (T. Achterberg, T. Koch and A. Martin, 2005)
/// makes up to eight trials before it relies on the mean, but our programs are small and a trial
/// costs more than it saves.
#[derive(Clone, Debug, Default)]
pub(crate) struct PseudoCosts {
    known: BTreeMap<Key, [f64; 2]>,
}

impl PseudoCosts {
    pub(super) fn note(&mut self, question: &Fractional, gains: [f64; 2]) {
        let [taken, refused] = gains;
        let [to_one, to_none] = question.missing();
        self.known.insert(question.key, [taken / to_one, refused / to_none]);
    }

    pub(super) fn is_known(&self, question: &Fractional) -> bool {
        self.known.contains_key(&question.key)
    }

    /// The probable gains, or 0 if nothing is known.
    pub(super) fn expected(&self, question: &Fractional) -> [f64; 2] {
        let [taken, refused] = self.known.get(&question.key).copied().unwrap_or_default();
        let [to_one, to_none] = question.missing();
        [taken * to_one, refused * to_none]
    }
}
