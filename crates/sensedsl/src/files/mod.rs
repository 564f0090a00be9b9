//! The machine's files: reading, writing, and the names under which people see them.

mod read;
mod write;

use std::path::Path;

pub(crate) use read::{Disk, files_below, read_bytes, read_if_there, read_text};
pub(crate) use write::{remove_with_empty_folders, write_whole};

/// The name under which people see a file.
pub(crate) fn shown(path: &Path) -> String {
    if path == Path::new("-") { "<stdin>".into() } else { path.display().to_string() }
}
