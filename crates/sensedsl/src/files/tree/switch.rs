//! The way to a new tree in one moment: two names are exchanged.
//!
//! A complete new tree is written beside the old one. In place of the user's folders it has
//! symbolic links, so that there is only ever one such folder. When everything is on disk, the
//! names of the two trees are exchanged, and every reader sees the new one. The old tree, which is
//! now the one beside it, is also changed into the new one, and the names are exchanged once more.
//! So the folder remains the same one for a shell that works in it, and the user's folders have
//! never been moved, copied or opened. At whatever moment a run is stopped, these names alone tell
//! the next one what to do.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use super::apply::{NEW_LIST, apply, clear, never_through_a_link, stage, staged, sync_folders};
use super::failure::Failure;
use super::layout::{
    self, Kind, LIST, Siblings, is_not_ours, is_there, link_above, listed, not_ours_above, slashed,
    walk,
};
use super::new_tree::NewTree;
use super::seal;
use crate::files::ops::{self, Ops};
use crate::files::{shown, write_whole};

/// The file in the working folder that lists those files of the new tree that will be the user's.
const ONCE: &str = "once";

/// An output folder and the entries beside it.
#[derive(Clone, Copy)]
pub(super) struct Switch<'a> {
    pub(super) ops: &'a Ops,
    pub(super) root: &'a Path,
    pub(super) beside: &'a Siblings,
}

impl Switch<'_> {
    /// Writes a tree to the folder.
    pub(super) fn write(&self, new: &NewTree<'_>) -> Result<(), Failure> {
        let Siblings { work, tree } = self.beside;
        let ready = seal::set(self.ops, work)
            .and_then(|()| self.prepare(new))
            .and_then(|()| self.ops.exchange(tree, self.root));
        if let Err(error) = ready {
            // Anything that cannot be removed now is removed by the next run.
            let _ = self.dismantle().and_then(|_| clear(self.ops, work, &[ONCE]));
            return Err(Failure::Before(error));
        }
        self.settle().map_err(Failure::After)
    }

    /// Completes what an earlier run has started, or removes it. Returns an entry that is in the
    /// way and not ours to remove.
    pub(super) fn recover(&self) -> io::Result<Option<PathBuf>> {
        let Siblings { work, tree } = self.beside;
        if self.is_switched() {
            self.settle()?;
        } else if fs::symlink_metadata(tree.join(LIST)).is_ok_and(|found| found.is_file()) {
            // This is the old tree, with the user's folders, and the one that replaced it is gone.
            if is_there(self.root) {
                return Ok(Some(tree.clone()));
            }
            self.ops.rename(tree, self.root)?;
        } else if let Some(left) = self.dismantle()? {
            return Ok(Some(left));
        }
        clear(self.ops, work, &[ONCE])?;
        Ok(None)
    }

    /// Writes the new tree beside the old one, and waits until it is on disk.
    fn prepare(&self, new: &NewTree<'_>) -> io::Result<()> {
        let Siblings { work, tree } = self.beside;
        // A user's file in an existing folder can only be created in that folder.
        let at_once = |path: &str| {
            not_ours_above(Path::new(path)).is_none_or(|folder| is_there(&self.root.join(folder)))
        };
        let once = new.files.iter().filter(|file| file.once);
        let paths: BTreeSet<String> =
            once.clone().filter(|file| !at_once(file.path)).map(|file| file.path.into()).collect();
        let lines: BTreeMap<_, _> = paths.iter().map(|path| (path.clone(), None)).collect();
        self.ops.create(&work.join(ONCE), layout::list(&lines).as_bytes(), None)?;
        let is_once: BTreeSet<&str> = once.clone().map(|file| file.path).collect();
        stage(self.ops, work, self.root, new, &|path| is_once.contains(path))?;
        self.stage_links(&paths)?;
        self.build(new, &at_once)?;
        for file in once.filter(|file| file.changes && at_once(file.path)) {
            never_through_a_link(self.root, Path::new(file.path))?;
            write_whole(&self.root.join(file.path), file.bytes).map_err(io::Error::other)?;
        }
        let files = walk(tree)?.into_iter().filter(|(_, kind)| *kind == Kind::File);
        let files: Vec<PathBuf> = files.map(|(path, _)| tree.join(path)).collect();
        ops::sync(&files)?;
        let made = paths.iter().map(|path| tree.join(path));
        let made: Vec<PathBuf> = made.flat_map(|path| [path.with_file_name(""), path]).collect();
        ops::sync(&made)?;
        sync_folders(tree)?;
        sync_above(tree)
    }

    /// Makes the links for user's folders that do not exist yet. The links are exchanged with the
    /// folders later; they are made now, while the disk may still be full.
    fn stage_links(&self, once: &BTreeSet<String>) -> io::Result<()> {
        let Siblings { work, tree } = self.beside;
        for folder in once.iter().filter_map(|path| not_ours_above(Path::new(path))) {
            let link = staged(work, folder);
            if !is_there(&link) {
                self.ops.make_folders(link.parent().unwrap_or(work))?;
                self.ops.symlink(&self.link_to(folder, &tree.join(folder)), &link)?;
            }
        }
        Ok(())
    }

    /// Builds the new tree from the staged files and from those that stay.
    fn build(&self, new: &NewTree<'_>, at_once: &dyn Fn(&str) -> bool) -> io::Result<()> {
        let Siblings { work, tree } = self.beside;
        self.ops.make_folders(tree)?;
        fs::set_permissions(tree, fs::metadata(self.root)?.permissions())?;
        self.ops.symlink(&self.link_to(Path::new(LIST), &work.join(NEW_LIST)), &tree.join(LIST))?;
        for (path, _) in walk(self.root)? {
            if path.file_name().is_some_and(is_not_ours) {
                let to = tree.join(&path);
                self.ops.make_folders(to.parent().unwrap_or(tree))?;
                self.ops.symlink(&self.link_to(&path, &tree.join(&path)), &to)?;
            }
        }
        for file in &new.files {
            if file.once && at_once(file.path) {
                continue;
            }
            let to = tree.join(file.path);
            self.ops.make_folders(to.parent().unwrap_or(tree))?;
            let from = match (file.once, file.changes) {
                (true, _) => None,
                (false, true) => Some(staged(work, Path::new(file.path))),
                (false, false) => Some(self.root.join(file.path)),
            };
            match from.map(|from| self.ops.link(&from, &to)) {
                Some(Ok(())) => {}
                Some(Err(error)) if !ops::is_unsupported(&error) => return Err(error),
                // Some file systems do not allow a second name for a file.
                Some(Err(_)) | None => self.ops.create(&to, file.bytes, None)?,
            }
        }
        Ok(())
    }

    /// The new tree has the folder's name: changes the old one into the same tree, and gives it its
    /// name back.
    fn settle(&self) -> io::Result<()> {
        let Siblings { work, tree } = self.beside;
        sync_above(self.root)?;
        apply(self.ops, work, tree)?;
        self.hand_over()?;
        sync_folders(tree)?;
        self.ops.exchange(self.root, tree)?;
        sync_above(self.root)?;
        if let Some(left) = self.dismantle()? {
            return Err(io::Error::other(format!("{} holds files of yours", shown(&left))));
        }
        clear(self.ops, work, &[ONCE])
    }

    /// Passes everything in the new tree that is the user's to the old one: folders that were not
    /// there before, and anything made since the names were exchanged.
    fn hand_over(&self) -> io::Result<()> {
        let Siblings { work, tree } = self.beside;
        let list = listed(&work.join(NEW_LIST))?;
        for (path, kind) in walk(self.root)? {
            let (from, to) = (self.root.join(&path), tree.join(&path));
            let theirs = path.file_name().is_some_and(is_not_ours);
            let above = to.parent().unwrap_or(tree);
            match kind {
                Kind::Folder if theirs => {
                    if !is_there(&to) {
                        self.ops.make_folders(above)?;
                        self.ops.symlink(&self.link_to(&path, &to), &to)?;
                    }
                    // The folder and the link to it are exchanged, so it is always there.
                    if fs::symlink_metadata(&to)?.is_symlink() {
                        self.ops.exchange(&from, &to)?;
                    }
                }
                Kind::Link if theirs => {}
                Kind::Folder => {}
                Kind::Link | Kind::File => {
                    let ours = path == Path::new(LIST) || list.contains(&slashed(&path));
                    if !ours && !is_there(&to) {
                        self.ops.make_folders(above)?;
                        self.ops.rename(&from, &to)?;
                    }
                }
            }
        }
        Ok(())
    }

    /// Removes the tree beside the folder, which is the new one, but nothing that is not ours.
    fn dismantle(&self) -> io::Result<Option<PathBuf>> {
        let Siblings { work, tree } = self.beside;
        let list = listed(&work.join(NEW_LIST))?;
        for path in listed(&work.join(ONCE))? {
            let path = Path::new(&path);
            // Never through a link: it leads to the user's own folder.
            if not_ours_above(path).is_some_and(|folder| is_folder(&tree.join(folder))) {
                self.ops.remove_file(&tree.join(path))?;
                self.remove_empty(path.ancestors().skip(1))?;
            }
        }
        let all = walk(tree)?;
        for (path, kind) in &all {
            let theirs = path.file_name().is_some_and(is_not_ours);
            let ours = path == Path::new(LIST) || list.contains(&slashed(path));
            match kind {
                Kind::Link if theirs || ours => self.ops.remove_file(&tree.join(path))?,
                Kind::File if ours => self.ops.remove_file(&tree.join(path))?,
                Kind::Folder if !theirs => {}
                Kind::Folder | Kind::Link | Kind::File => self.rescue(path)?,
            }
        }
        self.remove_empty(all.iter().rev().map(|(path, _)| path.as_path()))?;
        self.remove_empty([Path::new("")])?;
        Ok(is_there(tree).then(|| tree.clone()))
    }

    /// Moves an entry that somebody else put into the tree beside the folder to the place where it
    /// was meant to be.
    fn rescue(&self, path: &Path) -> io::Result<()> {
        let to = self.root.join(path);
        if is_there(&to) || link_above(self.root, path).is_some() {
            return Ok(());
        }
        self.ops.make_folders(to.parent().unwrap_or(self.root))?;
        self.ops.rename(&self.beside.tree.join(path), &to)
    }

    /// Removes the empty ones of these folders in the tree beside.
    fn remove_empty<'a>(&self, folders: impl IntoIterator<Item = &'a Path>) -> io::Result<()> {
        for folder in folders.into_iter().map(|path| self.beside.tree.join(path)) {
            let removed = if is_folder(&folder) { self.ops.remove_folder(&folder) } else { Ok(()) };
            match removed {
                // Something else is in it.
                Err(error) if error.kind() == io::ErrorKind::DirectoryNotEmpty => {}
                done => done?,
            }
        }
        Ok(())
    }

    /// Whether the new tree has the folder's name: then its list is a link.
    fn is_switched(&self) -> bool {
        let list = self.link_to(Path::new(LIST), &self.beside.work.join(NEW_LIST));
        fs::read_link(self.root.join(LIST)).is_ok_and(|found| found == list)
    }

    /// The target of a link at a path of a tree that leads to something beside the tree.
    fn link_to(&self, path: &Path, target: &Path) -> PathBuf {
        let up: PathBuf = path.components().map(|_| "..").collect();
        let parent = self.root.parent().unwrap_or(self.root);
        up.join(target.strip_prefix(parent).unwrap_or(target))
    }
}

fn is_folder(path: &Path) -> bool {
    fs::symlink_metadata(path).is_ok_and(|found| found.is_dir())
}

/// Waits until a name is on disk.
fn sync_above(path: &Path) -> io::Result<()> {
    path.parent().map_or(Ok(()), |parent| ops::sync(&[parent.to_path_buf()]))
}
