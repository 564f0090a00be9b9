//! Whether a wish for one unit can be kept at all: finds the boards with a unit that may have room
//! for all elements of an array. If there is none, the wish is given up before the search, which
//! would have to find that out by trying.

use std::collections::{BTreeMap, BTreeSet};

use sensedsl_model::design::{BoardIndex, Together};
use sensedsl_solve::problem::{Candidate, Holder, PinId, ResourceId};

use super::{Elements, Tie, Tier, Units};

/// The pins and resources that candidates take for themselves.
#[derive(Default)]
struct Places {
    pins: BTreeSet<PinId>,
    /// One resource of each candidate; `None` if it takes none.
    resources: BTreeSet<Option<ResourceId>>,
    /// Whether several devices may hold one of the pins.
    shared: bool,
}

impl Places {
    fn add(&mut self, candidate: &Candidate) {
        self.pins.insert(candidate.pin);
        self.shared |= candidate.holder != Holder::Own;
        let own = candidate.claims.iter().filter(|claim| claim.holder == Holder::Own);
        self.resources.insert(own.map(|claim| claim.resource).min());
    }

    fn join(&mut self, other: &Self) {
        self.pins.extend(&other.pins);
        self.resources.extend(&other.resources);
        self.shared |= other.shared;
    }

    /// The most devices that can each have a place of their own.
    fn room(&self) -> usize {
        let all = if self.shared { usize::MAX } else { self.pins.len() };
        if self.resources.contains(&None) { all } else { all.min(self.resources.len()) }
    }
}

impl Tier<'_> {
    /// The boards on which some unit may have room for all elements: enough pins, and enough of the
    /// resources that candidates take for themselves.
    pub(super) fn boards_with_room(&self, elements: &Elements<'_>) -> BTreeSet<BoardIndex> {
        let boards = elements.meanings.iter().flatten().map(|meaning| meaning.board);
        let all: BTreeSet<BoardIndex> = boards.collect();
        if self.tie != Tie::Together(Together::Unit) {
            return all;
        }
        let mut places: BTreeMap<(BoardIndex, Units), Places> = BTreeMap::new();
        let pairs = elements.devices.iter().zip(elements.meanings.iter());
        for (alternative, meaning) in pairs.flat_map(|(d, m)| d.alternatives.iter().zip(m)) {
            let Some(board) = self.design.board(meaning.board) else { continue };
            let roles = alternative.roles.iter().zip(&meaning.roles);
            for (candidate, at) in roles.flat_map(|(r, c)| r.candidates.iter().zip(c)) {
                // A candidate that needs no unit fits everywhere.
                let Some(set) = self.set(board, at) else { return all };
                places.entry((meaning.board, set)).or_default().add(candidate);
            }
        }
        let has_room = |board: &BoardIndex| {
            self.sets_on(*board).any(|set| {
                let near =
                    places.iter().filter(|((at, other), _)| at == board && !set.is_disjoint(other));
                let mut together = Places::default();
                near.for_each(|(_, places)| together.join(places));
                together.room() >= self.connections.len()
            })
        };
        all.into_iter().filter(|board| !self.sets.contains_key(board) || has_room(board)).collect()
    }
}
