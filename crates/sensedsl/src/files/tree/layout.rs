//! The owners of the entries in an output folder, and the names of temporary entries.
//!
//! The list [`LIST`] names all generated files with digests of their contents, so that files which are no longer needed
//! can be removed, and foreign files recognised. The list may be a stranger's, so an entry counts only if this machine
//! knows the list, or if the file still matches it.

use std::collections::{BTreeMap, BTreeSet};
use std::ffi::{OsStr, OsString};
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// The list of generated files, in the folder itself.
pub(crate) const LIST: &str = ".sensedsl-files";
const LIST_HEAD: &str = "# Files that `sensedsl generate` made here and may replace or remove.\n";

/// The folders that belong to the user or to build tools.
const NOT_OURS: &[&str] = &["user", "build", ".dep", ".git", "target", "__pycache__", ".venv"];

/// The working folder of a run, in the output folder itself.
pub(crate) const WORK: &str = ".sensedsl-work";

/// The most bytes of a list that are read.
const LIST_BYTES_MAX: u64 = 16 << 20;

/// The number of digits in a file's SHA-256.
const DIGEST_DIGITS: usize = 64;

/// Whether a folder of that name belongs to the user or to build tools.
pub(crate) fn is_not_ours(name: &OsStr) -> bool {
    name.to_str().is_some_and(|name| NOT_OURS.contains(&name))
}

/// The outermost link on a path below a folder; its last component is not checked.
pub(crate) fn link_above(root: &Path, path: &Path) -> Option<PathBuf> {
    let is_link = |folder: &&Path| {
        fs::symlink_metadata(root.join(folder)).is_ok_and(|found| found.is_symlink())
    };
    let above = path.ancestors().skip(1).filter(|folder| *folder != Path::new(""));
    above.filter(is_link).last().map(Path::to_path_buf)
}

/// The folder of the user's, or of a build tool, that a path leads through.
pub(crate) fn not_ours_above(path: &Path) -> Option<&Path> {
    let name = |one: &&Path| one.file_name().is_some_and(is_not_ours);
    // The outermost one hides those within it.
    path.ancestors().skip(1).filter(name).last()
}

/// The list of these generated files, with the SHA-256 of those that have one.
pub(crate) fn list(files: &BTreeMap<String, Option<String>>) -> String {
    let mut text = LIST_HEAD.to_owned();
    for (path, digest) in files {
        let digest = digest.iter().flat_map(|digest| [digest, "  "]);
        text.extend(digest.chain([path.as_str(), "\n"]));
    }
    text
}

/// The generated files according to a list; empty if there is no list.
pub(crate) fn listed(list: &Path) -> io::Result<BTreeSet<String>> {
    Ok(entries(&read_list(list)?).into_keys().collect())
}

/// The text of a list. It is only read if it is a file.
pub(crate) fn read_list(list: &Path) -> io::Result<Vec<u8>> {
    match fs::metadata(list) {
        Ok(found) if found.is_file() && found.len() <= LIST_BYTES_MAX => fs::read(list),
        Ok(_) => Ok(Vec::new()),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(Vec::new()),
        // A link that leads to itself is not a list.
        Err(_) if fs::symlink_metadata(list).is_ok_and(|found| found.is_symlink()) => {
            Ok(Vec::new())
        }
        Err(error) => Err(error),
    }
}

/// The files that a list names, with the SHA-256 that it gives. A line is ignored if it leaves the folder or names
/// something that is not ours.
pub(crate) fn entries(list: &[u8]) -> BTreeMap<String, Option<String>> {
    let text = String::from_utf8_lossy(list);
    let ours = |(path, _): &(&str, Option<&str>)| {
        !path.is_empty()
            && !path.starts_with('/')
            && path.split('/').all(|part| !matches!(part, "" | "." | ".."))
            && !Path::new(path).file_name().is_some_and(is_not_ours)
    };
    let line = |line| match split_digest(line) {
        Some((digest, path)) => (path, Some(digest)),
        None => (line, None),
    };
    let lines = text.lines().filter(|line| !line.starts_with('#')).map(line).filter(ours);
    lines.map(|(path, digest)| (path.to_owned(), digest.map(str::to_owned))).collect()
}

fn split_digest(line: &str) -> Option<(&str, &str)> {
    let (digest, path) = line.split_once("  ")?;
    let is_digest = digest.len() == DIGEST_DIGITS && digest.bytes().all(|c| c.is_ascii_hexdigit());
    is_digest.then_some((digest, path))
}

/// The bytes of a file; empty if there is no file.
pub(crate) fn read_file(path: &Path) -> io::Result<Vec<u8>> {
    match fs::metadata(path) {
        Ok(found) if found.is_file() => fs::read(path),
        Ok(_) => Ok(Vec::new()),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(Vec::new()),
        Err(error) => Err(error),
    }
}

/// A path as the list has it.
pub(crate) fn slashed(path: &Path) -> String {
    let parts: Vec<_> = path.iter().map(|part| part.to_string_lossy()).collect();
    parts.join("/")
}

/// The temporary entries beside the output folder while it is written.
#[derive(Clone, Debug)]
pub(crate) struct Siblings {
    /// The lock, the list of the new tree, and the staged files.
    pub(crate) work: PathBuf,
    /// The other one of the two trees.
    pub(crate) tree: PathBuf,
}

impl Siblings {
    /// The entries beside a folder; `None` if there can be none.
    pub(crate) fn of(root: &Path) -> Option<Self> {
        let name = root.file_name()?;
        let named = |ending: &str| {
            let mut beside = OsString::from(".");
            beside.push(name);
            beside.push(ending);
            root.with_file_name(beside)
        };
        Some(Self { work: named(".sensedsl-work"), tree: named(".sensedsl-unfinished") })
    }
}

/// The kind of an entry in a folder; links are not followed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Kind {
    /// A folder.
    Folder,
    /// A symbolic link, whatever it leads to.
    Link,
    /// A file or a device.
    File,
}

/// Everything below a folder, with paths relative to it, a folder before its contents; empty if there is no such
/// folder. The contents of folders that are not ours are left out.
pub(crate) fn walk(root: &Path) -> io::Result<Vec<(PathBuf, Kind)>> {
    walk_into(root, &|name| !is_not_ours(name) && name != WORK)
}

/// Everything below a folder as in [`walk`], including the contents of the folders that `enter` accepts.
pub(crate) fn walk_into(
    root: &Path,
    enter: &dyn Fn(&OsStr) -> bool,
) -> io::Result<Vec<(PathBuf, Kind)>> {
    let mut found = Vec::new();
    let mut folders = vec![PathBuf::new()];
    while let Some(folder) = folders.pop() {
        let entries = match fs::read_dir(root.join(&folder)) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => continue,
            entries => entries?,
        };
        for entry in entries {
            let entry = entry?;
            let path = folder.join(entry.file_name());
            let kind = match entry.file_type()? {
                kind if kind.is_symlink() => Kind::Link,
                kind if kind.is_dir() => Kind::Folder,
                _ => Kind::File,
            };
            if kind == Kind::Folder && enter(&entry.file_name()) {
                folders.push(path.clone());
            }
            found.push((path, kind));
        }
    }
    found.sort();
    Ok(found)
}

/// Whether anything has that name, even a dangling link.
pub(crate) fn is_there(path: &Path) -> bool {
    fs::symlink_metadata(path).is_ok()
}
