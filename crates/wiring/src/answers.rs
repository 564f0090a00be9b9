//! What can be asked of a wiring's problem, and what comes back.
//!
//! In: nothing. Out: the types of questions and answers, which those who ask and those who explain
//! have in common.

use sensedsl_certify::Labels;
use sensedsl_diagnostics::Diagnostic;
use sensedsl_solve::Outcome;
use sensedsl_solve::problem::Problem;

use crate::assignment::Assignment;
use crate::conflict::NoWiring;

/// The kind of search that is wanted.
#[derive(Clone, Copy, Debug, Default)]
pub struct Search {
    /// True if any wiring will do.
    pub any: bool,
    /// By how much more the wiring may cost than the cheapest, if it is neater.
    pub rise: u32,
}

/// The things that were found, and whether time ran out before all of them were.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Found<T> {
    /// The things that were found.
    pub all: Vec<T>,
    /// False if there may be more.
    pub complete: bool,
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
    pub problem: Problem,
    /// The names of everything in it.
    pub labels: Labels,
    /// What the solver found.
    pub outcome: Outcome,
}
