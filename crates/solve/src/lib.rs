//! Exact pin assignment: integers in, a checked answer out.
//!
//! Four pure functions over a [`Problem`]: [`solve`] gives the one best answer or the reason why
//! there is none, [`enumerate`] gives all answers, best first, [`count`] gives their number, and
//! [`check`] judges an answer without any code of the search. No answer leaves the crate unchecked.
//!
//! # Example
//!
//! ```
//! use sensedsl_solve::problem::{Board, BoardId, Pin, Problem};
//! # use sensedsl_solve::problem::{Alternative, Candidate, Device, PinId, Role, SignalId};
//! use sensedsl_solve::{Options, Outcome, check, solve};
//!
//! # let device = |pins: [u32; 2]| {
//! #     let candidate = |pin| Candidate::new(PinId(pin), SignalId(pin));
//! #     let roles = vec![Role { candidates: pins.map(candidate).to_vec() }];
//! #     let board = BoardId(0);
//! #     let way = Alternative { board, claims: vec![], violates: vec![], dma: vec![], roles };
//! #     Device { alternatives: vec![way] }
//! # };
//! let problem = Problem {
//!     boards: vec![Board { spare: false }],
//!     pins: [1, 2, 5].map(|cost| Pin { board: BoardId(0), cost, shared: false }).to_vec(),
//!     // Each device takes one of two pins.
//!     devices: vec![device([0, 1]), device([0, 2])],
//!     ..Problem::default()
//! };
//! let outcome = solve(&problem, &Options::default()).unwrap();
//! let Outcome::Solved(best) = outcome else { panic!("there is an answer") };
//! // The first device leaves the cheapest pin to the second.
//! assert_eq!(best.choices[0].candidates, [1]);
//! assert_eq!(best.objective.cost, 3);
//! assert_eq!(check(&problem, &best), Ok(()));
//! ```

pub mod answer;
mod bounds;
mod cancel;
mod check;
mod domains;
mod index;
#[cfg(feature = "inside")]
#[doc(hidden)]
pub mod inside;
mod matching;
mod model;
pub mod neat;
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
