//! A folder that `generate` owns: its present contents, its new contents, and the difference.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, Result, bail};
use sensedsl_files::FileSet;

use crate::files::state::{State, digest};
use crate::files::tree::layout::{
    Kind, LIST, entries, is_not_ours, link_above, list, read_list, slashed, walk,
};
use crate::files::tree::{Failure, NewFile, NewTree, Output};
use crate::files::{read_if_there, remove_file, shown};

/// The changes that a folder needs.
#[derive(Debug, Default, PartialEq, Eq)]
pub(crate) struct Changes {
    /// Files that do not exist.
    pub(crate) missing: Vec<String>,
    /// Files with different contents.
    pub(crate) different: Vec<String>,
    /// Generated files that are no longer needed.
    pub(crate) stale: Vec<String>,
    /// Files that were not generated.
    pub(crate) foreign: Vec<String>,
    /// Listed files whose contents do not match a list that this machine did not write.
    pub(crate) unproved: Vec<String>,
    /// Files to write in a folder that is a link.
    pub(crate) linked: Vec<String>,
    /// Parts of files that earlier versions left behind when they were killed.
    parts: Vec<String>,
    /// The number of files that need no change.
    pub(crate) same: usize,
}

impl Changes {
    pub(crate) fn is_up_to_date(&self) -> bool {
        let all = [&self.missing, &self.different, &self.stale, &self.linked];
        all.iter().all(|files| files.is_empty())
    }
}

/// The contents of a folder's list, and whether this machine wrote it.
struct Listed {
    files: BTreeMap<String, Option<String>>,
    is_known: bool,
}

impl Listed {
    fn of(root: &Path) -> Result<Self> {
        let text =
            read_list(&root.join(LIST)).with_context(|| format!("cannot read {}", shown(root)))?;
        let is_known = State::of_user().knows(root, &text);
        Ok(Self { files: entries(&text), is_known })
    }

    /// Whether it is proved that a file was generated: this machine wrote the list, or the file still matches it.
    fn proves(&self, root: &Path, path: &str) -> bool {
        let Some(wanted) = self.files.get(path) else { return false };
        let is = |wanted: &String| matches!(found(root, path), Ok(Found::Bytes(bytes)) if digest(&bytes) == *wanted);
        self.is_known || wanted.as_ref().is_some_and(is)
    }
}

/// Compares the folder with its new contents.
pub(crate) fn compare(root: &Path, files: &FileSet) -> Result<Changes> {
    let mut changes = Changes::default();
    let listed = Listed::of(root)?;
    let mut same: BTreeSet<&str> = BTreeSet::new();
    for (path, entry) in files.iter() {
        let found = found(root, path)?;
        let is_linked = link_above(root, Path::new(path)).is_some();
        match found {
            // Following a link would reach a user's file; to create a file there would be to follow the link.
            Found::Nothing if is_linked => changes.linked.push(path.to_owned()),
            Found::Nothing => changes.missing.push(path.to_owned()),
            // The contents of a user's file are the user's business.
            _ if entry.once => changes.same += 1,
            Found::Bytes(bytes) if bytes == entry.bytes => {
                changes.same += 1;
                same.insert(path);
            }
            Found::Bytes(_) | Found::Other if is_linked => changes.linked.push(path.to_owned()),
            Found::Bytes(_) | Found::Other => {
                changes.different.push(path.to_owned());
                // The file may be in a folder that is not searched below.
                let is_hidden = Path::new(path).ancestors().skip(1).any(is_named_as_theirs);
                if is_hidden && !listed.proves(root, path) {
                    changes.unproved.push(path.to_owned());
                }
            }
        }
    }
    let made: BTreeSet<&str> = files.iter().map(|(path, _)| path).collect();
    sort_out(root, &listed, &made, &same, &mut changes)?;
    Ok(changes)
}

/// Sorts the files in the folder by their owner.
fn sort_out(
    root: &Path,
    listed: &Listed,
    made: &BTreeSet<&str>,
    same: &BTreeSet<&str>,
    changes: &mut Changes,
) -> Result<()> {
    let is_listed = |path: &str| listed.files.contains_key(path);
    for (path, kind) in walk(root).with_context(|| format!("cannot read {}", shown(root)))? {
        // A user's folder may be a link to one elsewhere.
        let theirs = kind == Kind::Link && is_named_as_theirs(&path);
        if kind == Kind::Folder && path == Path::new(LIST) {
            changes.foreign.push(LIST.to_owned());
        }
        if kind == Kind::Folder || theirs || path == Path::new(LIST) {
            continue;
        }
        let whole = whole(&path);
        let path = slashed(&path);
        let is_made = made.contains(path.as_str());
        if same.contains(path.as_str()) {
            continue;
        }
        if is_listed(&path) {
            if !listed.proves(root, &path) {
                changes.unproved.push(path.clone());
            }
            if !is_made {
                changes.stale.push(path);
            }
        } else if whole.is_some_and(|whole| {
            listed.is_known && (whole == LIST || is_listed(&whole) || made.contains(whole.as_str()))
        }) {
            changes.parts.push(path);
        } else {
            changes.foreign.push(path);
        }
    }
    Ok(())
}

fn is_named_as_theirs(path: &Path) -> bool {
    path.file_name().is_some_and(is_not_ours)
}

/// Writes the files to the folder. Must be called only if no files of others are in the way.
pub(crate) fn write(
    output: &mut Output,
    files: &FileSet,
    changes: &Changes,
) -> Result<(), Failure> {
    for part in &changes.parts {
        remove_file(&output.root().join(part)).map_err(Failure::Before)?;
    }
    let generated = files.iter().filter(|(_, entry)| !entry.once);
    let generated =
        generated.map(|(path, entry)| (path.to_owned(), Some(digest(&entry.bytes)))).collect();
    let list = list(&generated);
    let before = read_list(&output.root().join(LIST)).map_err(Failure::Before)?;
    if !changes.is_up_to_date() || before != list.as_bytes() {
        let changing: BTreeSet<&str> =
            changes.missing.iter().chain(&changes.different).map(String::as_str).collect();
        let files = files.iter().map(|(path, entry)| NewFile {
            path,
            bytes: &entry.bytes,
            once: entry.once,
            changes: changing.contains(path),
        });
        let stale = changes.stale.clone();
        output.write(&NewTree { files: files.collect(), list: list.clone(), stale })?;
    }
    State::of_user().remember(output.root(), list.as_bytes());
    Ok(())
}

/// The entry at a path.
enum Found {
    Nothing,
    Bytes(Vec<u8>),
    /// A link, or something that cannot be read without waiting.
    Other,
}

fn found(root: &Path, path: &str) -> Result<Found> {
    let path = root.join(path);
    // It does not exist either if one of the folders above it is a file.
    let Ok(found) = fs::symlink_metadata(&path) else { return Ok(Found::Nothing) };
    if found.is_dir() {
        bail!("{} is a folder, and has to be a file", shown(&path));
    }
    if !found.is_file() {
        return Ok(Found::Other);
    }
    Ok(read_if_there(&path)?.map_or(Found::Nothing, Found::Bytes))
}

/// The file that this is a part of: earlier versions first wrote `.NAME.part`.
fn whole(path: &Path) -> Option<String> {
    let name = path.file_name()?.to_str()?.strip_prefix('.')?.strip_suffix(".part")?;
    Some(slashed(&path.with_file_name(name)))
}

/// The path as people would type it in a command.
pub(crate) fn typed(root: &Path, relative: &str) -> String {
    let path: PathBuf = if relative.is_empty() { root.to_owned() } else { root.join(relative) };
    let text = shown(&path);
    let is_plain =
        |c: char| c.is_alphanumeric() || matches!(c, '/' | '.' | '_' | '-' | '+' | ':' | '@' | ',');
    if !text.chars().all(is_plain) { format!("'{}'", text.replace('\'', "'\\''")) } else { text }
}
