//! A folder that `generate` owns: what stands in it, what shall, and the way from one to the other.
//!
//! The list [`LIST`] names all generated files, so that what is no longer made can be removed and
//! what is foreign can be told.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use anyhow::Result;
use sensedsl_codegen::fileset::FileSet;

use crate::files::{files_below, read_if_there, remove_with_empty_folders, write_whole};

/// The list of generated files, in the folder itself.
const LIST: &str = ".sensedsl-files";
const LIST_HEAD: &str = "# Files that `sensedsl generate` made here and may replace or remove.\n";

/// Folders that belong to the user or to build tools.
const NOT_OURS: &[&str] = &["user", "build", ".dep", ".git", "target", "__pycache__", ".venv"];

/// What has to happen to a folder.
#[derive(Debug, Default, PartialEq, Eq)]
pub(crate) struct Changes {
    /// Files that are not there.
    pub(crate) missing: Vec<String>,
    /// Files with another content.
    pub(crate) different: Vec<String>,
    /// Generated files that are no longer made.
    pub(crate) stale: Vec<String>,
    /// Files that nobody generated.
    pub(crate) foreign: Vec<String>,
    /// Files that are as they shall be.
    pub(crate) same: usize,
}

impl Changes {
    pub(crate) fn is_up_to_date(&self) -> bool {
        self.missing.is_empty() && self.different.is_empty() && self.stale.is_empty()
    }
}

/// Compares the folder with what it shall hold.
pub(crate) fn compare(root: &Path, files: &FileSet) -> Result<Changes> {
    let mut changes = Changes::default();
    let listed = listed(root)?;
    for (path, entry) in files.iter() {
        match read_if_there(&root.join(path))? {
            None => changes.missing.push(path.to_owned()),
            // A user's file is as it shall be, whatever is in it.
            Some(_) if entry.once => changes.same += 1,
            Some(bytes) if bytes == entry.bytes => changes.same += 1,
            Some(_) => changes.different.push(path.to_owned()),
        }
    }
    let made: BTreeSet<&str> = files.iter().map(|(path, _)| path).collect();
    let on_disk = files_below(root, &|folder| NOT_OURS.contains(&folder))?;
    let on_disk: Vec<String> = on_disk.iter().map(|path| slashed(path)).collect();
    for path in on_disk {
        let known = made.contains(path.as_str()) && listed.contains(&path);
        if path == LIST || known {
            continue;
        }
        if listed.contains(&path) {
            changes.stale.push(path);
        } else {
            changes.foreign.push(path);
        }
    }
    Ok(changes)
}

/// Makes the folder hold the files. To be called only when [`Changes::foreign`] is empty.
pub(crate) fn write(root: &Path, files: &FileSet, changes: &Changes) -> Result<()> {
    let entries: BTreeMap<&str, _> = files.iter().collect();
    // The list goes first and names old and new files alike: a run that is cut off leaves nothing
    // behind that a later one takes for foreign.
    let mut all = listed(root)?;
    all.extend(generated(files));
    write_whole(&root.join(LIST), list(&all).as_bytes())?;
    for path in changes.missing.iter().chain(&changes.different) {
        if let Some(entry) = entries.get(path.as_str()) {
            write_whole(&root.join(path), &entry.bytes)?;
        }
    }
    for path in &changes.stale {
        remove_with_empty_folders(root, &root.join(path))?;
    }
    write_whole(&root.join(LIST), list(&generated(files)).as_bytes())
}

/// The paths of all files that are rewritten each time.
fn generated(files: &FileSet) -> BTreeSet<String> {
    files.iter().filter(|(_, entry)| !entry.once).map(|(path, _)| path.to_owned()).collect()
}

fn list(paths: &BTreeSet<String>) -> String {
    let lines: String = paths.iter().map(|path| format!("{path}\n")).collect();
    format!("{LIST_HEAD}{lines}")
}

/// The generated files according to the list; a line that leaves the folder is not believed.
fn listed(root: &Path) -> Result<BTreeSet<String>> {
    let Some(bytes) = read_if_there(&root.join(LIST))? else { return Ok(BTreeSet::new()) };
    let text = String::from_utf8_lossy(&bytes).into_owned();
    let inside = |line: &&str| {
        !line.is_empty()
            && !line.starts_with('#')
            && !line.starts_with('/')
            && line.split('/').all(|part| !matches!(part, "" | "." | ".."))
    };
    Ok(text.lines().filter(inside).map(str::to_owned).collect())
}

fn slashed(path: &Path) -> String {
    let parts: Vec<_> = path.iter().map(|part| part.to_string_lossy()).collect();
    parts.join("/")
}

/// The folder as people see it in a command to type.
pub(crate) fn typed(root: &Path, relative: &str) -> String {
    let path: PathBuf = root.join(relative);
    let text = path.display().to_string();
    if text.contains(|c: char| c.is_whitespace() || c == '\'' || c == '"') {
        format!("'{}'", text.replace('\'', "'\\''"))
    } else {
        text
    }
}
