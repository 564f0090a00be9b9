//! A wiring for people and scripts: tables, JSON, CSV, Markdown, a picture.
//!
//! # Example
//!
//! ```
//! use sensedsl_model::{NoFiles, Request, resolve};
//! use sensedsl_report::{csv, svg};
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
//! let table = csv::csv(&design, &wiring);
//! assert_eq!(table.lines().nth(1), Some("Rover,Light,1,analog,in,PB0,ADC12-IN8,ADC1,,1,"));
//! assert!(svg::svg(&design, &wiring).contains("PB0"));
//! ```

pub mod capacity;
pub mod columns;
mod contact;
pub mod csv;
pub mod diff;
pub mod drivers;
pub mod human;
pub mod json;
pub mod junit;
mod markup;
mod place;
mod rows;
pub mod run;
pub mod schema;
pub mod sheet;
pub mod svg;
pub mod timing;
pub mod trial_picture;
pub mod why;

pub use rows::{Row, rows};
