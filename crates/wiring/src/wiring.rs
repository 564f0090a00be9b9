//! The pin problem of a design, and the questions that the solver answers by itself.
//!
//! In: a design, and an earlier wiring of which as much as possible is kept. Out: wirings, their
//! number, what each pin costs, or the bare conflict. Why there is no wiring takes further problems:
//! that is in `explain.rs`.

use std::collections::BTreeSet;

use sensedsl_certify::Labels;
use sensedsl_diagnostics::codes::{
    e0402_solver_disagrees, e0404_out_of_time, e0506_hardware_limit,
};
use sensedsl_diagnostics::{Diagnostic, Span};
use sensedsl_model::design::{ConnectionIndex, Design, Preference, PreferenceSubject};
use sensedsl_solve as solver;
use sensedsl_solve::{
    Answers, Cancel, Conflict, Count, Experience, Fault, Objective, Options, Outcome,
};

use crate::answers::{Found, Posed, Search, Solved};
use crate::assignment::{Assignment, Bound};
use crate::builder::Converters;
use crate::formulate::{Formulation, ProblemForm, formulate};
use crate::keep::Keep;
use crate::why::{self, Alternative};
use crate::{checks, conflict, labels, read_back};

/// The pin problem of a design, ready to be asked.
pub struct Wiring<'a> {
    pub(crate) design: &'a Design,
    keep: Option<Keep>,
    pub(crate) formulation: Formulation<'a>,
    /// Whether wishes for arrays are part of the problem.
    wishes: bool,
    pub(crate) cancel: Cancel<'a>,
}

/// The meaning of an outcome of the solver for the design.
pub(crate) enum OutcomeMeaning {
    Solved(Solved),
    /// A wiring of the pins that leaves the converters no DMA stream.
    NoStreams,
    Infeasible(Conflict),
}

impl<'a> Wiring<'a> {
    /// Puts the problem of a design; if an earlier wiring is given, as few wires as possible are to
    /// be moved.
    #[must_use]
    pub fn new(design: &'a Design, keep: Option<&Keep>) -> Self {
        Self::within(design, keep, Cancel::NEVER)
    }

    /// Like [`Self::new`], but once it is cancelled, all questions to it end with what is known by
    /// then.
    #[must_use]
    pub fn within(design: &'a Design, keep: Option<&Keep>, cancel: Cancel<'a>) -> Self {
        let asked = ProblemForm { converters: Converters::Later, wishes: true };
        Self::put(design, keep, asked, cancel)
    }

    fn put(
        design: &'a Design,
        keep: Option<&Keep>,
        asked: ProblemForm,
        cancel: Cancel<'a>,
    ) -> Self {
        let formulation = formulate(design, keep, asked, cancel);
        Self { design, keep: keep.cloned(), formulation, wishes: asked.wishes, cancel }
    }

    /// The same problem with the converters in it, in case the best wiring leaves them no DMA
    /// streams; `None` if they are already in it.
    pub(crate) fn with_converters(&self) -> Option<Self> {
        let later = self.formulation.converters == Converters::Later;
        let asked = ProblemForm { converters: Converters::Now, wishes: true };
        later.then(|| Self::put(self.design, self.keep.as_ref(), asked, self.cancel))
    }

    /// The problem as it is put to the solver.
    #[must_use]
    pub fn problem(&self) -> &solver::Problem {
        &self.formulation.problem
    }

    /// Reports what is wrong with the placement of single devices, and rules that have no effect.
    /// If there is an error among the reports, there is no wiring, and a conflict would say less.
    #[must_use]
    pub fn check(&self) -> Vec<Diagnostic> {
        if !self.formulation.complete {
            return Vec::new();
        }
        let mut diagnostics = checks::hopeless(self.design, &self.formulation);
        diagnostics.extend(checks::rules(self.design));
        diagnostics
    }

    /// Warnings about a wiring.
    #[must_use]
    pub fn warnings(&self, assignment: &Assignment) -> Vec<Diagnostic> {
        checks::of_wiring(self.design, assignment)
    }

    /// Whether there is certainly no wiring; the reason is not looked for, which saves most of the
    /// time.
    pub(crate) fn is_impossible(&self) -> bool {
        self.formulation.complete
            && solver::feasible(&self.formulation.problem, self.cancel) == Ok(Some(false))
    }

    /// Like [`Self::solve`], but without looking for repairs.
    #[must_use]
    pub fn solve_only(&self, any: bool) -> Solved {
        match self.named(self.search(&Search { any, rise: 0 })) {
            OutcomeMeaning::Solved(solved) => solved,
            OutcomeMeaning::NoStreams => match self.with_converters() {
                Some(wiring) => wiring.solve_only(any),
                None => self.no_streams(),
            },
            OutcomeMeaning::Infeasible(conflict) => {
                Solved::Infeasible(conflict::named(self.design, &self.formulation, &conflict))
            }
        }
    }

    /// One of the best wirings, which shows what the best costs; `None` if there is none. It looks
    /// neither for the reason for that nor for the one of the best that is first in order.
    #[must_use]
    pub fn one_of_the_best(&self) -> Option<Solved> {
        let cancelled = Ok(Some(Outcome::Stopped { answer: None, bound: Objective::default() }));
        let found = if self.formulation.complete {
            solver::one_of_the_best(&self.formulation.problem, self.cancel)
        } else {
            cancelled
        };
        match self.named(found.transpose()?) {
            OutcomeMeaning::Solved(solved) => Some(solved),
            OutcomeMeaning::NoStreams => match self.with_converters() {
                Some(wiring) => wiring.one_of_the_best(),
                None => Some(self.no_streams()),
            },
            OutcomeMeaning::Infeasible(_) => None,
        }
    }

    pub(crate) fn search(&self, search: &Search) -> Result<Outcome, Fault> {
        Ok(self.search_and_learn(search)?.0)
    }

    pub(crate) fn search_and_learn(&self, search: &Search) -> Result<(Outcome, Experience), Fault> {
        if !self.formulation.complete {
            let stopped = Outcome::Stopped { answer: None, bound: Objective::default() };
            return Ok((stopped, Experience::default()));
        }
        let options = Options { any: search.any, cancel: self.cancel };
        solver::solve_and_learn(&self.formulation.problem, &options)
    }

    pub(crate) fn named(&self, outcome: Result<Outcome, Fault>) -> OutcomeMeaning {
        let failed =
            |fault: &Fault| OutcomeMeaning::Solved(Solved::Failed(Box::new(self.fault(fault))));
        match outcome {
            Ok(Outcome::Solved(answer)) => self.read(&answer, None),
            Ok(Outcome::Stopped { answer: Some(answer), bound }) => {
                let Objective { moved, violated, shared, cost, .. } = bound;
                self.read(&answer, Some(Bound { moved, violated, shared, cost }))
            }
            Ok(Outcome::Infeasible(conflict)) => OutcomeMeaning::Infeasible(conflict),
            Ok(Outcome::Stopped { answer: None, .. }) => failed(&Fault::Cancelled),
            Err(fault) => failed(&fault),
        }
    }

    /// For each pin that could serve connections of a device or a chip, the cost of the best wiring
    /// with it.
    #[must_use]
    pub fn why(&self, wiring: &Assignment, of: &[ConnectionIndex]) -> Found<Alternative> {
        why::why(self.design, &self.formulation, (wiring, of), self.cancel)
    }

    /// All wirings, best first, except those that leave the converters no streams.
    pub fn enumerate(&self) -> impl Iterator<Item = Solved> {
        let answers: Answers<'_> = solver::enumerate(&self.formulation.problem, self.cancel);
        let mut seen = BTreeSet::new();
        answers.filter_map(move |answer| match self.named(answer.map(Outcome::Solved)) {
            OutcomeMeaning::Solved(Solved::Wired(wiring)) if self.finds_twice() => {
                seen.insert(wiring.wires()).then_some(Solved::Wired(wiring))
            }
            OutcomeMeaning::Solved(solved) => Some(solved),
            OutcomeMeaning::NoStreams | OutcomeMeaning::Infeasible(_) => None,
        })
    }

    /// The exact number of wirings.
    ///
    /// # Errors
    /// The diagnostic of a fault in the solver.
    pub fn count(&self) -> Result<Count, Box<Diagnostic>> {
        if self.finds_twice() {
            let asked = ProblemForm { converters: self.formulation.converters, wishes: false };
            let (design, keep) = (self.design, self.keep.as_ref());
            return Self::put(design, keep, asked, self.cancel).count();
        }
        solver::count(&self.formulation.problem, self.cancel)
            .map_err(|fault| Box::new(self.fault(&fault)))
    }

    /// Whether a wiring that keeps a wish for an array is found a second time, as one that need
    /// not.
    fn finds_twice(&self) -> bool {
        let is_of_array = |wish: &Preference| {
            matches!(wish.what, PreferenceSubject::Together(_) | PreferenceSubject::Sequence)
        };
        let of_boards = self.design.boards.iter().flat_map(|board| &board.wishes);
        let mut arrays = self.design.connections.iter().filter(|one| one.element.is_some());
        self.wishes
            && arrays.clone().next().is_some()
            && (of_boards.clone().any(is_of_array)
                || arrays.any(|one| one.wishes.iter().any(is_of_array)))
    }

    /// The names of everything in the problem.
    #[must_use]
    pub fn labels(&self) -> Labels {
        labels::labels(self.design, &self.formulation)
    }

    /// The problem with its names and the solver's outcome, for other solvers to confirm.
    ///
    /// # Errors
    /// The diagnostic of a fault in the solver.
    pub fn posed(&self) -> Result<Posed, Box<Diagnostic>> {
        let outcome = self.search(&Search::default());
        let outcome = outcome.map_err(|fault| Box::new(self.fault(&fault)))?;
        if let Outcome::Solved(answer) = &outcome
            && let (OutcomeMeaning::NoStreams, Some(wiring)) =
                (self.read(answer, None), self.with_converters())
        {
            return wiring.posed();
        }
        Ok(Posed { problem: self.problem().clone(), labels: self.labels(), outcome })
    }

    /// The answer in names; `bound` is that of a search that was stopped.
    fn read(&self, answer: &solver::Answer, bound: Option<Bound>) -> OutcomeMeaning {
        match read_back::read_back(self.design, &self.formulation, answer) {
            Some(wiring) => {
                let (bound, neatness) = (bound.or(wiring.bound), self.neatness(answer));
                let wiring = Assignment { bound, neatness, ..wiring };
                OutcomeMeaning::Solved(Solved::Wired(Box::new(wiring)))
            }
            None => OutcomeMeaning::NoStreams,
        }
    }

    pub(crate) fn no_streams(&self) -> Solved {
        Solved::Failed(Box::new(e0506_hardware_limit::hardware_limit(
            self.place(),
            "the converters find no DMA stream beside the other peripherals",
            "fix another `unit` for one of the analog devices, or take another bus",
        )))
    }

    pub(crate) fn place(&self) -> Span {
        let board = self.design.boards.first();
        board.map_or_else(|| Span::new(self.design.file, 0..0), |board| board.name.span)
    }

    fn fault(&self, fault: &Fault) -> Diagnostic {
        if *fault == Fault::Cancelled {
            return e0404_out_of_time::out_of_time(self.place());
        }
        self.disagrees(&fault.to_string())
    }

    pub(crate) fn disagrees(&self, why: &str) -> Diagnostic {
        e0402_solver_disagrees::solver_disagrees(self.place(), why)
    }
}
