//! Makes alternatives from the choices of single wires, so that the rules between the wires of one
//! device are kept.

use std::collections::BTreeSet;

use sensedsl_board::remap::Blocks;
use sensedsl_solve::problem::{Alternative, Claim, Role as SolverRole};

use super::{Alternatives, Maker};
use crate::builder::{Chosen, Meaning, board_id};

impl Maker<'_, '_> {
    /// The alternative, unless one of its roles has no candidate; several if roles could meet on
    /// one contact, or be in different remap blocks.
    pub(super) fn finish(
        &mut self,
        unit: Option<&str>,
        claims: &[Claim],
        roles: Vec<RoleCandidates>,
    ) -> Vec<Alternatives> {
        let board = self.offer.index;
        let mut made = Vec::new();
        let cases = self.apart(roles).into_iter().flat_map(|roles| self.in_one_block(roles, None));
        let cases: Vec<_> = cases.collect();
        for roles in cases {
            let dma = unit.map(|unit| self.builder.dma(board, unit));
            let violates = self.rules.violated_by_unit(self.offer, unit);
            let (roles, chosen) = roles.into_iter().unzip();
            let alternative = Alternative {
                board: board_id(board),
                claims: claims.to_vec(),
                violates,
                dma: dma.unwrap_or_default(),
                roles,
            };
            made.push((
                alternative,
                Meaning { board, unit: unit.map(str::to_owned), roles: chosen },
            ));
        }
        made
    }

    /// The same choices with no two wires of the device on one contact. Claims keep devices apart,
    /// not the wires of one device: if the first role may take a contact that a later one may take
    /// as well, each such contact makes a case of its own, so that no choice is in two cases.
    pub(super) fn apart(&self, mut roles: Vec<RoleCandidates>) -> Vec<Vec<RoleCandidates>> {
        if roles.iter().any(|(role, _)| role.candidates.is_empty()) {
            return Vec::new();
        }
        if roles.len() < 2 {
            return vec![roles];
        }
        let first = roles.remove(0);
        let pads = |(_, chosen): &RoleCandidates| -> BTreeSet<&str> {
            chosen.iter().filter_map(|at| self.offer.shared_pad(at.pin)).collect()
        };
        let later: BTreeSet<&str> = roles.iter().flat_map(pads).collect();
        let contested: Vec<&str> = pads(&first).intersection(&later).copied().collect();
        let free = keep(&first, |at| {
            self.offer.shared_pad(at.pin).is_none_or(|pad| !contested.contains(&pad))
        });
        let mut cases = vec![(free, roles.clone())];
        for pad in contested {
            let on = |at: &Chosen| self.offer.shared_pad(at.pin) == Some(pad);
            let others = roles.iter().map(|role| keep(role, |at| !on(at))).collect();
            cases.push((keep(&first, on), others));
        }
        let mut apart = Vec::new();
        for (first, others) in cases {
            if first.1.is_empty() {
                continue;
            }
            for mut roles in self.apart(others) {
                roles.insert(0, first.clone());
                apart.push(roles);
            }
        }
        apart
    }

    /// The same choices with all wires of the device in one remap block of its peripheral: one case
    /// for each combination of sets of blocks that have a block in common.
    pub(super) fn in_one_block(
        &self,
        mut roles: Vec<RoleCandidates>,
        common: Option<Blocks>,
    ) -> Vec<Vec<RoleCandidates>> {
        if roles.is_empty() {
            return vec![roles];
        }
        let first = roles.remove(0);
        let blocks = |at: &Chosen| {
            let pin = self.offer.board.table.pins.get(at.pin)?;
            Some(self.offer.blocks(pin.usages.get(at.usage?)?)?.1)
        };
        let sets: BTreeSet<Option<Blocks>> = first.1.iter().map(blocks).collect();
        let mut cases = Vec::new();
        for set in sets {
            let common = match (common, set) {
                (Some(common), Some(set)) => match common.and(set) {
                    Some(common) => Some(common),
                    None => continue,
                },
                (one, other) => one.or(other),
            };
            let kept = keep(&first, |at| blocks(at) == set);
            for mut others in self.in_one_block(roles.clone(), common) {
                others.insert(0, kept.clone());
                cases.push(others);
            }
        }
        cases
    }
}

/// A role's candidates and their meanings.
pub(super) type RoleCandidates = (SolverRole, Vec<Chosen>);

/// The candidates for which the condition holds.
pub(super) fn keep(
    (role, chosen): &RoleCandidates,
    fits: impl Fn(&Chosen) -> bool,
) -> RoleCandidates {
    let pairs = role.candidates.iter().zip(chosen).filter(|(_, at)| fits(at));
    let (candidates, chosen) = pairs.map(|(candidate, at)| (candidate.clone(), *at)).unzip();
    (SolverRole { candidates }, chosen)
}
