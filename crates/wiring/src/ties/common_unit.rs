//! One unit for all elements of an array whose candidates have sets of units: an alternative in, those
//! that keep the tie out.
//!
//! If sets that meet in pairs always meet in one unit, it is enough that elements agree in pairs,
//! which claims express. This is so on all MCUs there are. A table may have inputs of ADC1 and 2,
//! of 2 and 3, and of 1 and 3: then each element claims the units that are left after the one
//! before it, and those that are left after itself.

use std::collections::BTreeSet;

use sensedsl_model::design::{Board, BoardIndex};
use sensedsl_solve::problem::Alternative;

use super::{Tier, Tight, Units, only, words};
use crate::builder::{Builder, Meaning};
use crate::names::{Group, Tied};

impl Tier<'_> {
    /// Whether the sets of a board meet in one unit wherever they meet in pairs.
    pub(super) fn is_told_by_pairs(&self, board: BoardIndex) -> bool {
        let sets: Vec<&Units> = self.sets_on(board).collect();
        meet_by_pairs(&sets)
    }

    /// An alternative for each set of units that may be left before the element and after it.
    pub(super) fn by_common_unit(
        &self,
        builder: &mut Builder<'_>,
        number: u16,
        board: &Board,
        (alternative, meaning): (Alternative, Meaning),
    ) -> Tight {
        let sets: Vec<&Units> = self.sets_on(meaning.board).collect();
        let left = intersections(&sets);
        let previous: Vec<Option<&Units>> =
            if number == 0 { vec![None] } else { left.iter().map(Some).collect() };
        let is_last = usize::from(number) + 1 == self.connections.len();
        let mut all = Tight::new();
        for before in previous {
            for after in &left {
                let leads = |set: &Units| match before {
                    Some(before) => before & set == *after,
                    None => set == after,
                };
                let kept = only(alternative.clone(), meaning.clone(), |at| {
                    self.set(board, at).is_none_or(|set| leads(&set)).then(Vec::new)
                });
                let Some((mut kept, meaning)) = kept else { continue };
                let mut hold = |element: u16, units: &Units| {
                    let group = Group::Tie(meaning.board, words(units));
                    let resource = self.resource(Tied::Common(element));
                    kept.claims.push(builder.names.shared(resource, group));
                };
                if let Some((before, element)) = before.zip(number.checked_sub(1)) {
                    hold(element, before);
                }
                if !is_last {
                    hold(number, after);
                }
                all.push((kept, meaning));
            }
        }
        all
    }
}

/// All intersections of some of the sets, without the empty one.
fn intersections(sets: &[&Units]) -> BTreeSet<Units> {
    let mut all: BTreeSet<Units> = BTreeSet::new();
    for set in sets {
        let with: Vec<Units> = all.iter().map(|one| one & *set).collect();
        all.extend(with);
        all.insert((*set).clone());
    }
    all.retain(|one| !one.is_empty());
    all
}

/// Whether any sets that meet in pairs have one unit in common. This is so if, for any three units,
/// the sets that have two of them have one in common (Berge, *Hypergraphs*, 1989).
fn meet_by_pairs(sets: &[&Units]) -> bool {
    let units: Units = sets.iter().copied().flatten().cloned().collect();
    let units: Vec<&String> = units.iter().collect();
    let triples = units.iter().enumerate().flat_map(|(at, one)| {
        let behind = units.get(at + 1..).unwrap_or_default();
        behind.iter().enumerate().flat_map(move |(next, two)| {
            let last = behind.get(next + 1..).unwrap_or_default();
            last.iter().map(move |three| [*one, *two, *three])
        })
    });
    triples.into_iter().all(|triple| {
        let has_two =
            |set: &&&Units| triple.iter().filter(|unit| set.contains(**unit)).count() >= 2;
        let with_two = sets.iter().filter(has_two).map(|set| (*set).clone());
        with_two.reduce(|one, other| &one & &other).is_none_or(|common| !common.is_empty())
    })
}

#[cfg(test)]
mod tests {
    use super::{Units, intersections, meet_by_pairs};

    fn sets(words: &[&str]) -> Vec<Units> {
        words.iter().map(|word| word.chars().map(String::from).collect()).collect()
    }

    /// The definition itself: tries whatever can be chosen among the sets.
    fn by_trying(sets: &[&Units]) -> bool {
        (1..1_u32 << sets.len()).all(|mask| {
            let some: Vec<&Units> =
                (0..sets.len()).filter(|at| mask >> at & 1 == 1).map(|at| sets[at]).collect();
            let meet = |one: &&Units| some.iter().all(|other| !one.is_disjoint(other));
            let common = some.iter().map(|one| (*one).clone()).reduce(|one, other| &one & &other);
            !some.iter().all(meet) || common.is_some_and(|common| !common.is_empty())
        })
    }

    #[test]
    fn sets_that_meet_two_by_two() {
        let all = sets(&["1", "2", "12", "13", "23", "123", "14", "24", "34", "1234", "5"]);
        for mask in 0..1_u32 << all.len() {
            let some: Vec<&Units> =
                (0..all.len()).filter(|at| mask >> at & 1 == 1).map(|at| &all[at]).collect();
            assert_eq!(meet_by_pairs(&some), by_trying(&some), "{some:?}");
        }
    }

    #[test]
    fn what_can_be_left() {
        let all = sets(&["12", "23", "13"]);
        let left = intersections(&all.iter().collect::<Vec<_>>());
        assert_eq!(left, sets(&["1", "2", "3", "12", "23", "13"]).into_iter().collect());
    }
}
