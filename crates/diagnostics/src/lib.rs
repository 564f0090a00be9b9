//! Diagnostics as plain data: what is wrong, where, and the way out.
//!
//! A [`Diagnostic`] is made by the builder of its code (one file each in [`codes`]), passes unchanged through all
//! stages, and is rendered at the end: for people, as JSON, SARIF or GitHub annotations (see [`render`]).

pub mod codes;
mod diagnostic;
pub mod render;
mod source;
mod suggest;
mod visible;

pub use codes::{Code, CodeInfo};
pub use diagnostic::{Diagnostic, Edit, Fix, Label, Severity};
pub use source::{FileId, LineColumn, SourceMap, Span};
pub use suggest::{distance, nearest};
pub use visible::{is_hidden, visible, visible_json, visible_lines};
