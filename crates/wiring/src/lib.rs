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
mod answers;
pub mod assignment;
mod blame;
mod builder;
mod capacity;
mod certificate;
mod checks;
mod conflict;
mod converters;
mod explain;
mod formulate;
mod keep;
mod labels;
mod layout;
mod levels;
mod names;
mod neat;
mod offer;
mod read_back;
mod repairs;
mod requested;
mod rule;
mod streams;
mod ties;
mod why;
mod wiring;
mod wishes;

pub use answers::{Found, Posed, Proved, Search, Solved};
pub use capacity::{Capacity, capacity};
pub use conflict::{Contested, NoWiring};
pub use keep::Keep;
pub use offer::kept_back;
pub use repairs::{Repair, Repaired};
pub use rule::Rule;
pub use sensedsl_solve as solver;
pub use sensedsl_solve::Cancel;
pub use why::Alternative;
pub use wiring::Wiring;
