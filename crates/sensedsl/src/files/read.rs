//! Reading of files: those that the user names, and those that a file names.
//!
//! All reading goes through [`read`]. It takes only regular files, and a pipe if the user names
//! one; a file may have no more bytes than its kind allows, and neither may all files together. A
//! file named by a *file* must also be in the project's folder, or in one that the command line
//! allows.

use std::collections::BTreeMap;
use std::fs;
use std::io::{self, Read as _};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use anyhow::{Context as _, Result};
use sensedsl_limits::TOTAL_BYTES_MAX;
use sensedsl_model::{FileRequest, FileUse, Files, ReadError, normal_path, stays_inside};

use super::open::open;
use crate::files::shown;

/// The machine's files, as far as one design or source may see them.
#[derive(Debug)]
pub(crate) struct Disk {
    /// The folder of the file on the command line.
    root: PathBuf,
    /// Further folders that files may name.
    allowed: Vec<PathBuf>,
    /// The files that were read, with their bytes.
    seen: Mutex<BTreeMap<PathBuf, usize>>,
}

impl Disk {
    /// The files that the file on the command line may name.
    pub(crate) fn of(file: &Path, allowed: &[PathBuf]) -> Self {
        let root = if file == Path::new("-") { None } else { file.parent() };
        Self::below(root.unwrap_or(Path::new("")), allowed)
    }

    /// The files that a file in that folder may name.
    pub(crate) fn below(root: &Path, allowed: &[PathBuf]) -> Self {
        let seen = Mutex::new(BTreeMap::new());
        Self { root: root.to_path_buf(), allowed: allowed.to_vec(), seen }
    }

    /// The contents of a file that a file names, with a path relative to the program's working
    /// folder.
    pub(crate) fn bytes(&self, path: &Path, what: FileUse) -> Result<Vec<u8>, ReadError> {
        let real = self.real(path)?;
        self.counted(&real, read(&real, what, false)?)
    }

    /// The path without symbolic links, if it is in an allowed folder.
    fn real(&self, path: &Path) -> Result<PathBuf, ReadError> {
        let relative = path.strip_prefix(&self.root).ok();
        let outside = || {
            let folder = normal_path(&path.parent().unwrap_or(Path::new("")).to_string_lossy());
            ReadError::Outside(if folder.is_empty() { ".".to_owned() } else { folder })
        };
        let stays = relative.is_some_and(|relative| stays_inside(&relative.to_string_lossy()))
            || self.comes_back(path);
        // If nothing else is allowed, not even the existence of the file is checked.
        if !stays && self.allowed.is_empty() {
            return Err(outside());
        }
        let real = fs::canonicalize(path).map_err(|error| why(&error))?;
        let mut folders = std::iter::once(&self.root).chain(&self.allowed);
        let within = folders.any(|folder| real.starts_with(real_folder(folder)));
        if within { Ok(real) } else { Err(outside()) }
    }

    /// Whether a path that leaves the folder comes back to it: `../robot/a.sense` in `robot`.
    fn comes_back(&self, path: &Path) -> bool {
        let whole = real_folder(Path::new("")).join(path);
        Path::new(&normal_path(&whole.to_string_lossy())).starts_with(real_folder(&self.root))
    }

    /// The bytes, unless all files together are too large. A file that is read again counts only
    /// once.
    fn counted(&self, path: &Path, bytes: Vec<u8>) -> Result<Vec<u8>, ReadError> {
        let mut seen = self.seen.lock().unwrap_or_else(PoisonError::into_inner);
        seen.insert(path.to_path_buf(), bytes.len());
        let all: usize = seen.values().sum();
        if all > TOTAL_BYTES_MAX { Err(ReadError::AllTooLarge) } else { Ok(bytes) }
    }
}

impl Files for Disk {
    fn read(&self, wanted: &FileRequest<'_>) -> Result<String, ReadError> {
        let path = Path::new(wanted.path);
        if wanted.by_user {
            return text(self.counted(path, read(path, wanted.what, true)?)?);
        }
        text(self.bytes(path, wanted.what)?)
    }
}

/// The contents of a file, or of the standard input for `-` if the user names it.
pub(crate) fn read(path: &Path, what: FileUse, by_user: bool) -> Result<Vec<u8>, ReadError> {
    if by_user && path == Path::new("-") {
        return limited(io::stdin().lock(), what);
    }
    let opened = open(path, by_user)?;
    let length = opened.file.metadata().map_err(|error| why(&error))?.len();
    if length > what.bytes_max() as u64 {
        return Err(ReadError::TooLarge);
    }
    limited(opened.reader(), what)
}

/// Reads to the end, or until there is more than allowed: a file can grow, and a pipe has no
/// length.
fn limited(source: impl io::Read, what: FileUse) -> Result<Vec<u8>, ReadError> {
    let mut bytes = Vec::new();
    let most = what.bytes_max();
    source.take(most as u64 + 1).read_to_end(&mut bytes).map_err(|error| why(&error))?;
    if bytes.len() > most { Err(ReadError::TooLarge) } else { Ok(bytes) }
}

/// A folder without symbolic links, so that it has a name; unchanged if it does not exist.
pub(crate) fn real_folder(folder: &Path) -> PathBuf {
    let here = if folder == Path::new("") { Path::new(".") } else { folder };
    fs::canonicalize(here).unwrap_or_else(|_| folder.to_path_buf())
}

/// The bytes as text.
pub(crate) fn text(bytes: Vec<u8>) -> Result<String, ReadError> {
    String::from_utf8(bytes).map_err(|error| {
        let at = error.utf8_error().valid_up_to();
        ReadError::Why(format!("it is not text in UTF-8 (byte {at})"))
    })
}

/// The reason that the system gives.
pub(crate) fn why(error: &io::Error) -> ReadError {
    if error.kind() == io::ErrorKind::NotFound {
        ReadError::Missing
    } else {
        ReadError::Why(error.to_string())
    }
}

/// The contents of a file; `None` if there is no such file.
pub(crate) fn read_if_there(path: &Path) -> Result<Option<Vec<u8>>> {
    let mut bytes = Vec::new();
    match open(path, false) {
        Ok(opened) => {
            let read = opened.reader().read_to_end(&mut bytes);
            read.with_context(|| format!("cannot read {}", shown(path)))?;
            Ok(Some(bytes))
        }
        Err(ReadError::Missing) => Ok(None),
        Err(unread) => anyhow::bail!("cannot read {}: {}", shown(path), unread.why()),
    }
}

/// All files below `root`, with paths relative to it, except those in folders that `skip` names.
pub(crate) fn files_below(root: &Path, skip: &dyn Fn(&str) -> bool) -> Result<Vec<PathBuf>> {
    let mut found = Vec::new();
    let mut folders = vec![root.to_path_buf()];
    while let Some(folder) = folders.pop() {
        let entries = match fs::read_dir(&folder) {
            Ok(entries) => entries,
            Err(error) if error.kind() == io::ErrorKind::NotFound && folder == root => break,
            Err(error) => {
                return Err(error).with_context(|| format!("cannot read {}", shown(&folder)));
            }
        };
        for entry in entries {
            let entry = entry.with_context(|| format!("cannot read {}", shown(&folder)))?;
            let path = entry.path();
            let name = entry.file_name().to_string_lossy().into_owned();
            let is_folder = entry.file_type().is_ok_and(|kind| kind.is_dir());
            if is_folder && !skip(&name) {
                folders.push(path);
            } else if !is_folder && let Ok(relative) = path.strip_prefix(root) {
                found.push(relative.to_path_buf());
            }
        }
    }
    found.sort();
    Ok(found)
}
