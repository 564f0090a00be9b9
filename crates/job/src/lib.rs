//! A board's work and the other end of its link, independent of any system or language.
//!
//! In: a design and its wiring. Out: a [`BoardJob`] for each board, and one [`host::HostPlan`] for all of them. A
//! system that firmware is generated for implements [`Target`], a host application implements [`host::Host`], each in
//! its own crate.
//!
//! # Example
//!
//! ```
//! use sensedsl_job::jobs;
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
//! let rover = jobs(&design, &wiring).next().unwrap();
//! let light = &rover.connections[0];
//! assert_eq!((light.ident.as_str(), light.unit), ("light", Some("ADC1")));
//! assert_eq!(light.place(), "Light at PB0 (ADC12-IN8)");
//! assert_eq!(rover.schema.items[0].name, "Light");
//! ```

mod control;
pub mod host;
mod job;
pub mod kinds;
mod names;
pub mod part;
mod target;

pub use control::{JobController, Owner};
pub use job::*;
pub use names::snake;
pub use target::Target;
