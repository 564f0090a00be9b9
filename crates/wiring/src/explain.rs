//! The answer to a design, with the reason if there is no wiring: the rules that it needs, and
//! repairs that were tried.
//!
//! In: the problem of a design. Out: the best wiring with its certificate, or the conflict. The
//! reason is found by asking about designs that lack something, so this asks the problem, and the
//! problem does not know of it.

use sensedsl_certify::Subject;
use sensedsl_model::design::{Design, PartIndex};
use sensedsl_solve::{Cancel, Conflict, Experience};

use crate::answers::{Proved, Search, Solved};
use crate::conflict::{NoWiring, named};
use crate::formulate::Formulation;
use crate::wiring::{OutcomeMeaning, Wiring};
use crate::{blame, repairs};

impl Wiring<'_> {
    /// The best wiring, or any; otherwise the reason with its repairs.
    #[must_use]
    pub fn solve(&self, search: &Search) -> Solved {
        let (outcome, shown) = self.neatened(self.search(search), search);
        match self.named(outcome) {
            OutcomeMeaning::Solved(solved) => shown.note(solved),
            OutcomeMeaning::NoStreams => match self.with_converters() {
                Some(wiring) => wiring.solve(search),
                None => self.no_streams(),
            },
            OutcomeMeaning::Infeasible(conflict) => Solved::Infeasible(self.explained(&conflict)),
        }
    }

    /// Like [`Self::solve`], with the certificate that proves the answer, or the reason why there
    /// is none. `of` is what the design was made of.
    #[must_use]
    pub fn solve_with_proof(&self, of: &Subject) -> Proved {
        let search = Search::default();
        let (outcome, learned) = match self.search_and_learn(&search) {
            Ok((outcome, learned)) => (Ok(outcome), learned),
            Err(fault) => (Err(fault), Experience::default()),
        };
        let (outcome, shown) = self.neatened(outcome, &search);
        let certificate = self.certificate(&outcome, &learned, of);
        let solved = match self.named(outcome) {
            OutcomeMeaning::Solved(solved) => shown.note(solved),
            OutcomeMeaning::NoStreams => match self.with_converters() {
                Some(wiring) => return wiring.solve_with_proof(of),
                None => self.no_streams(),
            },
            OutcomeMeaning::Infeasible(conflict) => Solved::Infeasible(self.explained(&conflict)),
        };
        // A wiring that cannot be built is not a wiring, whatever was proved about its pins.
        let buildable = !matches!(solved, Solved::Failed(_));
        Proved { solved, certificate: certificate.filter(|_| buildable) }
    }

    fn explained(&self, conflict: &Conflict) -> NoWiring {
        read(self.design, &self.formulation, conflict, self.cancel)
    }
}

/// The solver's conflict in names, with repairs.
fn read(
    design: &Design,
    formulation: &Formulation<'_>,
    conflict: &Conflict,
    cancel: Cancel<'_>,
) -> NoWiring {
    let mut named = named(design, formulation, conflict);
    if !named.minimal {
        named.explained = false;
        return named;
    }
    if named.links.is_empty() && named.parts.iter().any(|part| has_several(design, *part)) {
        needed(design, &mut named.parts, cancel);
    }
    if named.links.is_empty() {
        named.rules = blame::rules(design, &named.parts, cancel);
    }
    let repairs = repairs::find(design, formulation, &named.parts, cancel);
    (named.repairs, named.others_remain) = (repairs.found, repairs.others_remain);
    named.explained = !cancel.is_over();
    named
}

fn has_several(design: &Design, part: PartIndex) -> bool {
    design.connections_of(part).nth(1).is_some()
}

/// Keeps only the parts that are needed for the conflict. Of a part with several sets of wires, the
/// solver has named only some; with all of them, another part may not be needed.
fn needed(design: &Design, parts: &mut Vec<PartIndex>, cancel: Cancel<'_>) {
    let mut at = 0;
    while at < parts.len() && parts.len() > 1 {
        let mut without = parts.clone();
        without.remove(at);
        let mut left = design.clone();
        left.retain_parts(|part, _| without.contains(&part));
        let wiring = Wiring::within(&left, None, cancel);
        if wiring.is_impossible() || matches!(wiring.solve_only(true), Solved::Infeasible(_)) {
            *parts = without;
        } else {
            at += 1;
        }
    }
}
