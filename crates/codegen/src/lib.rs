//! From a wired design to files: plans decide, templates print.

pub mod fileset;
pub mod firmware;
pub mod host;
mod print;
mod project;

pub use project::project;
