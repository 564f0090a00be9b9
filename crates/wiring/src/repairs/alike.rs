//! Interchangeable devices: a change to one of them helps if the same change to another one does.

use std::collections::{BTreeMap, BTreeSet};

use sensedsl_model::design::{BoardIndex, Design};

use super::budget::TrialResult;
use super::repair::Repair;
use crate::formulate::{Formulation, Requester};

/// The properties that interchangeable devices have in common: their choices, and what decides on
/// their converters.
type Likeness = (usize, u32, i8);

/// A change to a device that may be one of several interchangeable ones: it goes to a board, or is
/// left out. The same change to another of them helps as much.
pub(super) type Change = (Likeness, Option<BoardIndex>);

/// The results of changes to interchangeable devices.
pub(super) struct Alike {
    /// For each device of the problem, the first that is interchangeable with it.
    first: Vec<usize>,
    tried: BTreeMap<Change, TrialResult>,
    unknown: BTreeSet<Change>,
}

impl Alike {
    pub(super) fn new(formulation: &Formulation<'_>) -> Self {
        let first = sensedsl_solve::alike(&formulation.problem).unwrap_or_default();
        Self { first, tried: BTreeMap::new(), unknown: BTreeSet::new() }
    }

    pub(super) fn of(
        &self,
        design: &Design,
        formulation: &Formulation<'_>,
        repair: &Repair,
    ) -> Option<Change> {
        let (index, to) = match repair {
            Repair::Drop(index) => (*index, None),
            Repair::Move(index, to) => (*index, Some(*to)),
            Repair::Free(_)
            | Repair::Share(_)
            | Repair::Retune(..)
            | Repair::Unreserve(..)
            | Repair::Release(..)
            | Repair::Relink(..) => return None,
        };
        let of_part = |asker: &Requester| {
            let Requester::Connection(connection) = asker else { return None };
            design.connection(*connection).filter(|one| one.part == index)
        };
        let mut all = formulation.askers.iter().enumerate();
        let (number, connection) = all.find_map(|(at, asker)| Some((at, of_part(asker)?)))?;
        // Several sets of wires are interchangeable only as a whole.
        if all.any(|(_, asker)| of_part(asker).is_some()) {
            return None;
        }
        let device = design.device(connection.device)?;
        Some(((*self.first.get(number)?, device.delay_ms, device.prio), to))
    }

    pub(super) fn known(&self, change: Change) -> Option<TrialResult> {
        if self.unknown.contains(&change) {
            return Some(TrialResult::Unknown);
        }
        self.tried.get(&change).copied()
    }

    /// Lets changes that were too hard be tried once more.
    pub(super) fn begin_round(&mut self) {
        self.unknown.clear();
    }

    pub(super) fn learn(&mut self, change: Change, tried: TrialResult) {
        if tried == TrialResult::Unknown {
            self.unknown.insert(change);
        } else {
            self.tried.insert(change, tried);
        }
    }
}
