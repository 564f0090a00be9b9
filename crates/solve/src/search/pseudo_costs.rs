//! Pseudo-costs: how far answers to a question have raised the bound in, how far the next answer
//! will probably raise it out.
//!
//! The idea is from M. Bénichou et al., *Experiments in mixed-integer linear programming*, 1971.

use super::branching::Branch;
use crate::index::{AltId, FacilityId, PenaltyId};
use std::collections::BTreeMap;

/// A question that was tried so often is known (T. Achterberg, T. Koch and A. Martin, *Branching
/// rules revisited*, 2005, call this reliability branching).
const RELIABLE: u32 = 4;

/// Which question it is, whatever device of a class it is asked of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Key {
    Facility(FacilityId),
    Alt(AltId),
    Penalty(PenaltyId),
}

/// Something that the linear program leaves fractional.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fractional {
    pub(super) branch: Branch,
    pub(super) key: Key,
    /// How much of it there is beyond a whole number.
    pub(super) part: f64,
}

impl Fractional {
    /// What is missing to a whole one, and to none.
    fn missing(&self) -> [f64; 2] {
        [1.0 - self.part, self.part]
    }
}

/// How much earlier answers to a question have raised the bound, for each whole that was missing.
#[derive(Clone, Copy, Debug, Default)]
struct Side {
    sum: f64,
    number: u32,
}

/// What is known of all questions: the side where it is taken, and where it is refused.
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
