//! A folder that `generate` owns: what stands in it, what is to stand in it, and the difference.

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
    /// Files of a list that this machine did not make which are not, or no longer, what it says.
    pub(crate) unproved: Vec<String>,
    /// Files to make whose folder is a link.
    pub(crate) linked: Vec<String>,
    /// Parts of files that earlier versions left behind when they were stopped.
    parts: Vec<String>,
    /// Number of files that need no change.
    pub(crate) same: usize,
}

impl Changes {
    pub(crate) fn is_up_to_date(&self) -> bool {
        let all = [&self.missing, &self.different, &self.stale, &self.linked];
        all.iter().all(|files| files.is_empty())
    }
}

/// What the list of a folder says, and whether this machine made it.
struct Listed {
    files: BTreeMap<String, Option<String>>,
    is_known: bool,
}

impl Listed {
    fn of(root: &Path) -> Result<Self> {
        let text = read_list(&root.join(LIST))
            .with_context(|| format!("cannot read {}", root.display()))?;
        let is_known = State::of_user().knows(root, &text);
        Ok(Self { files: entries(&text), is_known })
    }

    /// Whether a file was generated: by this machine, or it is what the list says.
    fn proves(&self, root: &Path, path: &str) -> bool {
        let Some(wanted) = self.files.get(path) else { return false };
        let is = |wanted: &String| matches!(found(root, path), Ok(Found::Bytes(bytes)) if digest(&bytes) == *wanted);
        self.is_known || wanted.as_ref().is_some_and(is)
    }
}

/// Compares the folder with what it is to hold.
pub(crate) fn compare(root: &Path, files: &FileSet) -> Result<Changes> {
    let mut changes = Changes::default();
    let listed = Listed::of(root)?;
    let mut same: BTreeSet<&str> = BTreeSet::new();
    for (path, entry) in files.iter() {
        let found = found(root, path)?;
        let is_linked = link_above(root, Path::new(path)).is_some();
        match found {
            // Whoever follows a link finds a file of the user's; to make one would be to follow it.
            Found::Nothing if is_linked => changes.linked.push(path.to_owned()),
            Found::Nothing => changes.missing.push(path.to_owned()),
            // What is in a user's file is the user's business.
            _ if entry.once => changes.same += 1,
            Found::Bytes(bytes) if bytes == entry.bytes => {
                changes.same += 1;
                same.insert(path);
            }
            Found::Bytes(_) | Found::Other if is_linked => changes.linked.push(path.to_owned()),
            Found::Bytes(_) | Found::Other => {
                changes.different.push(path.to_owned());
                // In a folder that nothing below looks into.
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

/// Says of each file that stands in the folder whose it is.
fn sort_out(
    root: &Path,
    listed: &Listed,
    made: &BTreeSet<&str>,
    same: &BTreeSet<&str>,
    changes: &mut Changes,
) -> Result<()> {
    let is_listed = |path: &str| listed.files.contains_key(path);
    for (path, kind) in walk(root).with_context(|| format!("cannot read {}", root.display()))? {
        // A user's folder may be a link to one that is elsewhere.
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

/// Makes the folder hold the files. To be called only when nothing of somebody else's is in the way.
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

/// What stands at a path.
enum Found {
    Nothing,
    Bytes(Vec<u8>),
    /// A link, or something that cannot be read without waiting for somebody.
    Other,
}

fn found(root: &Path, path: &str) -> Result<Found> {
    let path = root.join(path);
    // Not there either where a folder above it is a file.
    let Ok(found) = fs::symlink_metadata(&path) else { return Ok(Found::Nothing) };
    if found.is_dir() {
        bail!("{} is a folder, and has to be a file", path.display());
    }
    if !found.is_file() {
        return Ok(Found::Other);
    }
    Ok(read_if_there(&path)?.map_or(Found::Nothing, Found::Bytes))
}

/// The file whose part this is: earlier versions wrote `.NAME.part` first.
fn whole(path: &Path) -> Option<String> {
    let name = path.file_name()?.to_str()?.strip_prefix('.')?.strip_suffix(".part")?;
    Some(slashed(&path.with_file_name(name)))
}

/// The folder as people see it in a command to type.
pub(crate) fn typed(root: &Path, relative: &str) -> String {
    let path: PathBuf = if relative.is_empty() { root.to_owned() } else { root.join(relative) };
    let text = path.display().to_string();
    let is_plain =
        |c: char| c.is_alphanumeric() || matches!(c, '/' | '.' | '_' | '-' | '+' | ':' | '@' | ',');
    if !text.chars().all(is_plain) { format!("'{}'", text.replace('\'', "'\\''")) } else { text }
}
