//! Questions to a snapshot, and their answers.

use std::borrow::Cow;

use sensedsl_certify::Subject;
use sensedsl_diagnostics::Diagnostic;
use sensedsl_diagnostics::codes::{e0404_out_of_time, w0604_unused_rule};
use sensedsl_model::design::{Design, Spanned};
use sensedsl_model::{Partial, apply_allows, settle_fixes, sort};
use sensedsl_wiring::assignment::Assignment;
use sensedsl_wiring::{Cancel, Keep, Proved, Search, Solved, Wiring};

use crate::{Snapshot, has_errors};

/// The wiring that is wanted.
#[derive(Clone, Copy, Debug, Default)]
pub enum Goal<'a> {
    /// The best wiring.
    #[default]
    Best,
    /// Any wiring.
    Any,
    /// The best wiring, with a certificate for this subject.
    Proved(&'a Subject),
}

/// A question to a snapshot. The default asks for the best wiring of a design without mistakes.
#[derive(Clone, Copy, Default)]
pub struct Ask<'a> {
    /// The wiring that is wanted.
    pub goal: Goal<'a>,
    /// The earlier wiring, from which as few wires as possible may move.
    pub keep: Option<&'a Keep>,
    /// By how much more the wiring may cost than the cheapest, if it is neater; a certificate is
    /// always of one of the cheapest.
    pub rise: u32,
    /// Whether to leave out everything in error and wire the rest.
    pub partly: bool,
    /// Tells the search when time is up.
    pub cancel: Cancel<'a>,
}

/// How long a search may last: by name, so that nobody takes one end for the other.
#[derive(Clone, Copy, Default)]
pub struct Patience<'a> {
    /// Once this is over, what was found by then is the answer.
    pub late: Cancel<'a>,
    /// Once this is over, no answer is wanted any more.
    pub stop: Cancel<'a>,
}

/// The result of a search, with all its diagnostics.
#[derive(Debug)]
pub struct Answer<'s> {
    /// The design that was wired; none if the snapshot has nothing to wire.
    pub design: Option<Cow<'s, Design>>,
    /// The names of the boards and devices that were left out, in file order.
    pub left_out: Vec<Spanned<String>>,
    /// The outcome of the search; none if mistakes ruled it out.
    pub solved: Option<Solved>,
    /// The text that proves the wiring, or why there is none; only if a certificate was requested.
    pub certificate: Option<Result<String, Box<Diagnostic>>>,
    /// The diagnostics of the snapshot and of the wiring, in the order of their places.
    pub diagnostics: Vec<Diagnostic>,
}

impl Answer<'_> {
    /// The same answer, which outlives its snapshot.
    #[must_use]
    pub fn into_owned(self) -> Answer<'static> {
        let Answer { design, left_out, solved, certificate, diagnostics } = self;
        let design = design.map(|design| Cow::Owned(design.into_owned()));
        Answer { design, left_out, solved, certificate, diagnostics }
    }

    /// The wiring, with its design.
    #[must_use]
    pub fn wired(&self) -> Option<(&Design, &Assignment)> {
        match (&self.design, &self.solved) {
            (Some(design), Some(Solved::Wired(wiring))) => Some((design, wiring)),
            (_, _) => None,
        }
    }
}

impl Snapshot {
    /// Wires the design. A design with mistakes is not wired, unless the question allows a part of
    /// it.
    #[must_use]
    pub fn solve(&self, ask: &Ask<'_>) -> Answer<'_> {
        let mut answer = self.answered(ask);
        settle_fixes(&mut answer.diagnostics, self.files(), self.trees(), self.sources());
        answer
    }

    /// The answer whose fixes are those of their builders.
    fn answered(&self, ask: &Ask<'_>) -> Answer<'_> {
        let known = self.diagnostics().to_vec();
        match (self.design(), self.partial()) {
            (Some(design), _) => {
                let answer = answer(Cow::Borrowed(design), known, ask);
                match &answer.design {
                    // There is a device that no pin can serve.
                    Some(design) if ask.partly && answer.solved.is_none() => {
                        let design = design.clone().into_owned();
                        let partial = Partial { design, left_out: Vec::new() };
                        in_part(partial.without(&answer.diagnostics), answer.diagnostics, ask)
                    }
                    _ => answer,
                }
            }
            (None, Some(partial)) if ask.partly => in_part(partial.clone(), known, ask),
            (None, _) => Answer {
                design: None,
                left_out: Vec::new(),
                solved: None,
                certificate: None,
                diagnostics: known,
            },
        }
    }
}

impl Snapshot {
    /// Wires the sound part of the design: the best wiring, or the best that was found in time, or else any.
    #[must_use]
    pub fn solve_best_or_any(&self, Patience { late, stop }: Patience<'_>) -> Answer<'_> {
        let is_over = || late.is_over() || stop.is_over();
        let cancel = Cancel::when(&is_over);
        let answer = self.solve(&Ask { partly: true, cancel, ..Ask::default() });
        match &answer.solved {
            Some(Solved::Failed(why)) if why.code == e0404_out_of_time::CODE => {
                self.solve(&Ask { goal: Goal::Any, partly: true, cancel: stop, ..Ask::default() })
            }
            _ => answer,
        }
    }
}

/// Wires a design without mistakes.
fn answer<'s>(
    design: Cow<'s, Design>,
    mut diagnostics: Vec<Diagnostic>,
    ask: &Ask<'_>,
) -> Answer<'s> {
    let wiring = Wiring::within(&design, ask.keep, ask.cancel);
    diagnostics.extend(wiring.check());
    let proved = (!has_errors(&diagnostics)).then(|| asked(&wiring, ask));
    let (solved, certificate) = match proved {
        Some(Proved { solved, certificate }) => (Some(solved), certificate),
        None => (None, None),
    };
    diagnostics.extend(of_wiring(&design, &wiring, solved.as_ref()));
    apply_allows(&design, &mut diagnostics);
    sort(&mut diagnostics);
    Answer { design: Some(design), left_out: Vec::new(), solved, certificate, diagnostics }
}

/// Wires the sound part of a design. Rules without effect are not reported: they may be about
/// something that was left out.
fn in_part<'s>(
    mut partial: Partial,
    mut diagnostics: Vec<Diagnostic>,
    ask: &Ask<'_>,
) -> Answer<'s> {
    if partial.design.devices.is_empty() {
        let Partial { design, left_out } = partial;
        let design = Some(Cow::Owned(design));
        return Answer { design, left_out, solved: None, certificate: None, diagnostics };
    }
    let mut hopeless = Wiring::within(&partial.design, ask.keep, ask.cancel).check();
    hopeless.retain(|one| !diagnostics.contains(one));
    partial = partial.without(&hopeless);
    let Partial { design, left_out } = partial;
    let wiring = Wiring::within(&design, ask.keep, ask.cancel);
    let solved = (!design.devices.is_empty()).then(|| asked(&wiring, ask).solved);
    let mut found = hopeless;
    found.extend(of_wiring(&design, &wiring, solved.as_ref()));
    found.retain(|one| one.code != w0604_unused_rule::CODE);
    apply_allows(&design, &mut found);
    found.retain(|one| one.code != w0604_unused_rule::CODE);
    // Earlier diagnostics keep their order: a full list begins with the reason that it is full.
    if !found.is_empty() {
        diagnostics.extend(found);
        sort(&mut diagnostics);
    }
    let design = Some(Cow::Owned(design));
    Answer { design, left_out, solved, certificate: None, diagnostics }
}

fn asked(wiring: &Wiring<'_>, ask: &Ask<'_>) -> Proved {
    match ask.goal {
        Goal::Best => {
            let search = Search { any: false, rise: ask.rise };
            Proved { solved: wiring.solve(&search), certificate: None }
        }
        Goal::Any => {
            let search = Search { any: true, rise: 0 };
            Proved { solved: wiring.solve(&search), certificate: None }
        }
        Goal::Proved(of) => wiring.solve_with_proof(of),
    }
}

/// The diagnostics for the outcome of a search.
fn of_wiring(design: &Design, wiring: &Wiring<'_>, solved: Option<&Solved>) -> Vec<Diagnostic> {
    match solved {
        Some(Solved::Wired(assignment)) => {
            let mut found = wiring.warnings(assignment);
            found.extend(sensedsl_timing::check(design, assignment));
            found
        }
        Some(Solved::Infeasible(conflict)) => vec![conflict.diagnostic(design)],
        Some(Solved::Failed(failure)) => vec![(**failure).clone()],
        None => Vec::new(),
    }
}
