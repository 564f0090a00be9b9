//! Exact pin assignment: integers in, a checked answer out.
//!
//! Four pure functions over a [`Problem`]: [`solve`] gives the one best answer or the reason why
//! there is none, [`enumerate`] gives all answers, best first, [`count`] gives their number, and
//! [`check`] judges an answer without any code of the search. No answer leaves the crate unchecked.

pub mod answer;
mod bounds;
mod cancel;
mod check;
mod domains;
mod index;
mod model;
pub mod problem;
mod questions;
mod search;
pub mod trace;

pub use answer::{Answer, Choice, Conflict, Count, Fault, Objective, Optimality, Outcome};
pub use cancel::Cancel;
pub use check::{Violation, check};
pub use problem::Problem;
pub use questions::count::count;
pub use questions::enumerate::{Answers, enumerate};
pub use questions::solve::{
    Experience, Options, alike, feasible, one_of_the_best, solve, solve_and_learn,
};
pub use search::recorded::{equal_boards, record};
