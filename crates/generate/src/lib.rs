//! From a wired design to all files of a project: the available systems and hosts, and what they lack.

pub mod host;
mod project;
pub mod target;

pub use project::{Project, Selection, project};
