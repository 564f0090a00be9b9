//! From a design to a wiring: puts the pin problem to the solver, and reads its answer back.
//!
//! # Example
//!
//! ```
//! use sensedsl_model::{NoFiles, Request, resolve};
//! use sensedsl_wiring::{Search, Solved, Wiring};
//!
//! let text = "board Rover on STM32F4DiscoveryBoard {
//!     sensor Light returns uint16 { id = 1; type = analog; }
//! }";
//! let request = Request { path: "rover.sense", text, ..Request::default() };
//! let design = resolve(&request, &NoFiles).design.unwrap();
//! let solved = Wiring::new(&design, None).solve(&Search::default());
//! let Solved::Wired(wiring) = solved else { panic!("there is a wiring") };
//!
//! let (on, board) = wiring.used(&design).next().unwrap();
//! let wire = &on.devices[0].wires[0];
//! assert_eq!(wire.pin(board).unwrap().name.as_str(), "PB0");
//! assert_eq!(wire.signal(board), "ADC12-IN8");
//! assert_eq!(wiring.cost, 1);
//! ```

mod alternatives;
pub mod assignment;
mod blame;
mod capacity;
mod certificate;
mod checks;
mod conflict;
mod converters;
mod formulate;
mod keep;
mod labels;
mod levels;
mod names;
mod offer;
mod read_back;
mod repairs;
mod streams;
mod ties;
mod why;
mod wishes;

use sensedsl_certify::{Labels, Subject};
use sensedsl_diagnostics::codes::{
    e0402_solver_disagrees, e0404_out_of_time, e0506_hardware_limit,
};
use sensedsl_diagnostics::{Diagnostic, Span};
use std::collections::BTreeSet;

use sensedsl_model::design::{ConnectionIndex, Design, Preference, PreferenceSubject};
use sensedsl_solve::{Answers, Conflict, Count, Experience, Fault, Objective, Options, Outcome};

use assignment::{Assignment, Bound};
use formulate::{Converters, Formulation, ProblemForm, formulate};

pub use blame::Rule;
pub use capacity::{Capacity, capacity};
pub use conflict::{Contested, NoWiring};
pub use keep::Keep;
pub use repairs::{Repair, Repaired};
pub use sensedsl_solve as solver;
pub use sensedsl_solve::Cancel;
pub use why::Alternative;

/// The kind of search that is wanted.
#[derive(Clone, Copy, Debug, Default)]
pub struct Search {
    /// True if any wiring will do.
    pub any: bool,
}

/// The things that were found, and whether time ran out before all of them were.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Found<T> {
    /// The things that were found.
    pub all: Vec<T>,
    /// False if there may be more.
    pub complete: bool,
}

/// The pin problem of a design, ready to be asked.
pub struct Wiring<'a> {
    design: &'a Design,
    keep: Option<Keep>,
    formulation: Formulation<'a>,
    /// Whether wishes for arrays are part of the problem.
    wishes: bool,
    cancel: Cancel<'a>,
}

/// The result of a question.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Solved {
    /// A wiring.
    Wired(Box<Assignment>),
    /// There is no wiring.
    Infeasible(NoWiring),
    /// The solver failed its own check; to be reported as it is.
    Failed(Box<Diagnostic>),
}

/// The meaning of an outcome of the solver for the design.
enum OutcomeMeaning {
    Solved(Solved),
    /// A wiring of the pins that leaves the converters no DMA stream.
    NoStreams,
    Infeasible(Conflict),
}

/// An answer with its proof.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Proved {
    /// The answer.
    pub solved: Solved,
    /// The text of its certificate, or the report that none was found; `None` if there is no answer
    /// to prove.
    pub certificate: Option<Result<String, Box<Diagnostic>>>,
}

/// The problem that was put to the solver last, and its outcome.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Posed {
    /// The problem.
    pub problem: solver::Problem,
    /// The names of everything in it.
    pub labels: Labels,
    /// What the solver found.
    pub outcome: Outcome,
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
    fn with_converters(&self) -> Option<Self> {
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

    /// The best wiring, or any; otherwise the reason with its repairs.
    #[must_use]
    pub fn solve(&self, search: &Search) -> Solved {
        match self.named(self.search(search)) {
            OutcomeMeaning::Solved(solved) => solved,
            OutcomeMeaning::NoStreams => match self.with_converters() {
                Some(wiring) => wiring.solve(search),
                None => self.no_streams(),
            },
            OutcomeMeaning::Infeasible(conflict) => Solved::Infeasible(self.explained(&conflict)),
        }
    }

    fn explained(&self, conflict: &Conflict) -> NoWiring {
        conflict::read(self.design, &self.formulation, conflict, self.cancel)
    }

    /// Whether there is certainly no wiring; the reason is not looked for, which saves most of the
    /// time.
    fn is_impossible(&self) -> bool {
        self.formulation.complete
            && solver::feasible(&self.formulation.problem, self.cancel) == Ok(Some(false))
    }

    /// Like [`Self::solve`], but without looking for repairs.
    #[must_use]
    pub fn solve_only(&self, any: bool) -> Solved {
        match self.named(self.search(&Search { any })) {
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

    /// Like [`Self::solve`], with the certificate that proves the answer, or the reason why there
    /// is none. `of` is what the design was made of.
    #[must_use]
    pub fn solve_with_proof(&self, of: &Subject) -> Proved {
        let (outcome, learned) = match self.search_and_learn(&Search { any: false }) {
            Ok((outcome, learned)) => (Ok(outcome), learned),
            Err(fault) => (Err(fault), Experience::default()),
        };
        let certificate = self.certificate(&outcome, &learned, of);
        let solved = match self.named(outcome) {
            OutcomeMeaning::Solved(solved) => solved,
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

    fn search(&self, search: &Search) -> Result<Outcome, Fault> {
        Ok(self.search_and_learn(search)?.0)
    }

    fn search_and_learn(&self, search: &Search) -> Result<(Outcome, Experience), Fault> {
        if !self.formulation.complete {
            let stopped = Outcome::Stopped { answer: None, bound: Objective::default() };
            return Ok((stopped, Experience::default()));
        }
        let options = Options { any: search.any, cancel: self.cancel };
        solver::solve_and_learn(&self.formulation.problem, &options)
    }

    fn named(&self, outcome: Result<Outcome, Fault>) -> OutcomeMeaning {
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
        let outcome = self.search(&Search { any: false });
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
                let bound = bound.or(wiring.bound);
                OutcomeMeaning::Solved(Solved::Wired(Box::new(Assignment { bound, ..wiring })))
            }
            None => OutcomeMeaning::NoStreams,
        }
    }

    fn no_streams(&self) -> Solved {
        Solved::Failed(Box::new(e0506_hardware_limit::hardware_limit(
            self.place(),
            "the converters find no DMA stream beside the other peripherals",
            "fix another `unit` for one of the analog devices, or take another bus",
        )))
    }

    fn place(&self) -> Span {
        let board = self.design.boards.first();
        board.map_or_else(|| Span::new(self.design.file, 0..0), |board| board.name.span)
    }

    fn fault(&self, fault: &Fault) -> Diagnostic {
        if *fault == Fault::Cancelled {
            return e0404_out_of_time::out_of_time(self.place());
        }
        self.disagrees(&fault.to_string())
    }

    fn disagrees(&self, why: &str) -> Diagnostic {
        e0402_solver_disagrees::solver_disagrees(self.place(), why)
    }
}
