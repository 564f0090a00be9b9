//! The way from one tree to another within a folder: staged files take their places, and files that are no longer
//! needed are removed. A run that is stopped in the middle can start again, with the same result.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use super::layout::{self, Kind, LIST, is_there, link_above, listed, not_ours_above, walk};
use super::new_tree::NewTree;
use crate::files::ops::{self, Ops};
use crate::files::{shown, write_whole};

/// The subfolder of a working folder with the staged files.
const FILES: &str = "files";

/// The list of the new tree; it stays until everything is done.
pub(super) const NEW_LIST: &str = "list";

/// The list of files that are no longer needed. It is the run's own, because the folder's list may be a stranger's.
const STALE: &str = "stale";

/// Writes the changed files of a tree, without the exceptions, and its list into a working folder.
pub(super) fn stage(
    ops: &Ops,
    work: &Path,
    root: &Path,
    new: &NewTree<'_>,
    except: &dyn Fn(&str) -> bool,
) -> io::Result<()> {
    ops.create(&work.join(NEW_LIST), new.list.as_bytes(), None)?;
    let stale = new.stale.iter().map(|path| (path.clone(), None)).collect();
    ops.create(&work.join(STALE), layout::list(&stale).as_bytes(), None)?;
    let files = work.join(FILES);
    ops.make_folders(&files)?;
    for file in new.files.iter().filter(|file| file.changes && !except(file.path)) {
        let to = files.join(file.path);
        ops.make_folders(to.parent().unwrap_or(&files))?;
        ops.create(&to, file.bytes, Some(&root.join(file.path)))?;
    }
    ops.create(&files.join(LIST), new.list.as_bytes(), None)?;
    // The folders are included, because a name is on disk only if its folder is.
    let mut all: Vec<PathBuf> =
        walk_all(&files)?.iter().map(|(path, _)| files.join(path)).collect();
    all.extend([files, work.join(NEW_LIST), work.join(STALE), work.to_path_buf()]);
    ops::sync(&all)
}

/// The path of a staged file.
#[cfg_attr(
    not(target_os = "linux"),
    allow(dead_code, reason = "only Linux exchanges two names at once")
)]
pub(super) fn staged(work: &Path, path: &Path) -> PathBuf {
    work.join(FILES).join(path)
}

/// Moves everything that is staged into a folder, and waits until that is on disk.
pub(super) fn apply(ops: &Ops, work: &Path, root: &Path) -> io::Result<()> {
    let files = work.join(FILES);
    // This comes first, because a file may have been where a folder will be.
    for stale in listed(&work.join(STALE))? {
        remove(ops, root, Path::new(&stale))?;
    }
    let mut last = None;
    for (path, kind) in walk_all(&files)? {
        let from = files.join(&path);
        match kind {
            // It has been moved with its folder.
            _ if !is_there(&from) => {}
            // A folder is moved as a whole if there is none: no space is needed for a new one.
            Kind::Folder if !is_there(&root.join(&path)) => ops.rename(&from, &root.join(&path))?,
            Kind::Folder => {}
            _ if path == Path::new(LIST) => last = Some(from),
            Kind::File | Kind::Link => put(ops, &from, root, &path)?,
        }
    }
    // Replacing the list loses the record of the earlier files, so it comes last.
    if let Some(list) = last {
        put(ops, &list, root, Path::new(LIST))?;
    }
    sync_folders(root)
}

/// Waits until the names in all folders of ours are on disk.
pub(super) fn sync_folders(root: &Path) -> io::Result<()> {
    let ours = |path: &Path| !path.file_name().is_some_and(layout::is_not_ours);
    let mut folders = vec![root.to_path_buf()];
    let found = walk(root)?.into_iter();
    folders.extend(
        found
            .filter(|(path, kind)| *kind == Kind::Folder && ours(path))
            .map(|(path, _)| root.join(path)),
    );
    ops::sync(&folders)
}

/// Removes the contents of a working folder, except its lock.
pub(super) fn clear(ops: &Ops, work: &Path, more: &[&str]) -> io::Result<()> {
    ops.remove_all(&work.join(FILES))?;
    for name in more.iter().chain(&[NEW_LIST, STALE]) {
        ops.remove_file(&work.join(name))?;
    }
    Ok(())
}

/// Moves one file into its place.
fn put(ops: &Ops, from: &Path, root: &Path, path: &Path) -> io::Result<()> {
    let to = root.join(path);
    never_through_a_link(root, path)?;
    let theirs =
        not_ours_above(path).is_some() || path.file_name().is_some_and(layout::is_not_ours);
    if theirs && is_there(&to) {
        // The user has just made it; it belongs to the user in any case.
        return ops.remove_file(from);
    }
    match ops.rename(from, &to) {
        // A user's folder may be on another disk.
        Err(error) if error.kind() == io::ErrorKind::CrossesDevices => {
            write_whole(&to, &layout::read_file(from)?).map_err(io::Error::other)?;
            ops.remove_file(from)
        }
        done => done,
    }
}

/// Refuses a path that leads elsewhere. Such folders are refused by name before anything is changed, so this one has
/// been changed since then.
pub(super) fn never_through_a_link(root: &Path, path: &Path) -> io::Result<()> {
    let Some(link) = link_above(root, path) else { return Ok(()) };
    Err(io::Error::other(format!("{} is a link", shown(root.join(link)))))
}

/// Removes a file, and the folders that are empty without it.
fn remove(ops: &Ops, root: &Path, path: &Path) -> io::Result<()> {
    never_through_a_link(root, path)?;
    if fs::symlink_metadata(root.join(path)).is_ok_and(|found| found.is_dir()) {
        // If it is a folder by now, it is not the file that was generated.
        return Ok(());
    }
    ops.remove_file(&root.join(path))?;
    for folder in path.ancestors().skip(1).filter(|folder| *folder != Path::new("")) {
        if ops.remove_folder(&root.join(folder)).is_err() {
            // The folder is not empty: something else is in it.
            break;
        }
    }
    Ok(())
}

/// Walks a folder like [`walk`], including folders that would otherwise be the user's: here everything is the
/// program's.
fn walk_all(root: &Path) -> io::Result<Vec<(PathBuf, Kind)>> {
    layout::walk_into(root, &|_| true)
}
