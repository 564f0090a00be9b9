//! What is generated before it is written: paths and bytes, and how a template becomes one of them. No disk.

mod fileset;
mod template;

pub use fileset::{FileEntry, FileSet};
pub use template::{block, print};
