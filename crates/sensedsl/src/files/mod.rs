//! The machine's files: reading, writing, and the names under which people see them.
//!
//! `read` reads. `write` writes single files, `tree` whole folders, both so that a run that is
//! stopped at any moment leaves nothing half done; `ops` are the changes that a tree is written
//! with, `lock` keeps two runs apart.

#[cfg(test)]
mod fault;
pub(crate) mod lock;
mod ops;
mod read;
pub(crate) mod tree;
mod write;

use std::path::Path;

pub(crate) use read::{Disk, files_below, read_bytes, read_if_there, read_text};
pub(crate) use write::{
    begins_with, is_in_the_way, is_stream, remove_file, write_together, write_whole,
};

/// The name under which people see a file.
pub(crate) fn shown(path: &Path) -> String {
    if path == Path::new("-") { "<stdin>".into() } else { path.display().to_string() }
}
