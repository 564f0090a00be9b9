//! A pin problem in, a program for another solver out: SWI-Prolog or the Alloy Analyzer. Each of
//! them answers the problem in its own way, and so confirms the best cost.
//!
//! # Example
//!
//! ```
//! use sensedsl_certify::Labels;
//! use sensedsl_export::{alloy, prolog};
//! use sensedsl_solve::{Options, Problem, solve};
//!
//! let (problem, labels) = (Problem::default(), Labels::default());
//! assert!(prolog(&problem, &labels).starts_with("% The best wiring"));
//!
//! let outcome = solve(&problem, &Options::default()).unwrap();
//! assert!(alloy(&problem, &labels, &outcome).contains("run any for 1 Int expect 1"));
//! ```

mod alloy;
mod prolog;

use sensedsl_certify::Labels;
use sensedsl_solve::{Outcome, Problem};

/// The problem as a program for SWI-Prolog that prints the best cost.
#[must_use]
pub fn prolog(problem: &Problem, labels: &Labels) -> String {
    prolog::program(problem, labels)
}

/// The problem as a model for the Alloy Analyzer, which confirms the solver's outcome: that there
/// is a wiring, and that none is better.
#[must_use]
pub fn alloy(problem: &Problem, labels: &Labels, outcome: &Outcome) -> String {
    alloy::model(problem, labels, outcome.into())
}
