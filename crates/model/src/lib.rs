//! From syntax trees and boards to a checked design.
//!
//! [`resolve`] reads a file and everything that it uses, binds names, fills in defaults, converts
//! units and checks kinds. User text never makes it fail: mistakes come back as diagnostics. It
//! does no I/O of its own; files are read through [`Files`].
//!
//! # Example
//!
//! ```
//! use sensedsl_model::{NoFiles, Request, resolve};
//!
//! let text = "board Rover on STM32F4DiscoveryBoard {
//!     sensor Light returns uint16 { id = 1; type = analog; delay = 2 s; }
//! }";
//! let request = Request { path: "rover.sense", text, ..Request::default() };
//! let design = resolve(&request, &NoFiles).design.unwrap();
//! assert_eq!(design.boards[0].table.mcu.as_deref(), Some("STM32F407VGT6"));
//! assert_eq!(design.devices[0].delay_ms, 2_000);
//!
//! let mistaken = text.replace("analog", "analogue");
//! let resolved = resolve(&Request { text: &mistaken, ..request }, &NoFiles);
//! assert!(resolved.design.is_none());
//! assert_eq!(resolved.diagnostics[0].message, "`analogue` is not a kind of device");
//! ```

mod boards;
pub mod bounds;
mod checks;
mod chips;
mod coding;
mod constants;
pub mod design;
mod devices;
mod drivers;
pub mod facts;
mod fields;
mod files;
mod frames;
pub mod given;
mod ids;
pub mod kind;
mod library;
mod links;
mod names;
mod numbered;
mod other_types;
mod parts;
pub mod pins;
mod placement;
pub mod protocol;
pub mod reach;
pub mod registers;
mod resolve;
mod rules;
mod sound;
mod sources;
mod syntax_errors;
mod table_findings;
mod targets;
mod types;
mod value;

pub mod volts;
pub mod words;

pub use facts::all as part_facts;
pub use files::{FileRequest, FileUse, Files, NoFiles, ReadError, stays_inside};
pub use library::LIBRARY;
pub use numbered::with_ids;
pub use resolve::{Request, Resolved, resolve, sort};
pub use rules::{apply_allows, drop_allowed};
pub use sensedsl_syntax::Parse as SyntaxTree;
pub use sound::Partial;
pub use sources::normal as normal_path;
pub use syntax_errors::diagnostic as syntax_diagnostic;
pub use table_findings::diagnostic as table_diagnostic;
