//! Exact pin assignment: integers in, a checked answer out.
//!
//! Four pure functions over a [`Problem`]: [`solve`] gives the one best answer or the reason why
//! there is none, [`enumerate`] all answers best first, [`count`] their number, [`check`] judges
//! an answer without any code of the search. No answer leaves the crate unchecked.

pub mod answer;
mod boards;
mod branch;
mod cancel;
mod check;
mod conflict;
mod count;
mod dma;
mod dual;
mod enumerate;
mod flow;
mod frontier;
mod guide;
mod lore;
mod lp;
mod model;
mod order;
pub mod problem;
mod program;
mod proper;
mod read;
mod relax;
mod rows;
mod search;
mod sharing;
mod solve;
mod state;
mod swap;
mod terms;
mod view;
mod wires;

pub use answer::{Answer, Choice, Conflict, Count, Fault, Objective, Optimality, Outcome};
pub use cancel::Cancel;
pub use check::{Violation, check};
pub use count::count;
pub use enumerate::{Answers, enumerate};

pub use problem::Problem;
pub use solve::{Options, alike, feasible, solve};
