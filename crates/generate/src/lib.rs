//! From a wired design to all files of a project: the available systems and hosts, and what they lack.
//!
//! # Example
//!
//! ```
//! use sensedsl_generate::{Selection, project};
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
//! let made = project("rover", &design, &wiring, &Selection::ALL);
//! assert!(made.gaps.is_empty());
//! for path in ["wiring.md", "firmware/Rover/Makefile", "host/cpp/include/sense/rover/Rover.hpp"] {
//!     assert!(made.files.get(path).is_some(), "{path}");
//! }
//! ```

pub mod host;
pub mod listing;
mod project;
pub mod target;

pub use project::{Project, Selection, project};
