//! Diagnostics as plain data: what is wrong, where, and the way out.
//!
//! A [`Diagnostic`] is made by the builder of its code (one file each in [`codes`]), passes unchanged through all
//! stages, and is rendered at the end: for people, as JSON, SARIF or GitHub annotations (see [`render`]).
//!
//! # Example
//!
//! ```
//! use sensedsl_diagnostics::codes::e0201_unknown_property::unknown_property;
//! use sensedsl_diagnostics::{SourceMap, Span, nearest, render};
//!
//! let text = "sensor Light returns uint16 { tpye = analog; }";
//! let mut sources = SourceMap::default();
//! let file = sources.add("rover.sense", text);
//! let at = text.find("tpye").unwrap();
//! let known = nearest("tpye", ["delay", "id", "type"]);
//! let mistake = unknown_property(Span::new(file, at..at + 4), "tpye", "an analog device", known);
//! assert_eq!(mistake.help.as_deref(), Some("write `type`"));
//!
//! let shown = render::human(&[mistake], &sources, false);
//! assert!(shown.starts_with("error[E0201]: an analog device has no property `tpye`"));
//! assert!(shown.contains("rover.sense:1:31"));
//! ```

pub mod codes;
mod diagnostic;
pub mod render;
mod source;
mod suggest;
mod visible;

pub use codes::{Code, CodeInfo};
pub use diagnostic::{Diagnostic, Edit, Fix, Label, Scope, Severity};
pub use source::{FileId, LineColumn, SourceMap, Span};
pub use suggest::{distance, nearest, spelled};
pub use visible::{is_hidden, visible, visible_json, visible_lines};
