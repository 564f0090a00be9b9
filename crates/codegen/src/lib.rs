//! From a wired design to files: plans decide, templates print.

pub mod fileset;
pub mod firmware;
pub mod host;
pub mod job;
pub mod kinds;
pub mod part;
mod print;
mod project;
pub mod target;

pub use project::{Project, Selection, project};
