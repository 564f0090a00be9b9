//! What belongs to whom in an output folder, and the names of what stands there for a while.
//!
//! The list [`LIST`] names all generated files, so that what is no longer made can be removed and
//! what is foreign can be told.

use std::collections::BTreeSet;
use std::ffi::{OsStr, OsString};
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// The list of generated files, in the folder itself.
pub(crate) const LIST: &str = ".sensedsl-files";
const LIST_HEAD: &str = "# Files that `sensedsl generate` made here and may replace or remove.\n";

/// Folders that belong to the user or to build tools.
const NOT_OURS: &[&str] = &["user", "build", ".dep", ".git", "target", "__pycache__", ".venv"];

/// What one run needs while it writes, in the folder itself.
pub(crate) const WORK: &str = ".sensedsl-work";

/// Whether a folder of that name belongs to the user or to build tools.
pub(crate) fn is_not_ours(name: &OsStr) -> bool {
    name.to_str().is_some_and(|name| NOT_OURS.contains(&name))
}

/// The folder of the user's, or of a build tool's, that a path leads through.
pub(crate) fn not_ours_above(path: &Path) -> Option<&Path> {
    let name = |one: &&Path| one.file_name().is_some_and(is_not_ours);
    // The outermost one, which hides those within.
    path.ancestors().skip(1).filter(name).last()
}

/// The list of those generated files.
pub(crate) fn list(paths: &BTreeSet<String>) -> String {
    let lines: String = paths.iter().map(|path| format!("{path}\n")).collect();
    format!("{LIST_HEAD}{lines}")
}

/// The generated files according to a list, none where there is no list; a line that leaves the
/// folder is not believed.
pub(crate) fn listed(list: &Path) -> io::Result<BTreeSet<String>> {
    let bytes = match fs::symlink_metadata(list) {
        // Whatever else stands there, only a file is read.
        Ok(found) if found.is_file() || found.is_symlink() => read_file(list)?,
        Ok(_) => Vec::new(),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Vec::new(),
        Err(error) => return Err(error),
    };
    let text = String::from_utf8_lossy(&bytes).into_owned();
    let inside = |line: &&str| {
        !line.is_empty()
            && !line.starts_with('#')
            && !line.starts_with('/')
            && line.split('/').all(|part| !matches!(part, "" | "." | ".."))
    };
    Ok(text.lines().filter(inside).map(str::to_owned).collect())
}

/// The bytes of a file; none where there is no file.
pub(crate) fn read_file(path: &Path) -> io::Result<Vec<u8>> {
    match fs::metadata(path) {
        Ok(found) if found.is_file() => fs::read(path),
        Ok(_) => Ok(Vec::new()),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(Vec::new()),
        Err(error) => Err(error),
    }
}

/// A path of the list.
pub(crate) fn slashed(path: &Path) -> String {
    let parts: Vec<_> = path.iter().map(|part| part.to_string_lossy()).collect();
    parts.join("/")
}

/// What stands beside the output folder while it is written.
#[derive(Clone, Debug)]
pub(crate) struct Beside {
    /// The lock, the list of the new tree, and files on their way.
    pub(crate) work: PathBuf,
    /// The other one of the two trees.
    pub(crate) tree: PathBuf,
}

impl Beside {
    /// None where nothing can stand beside the folder.
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

/// What an entry of a folder is; links are not followed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Kind {
    /// A folder.
    Folder,
    /// A symbolic link, whatever it leads to.
    Link,
    /// A file or a device.
    File,
}

/// Everything below a folder by its path in it, a folder before what it holds; nothing where there
/// is no such folder. What is in folders that are not ours is left out.
pub(crate) fn walk(root: &Path) -> io::Result<Vec<(PathBuf, Kind)>> {
    walk_into(root, &|name| !is_not_ours(name) && name != WORK)
}

/// As [`walk`], into the folders that `enter` names.
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

/// Whether anything has that name, even a link that leads nowhere.
pub(crate) fn is_there(path: &Path) -> bool {
    fs::symlink_metadata(path).is_ok()
}
