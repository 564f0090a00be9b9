//! Generated files before they are written: paths and contents, and the printing of templates. No disk access.

mod fileset;
mod template;

pub use fileset::{FileEntry, FileSet};
pub use template::{block, print};
