//! Writing files: a file is written whole or not at all.
#![expect(clippy::disallowed_methods, reason = "the binary is where files are read and written")]

use std::fs;
use std::io;
use std::path::Path;

use anyhow::{Context as _, Result};

/// Writes a file as a whole or not at all: beside it first, then in its place.
pub(crate) fn write_whole(path: &Path, bytes: &[u8]) -> Result<()> {
    let folder = path.parent().filter(|parent| !parent.as_os_str().is_empty());
    if let Some(folder) = folder {
        fs::create_dir_all(folder).with_context(|| format!("cannot make {}", folder.display()))?;
    }
    let name = path.file_name().context("a file needs a name")?.to_string_lossy();
    let beside = path.with_file_name(format!(".{name}.part"));
    let written = fs::write(&beside, bytes).and_then(|()| fs::rename(&beside, path));
    if written.is_err() {
        // What could not be put in its place shall not stay around; if that fails too, the first
        // error says why.
        let _ = fs::remove_file(&beside);
    }
    written.with_context(|| format!("cannot write {}", path.display()))
}

/// Removes a file and the folders that are empty without it, up to `root`.
pub(crate) fn remove_with_empty_folders(root: &Path, path: &Path) -> Result<()> {
    match fs::remove_file(path) {
        Ok(()) => {}
        Err(error) if error.kind() == io::ErrorKind::NotFound => {}
        Err(error) => {
            return Err(error).with_context(|| format!("cannot remove {}", path.display()));
        }
    }
    let mut folder = path.parent();
    while let Some(current) = folder.filter(|folder| *folder != root) {
        if fs::remove_dir(current).is_err() {
            // Not empty: something else lives there.
            break;
        }
        folder = current.parent();
    }
    Ok(())
}
