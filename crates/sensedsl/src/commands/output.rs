//! A folder that `generate` owns: what stands in it, what is to stand in it, and the difference.

use std::collections::BTreeSet;
use std::io;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, Result};
use sensedsl_codegen::fileset::FileSet;

use crate::files::tree::layout::{Kind, LIST, is_not_ours, list, listed, read_file, slashed, walk};
use crate::files::tree::{Failure, NewFile, NewTree, Output};
use crate::files::{read_if_there, remove_file};

/// What has to happen to a folder.
#[derive(Debug, Default, PartialEq, Eq)]
pub(crate) struct Changes {
    /// Files that are not there.
    pub(crate) missing: Vec<String>,
    /// Files with another content.
    pub(crate) different: Vec<String>,
    /// Generated files that are no longer made.
    pub(crate) stale: Vec<String>,
    /// Files that were not generated.
    pub(crate) foreign: Vec<String>,
    /// Parts of files that earlier versions left behind when they were stopped.
    parts: Vec<String>,
    /// Number of files that need no change.
    pub(crate) same: usize,
}

impl Changes {
    pub(crate) fn is_up_to_date(&self) -> bool {
        self.missing.is_empty() && self.different.is_empty() && self.stale.is_empty()
    }
}

/// Compares the folder with what it is to hold.
pub(crate) fn compare(root: &Path, files: &FileSet) -> Result<Changes> {
    let mut changes = Changes::default();
    let reading = || format!("cannot read {}", root.display());
    let listed = listed(&root.join(LIST)).with_context(reading)?;
    for (path, entry) in files.iter() {
        match found(&root.join(path))? {
            Found::Nothing => changes.missing.push(path.to_owned()),
            // What is in a user's file is the user's business.
            _ if entry.once => changes.same += 1,
            Found::Bytes(bytes) if bytes == entry.bytes => changes.same += 1,
            Found::Bytes(_) | Found::Device => changes.different.push(path.to_owned()),
        }
    }
    let made: BTreeSet<&str> = files.iter().map(|(path, _)| path).collect();
    for (path, kind) in walk(root).with_context(reading)? {
        // A user's folder may be a link to one that is elsewhere.
        let theirs = kind == Kind::Link && path.file_name().is_some_and(is_not_ours);
        if kind == Kind::Folder || theirs {
            continue;
        }
        let whole = whole(&path);
        let path = slashed(&path);
        let known = made.contains(path.as_str()) && listed.contains(&path);
        if path == LIST || known {
            continue;
        }
        if listed.contains(&path) {
            changes.stale.push(path);
        } else if whole.is_some_and(|whole| {
            whole == LIST || listed.contains(&whole) || made.contains(whole.as_str())
        }) {
            changes.parts.push(path);
        } else {
            changes.foreign.push(path);
        }
    }
    Ok(changes)
}

/// Makes the folder hold the files. To be called only when [`Changes::foreign`] is empty.
pub(crate) fn write(
    output: &mut Output,
    files: &FileSet,
    changes: &Changes,
) -> Result<(), Failure> {
    for part in &changes.parts {
        remove_file(&output.root().join(part)).map_err(Failure::Before)?;
    }
    let generated: BTreeSet<String> =
        files.iter().filter(|(_, entry)| !entry.once).map(|(path, _)| path.to_owned()).collect();
    let list = list(&generated);
    let before = read_file(&output.root().join(LIST)).map_err(Failure::Before)?;
    if changes.is_up_to_date() && before == list.as_bytes() {
        return Ok(());
    }
    let changing: BTreeSet<&str> =
        changes.missing.iter().chain(&changes.different).map(String::as_str).collect();
    let files = files.iter().map(|(path, entry)| NewFile {
        path,
        bytes: &entry.bytes,
        once: entry.once,
        changes: changing.contains(path),
    });
    output.write(&NewTree { files: files.collect(), list })
}

/// What stands at a path.
enum Found {
    Nothing,
    Bytes(Vec<u8>),
    /// Something that cannot be read without waiting for somebody.
    Device,
}

fn found(path: &Path) -> Result<Found> {
    match std::fs::metadata(path) {
        Ok(found) if !found.is_file() && !found.is_dir() => Ok(Found::Device),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(Found::Nothing),
        Ok(_) | Err(_) => Ok(read_if_there(path)?.map_or(Found::Nothing, Found::Bytes)),
    }
}

/// The file whose part this is: earlier versions wrote `.NAME.part` first.
fn whole(path: &Path) -> Option<String> {
    let name = path.file_name()?.to_str()?.strip_prefix('.')?.strip_suffix(".part")?;
    Some(slashed(&path.with_file_name(name)))
}

/// The folder as people see it in a command to type.
pub(crate) fn typed(root: &Path, relative: &str) -> String {
    let path: PathBuf = root.join(relative);
    let text = path.display().to_string();
    let is_plain =
        |c: char| c.is_alphanumeric() || matches!(c, '/' | '.' | '_' | '-' | '+' | ':' | '@' | ',');
    if !text.chars().all(is_plain) { format!("'{}'", text.replace('\'', "'\\''")) } else { text }
}
