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

mod board;
mod control;
pub mod design;
mod driver;
mod fields;
pub mod kind;
pub mod meaning;
mod part;
mod request;
mod resolve;
mod rule;
mod sound;
mod source;
mod spanned;
mod test;
mod value;

pub use board::table_findings::diagnostic as table_diagnostic;
pub use design::protocol;
pub use driver::facts;
pub use driver::facts::all as part_facts;
pub use driver::library::LIBRARY;
pub use part::{given, reach, registers, words};
pub use request::Request;
pub use resolve::{Resolved, resolve, sort};
pub use rule::{apply_allows, drop_allowed};
pub use sensedsl_syntax::Parse as SyntaxTree;
pub use sound::Partial;
pub use source::files::{FileRequest, FileUse, Files, NoFiles, ReadError, stays_inside};
pub use source::fixes::settle_fixes;
pub use source::numbered::{blocks_without_ids, with_ids};
pub use source::reader::normal as normal_path;
pub use source::syntax_errors::diagnostic as syntax_diagnostic;
pub use test::{Expression, Like, expression, unit_of_device};
pub use value::constants::Constants;
pub use value::written;
