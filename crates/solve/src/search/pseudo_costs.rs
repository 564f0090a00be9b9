//! Pseudo-costs: gains of earlier branches in, the probable gain of the next one out.
//!
//! The idea is from M. Bénichou et al., *Experiments in mixed-integer linear programming*, 1971.

use super::branching::Branch;
use crate::index::{AltId, FacilityId, PenaltyId};
use std::collections::BTreeMap;

/// The pseudo-costs of a variable that was tried so often are reliable (T. Achterberg, T. Koch and A. Martin, *Branching
/// rules revisited*, 2005, call this reliability branching).
const RELIABLE: u32 = 4;

/// Names a variable. Devices of one class have their variables together.
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

/// Gains of earlier branches for each unit of distance: their sum and their number.
#[derive(Clone, Copy, Debug, Default)]
struct Side {
    sum: f64,
    number: u32,
}

/// The pseudo-costs of all variables, each with a side where the branch is taken and one where it
/// is refused.
#[derive(Clone, Debug, Default)]
pub(super) struct PseudoCosts {
    known: BTreeMap<Key, [Side; 2]>,
}

impl PseudoCosts {
    pub(super) fn note(&mut self, question: &Fractional, gains: [f64; 2]) {
        let sides = self.known.entry(question.key).or_default();
        for ((side, gain), missing) in sides.iter_mut().zip(gains).zip(question.missing()) {
            side.sum += gain / missing;
            side.number += 1;
        }
    }

    pub(super) fn is_known(&self, question: &Fractional) -> bool {
        self.known.get(&question.key).is_some_and(|[taken, _]| taken.number >= RELIABLE)
    }

    pub(super) fn expected(&self, question: &Fractional) -> [f64; 2] {
        let Some(sides) = self.known.get(&question.key) else { return [0.0; 2] };
        let [taken, refused] = sides.map(|side| side.sum / f64::from(side.number.max(1)));
        let [to_one, to_none] = question.missing();
        [taken * to_one, refused * to_none]
    }
}
