//! An output folder: it holds the old tree or the new one, whatever happens while it is written.
//!
//! Guarantees:
//!
//! - Only one run at a time writes a folder. A second one waits, and gives up after `lock::WAIT`.
//! - On Linux, a program that opens the folder by its name finds the old tree or the new one, even after a kill, a full
//!   disk or a power failure (`switch`). On other systems, on file systems that cannot exchange two names, and if the
//!   folder is a mount point or nothing can be created beside it, the same holds unless a run is stopped within the few
//!   milliseconds in which files take their places; then the next run completes them (`journal`).
//! - Anything that a stopped run leaves behind is completed or removed by the next one.
//! - The user's folders are neither moved nor copied nor written to, except for missing files that are created only
//!   once. For some milliseconds of a switch, and until the next run if one is stopped within them, the folder shows
//!   them through symbolic links.
//! - A run that fails before the switch leaves the folder as it was.
//! - Only work that a run on this machine left is completed or removed (`seal`). The folder may be a stranger's:
//!   nothing is written or removed through a link in it (`apply`), or if the folder itself is a link that leads
//!   elsewhere (`away`).
//!
//! Not guaranteed: a process whose working folder is within the output folder sees files change one by one, and so does
//! one that reads several files by their paths during a run.

mod apply;
mod away;
mod failure;
mod journal;
pub(crate) mod layout;
mod new_tree;
mod seal;
#[cfg(target_os = "linux")]
mod switch;
#[cfg(test)]
mod tests;

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::time::Duration;

use anyhow::{Context as _, Result, bail};

use super::lock::{Lock, NoLock};
use super::ops::{self, Ops};
use crate::files::shown;
pub(crate) use away::Away;
pub(crate) use failure::{Failure, Trouble};
use layout::{Siblings, WORK, is_there};
pub(crate) use new_tree::{NewFile, NewTree};

/// An output folder that only this run may write to.
#[derive(Debug)]
pub(crate) struct Output {
    root: PathBuf,
    /// `None` if nothing can be created beside the folder.
    beside: Option<Siblings>,
    /// The locks beside the folder, within it, or both.
    locks: Vec<Lock>,
    /// Whether the folder was made by this run.
    is_new: bool,
    ops: Ops,
}

impl Output {
    /// Takes a folder for this run, creates it if necessary, and repairs what an earlier run has left. The project is
    /// the folder of the file, which may be a stranger's.
    pub(crate) fn take(
        output: &Path,
        project: &Path,
        wait: Duration,
        waiting: &mut dyn FnMut(),
    ) -> Result<Self, Trouble> {
        if let Some(away) = away::leads_away(output, project) {
            return Err(Trouble::Linked(away));
        }
        Self::take_with(Ops::default(), output, wait, waiting)
    }

    fn take_with(
        ops: Ops,
        output: &Path,
        wait: Duration,
        waiting: &mut dyn FnMut(),
    ) -> Result<Self, Trouble> {
        let root = resolve(output)?;
        let can = cfg!(target_os = "linux") && !is_mount_point(&root);
        let mut beside = Siblings::of(&root).filter(|_| can);
        let mut locks = Vec::new();
        if let Some(place) = &beside {
            match Lock::take(&place.work, wait, waiting) {
                Ok(lock) => {
                    seal::vet(&place.work, Some(&place.tree))?;
                    locks.push(lock);
                }
                // Then everything must happen within the folder.
                Err(NoLock::Failed(error)) if ops::is_unsupported(&error) => beside = None,
                Err(why) => return Err(why.into()),
            }
        }
        let mut taken = Self { root, beside, locks, is_new: false, ops };
        taken.recover_beside()?;
        if !is_there(&taken.root) {
            taken.ops.make_folders(&taken.root).map_err(Trouble::Unwritten)?;
            taken.is_new = true;
        }
        let within = taken.root.join(WORK);
        if taken.beside.is_none() || is_there(&within) {
            taken.lock_within(wait, waiting)?;
            seal::vet(&within, None)?;
            journal::recover(&taken.ops, &taken.root, &within).map_err(Trouble::Unrecovered)?;
        }
        Ok(taken)
    }

    /// The path of the folder, without links.
    pub(crate) fn root(&self) -> &Path {
        &self.root
    }

    /// Writes a tree to the folder.
    pub(crate) fn write(&mut self, new: &NewTree<'_>) -> Result<(), Failure> {
        match self.switch(new) {
            Err(Failure::Before(error)) if ops::is_unsupported(&error) => {}
            done => return done,
        }
        let within = self.root.join(WORK);
        let strange = |what: PathBuf| {
            io::Error::other(format!("{} is not a run's of this machine", shown(&what)))
        };
        match self.lock_within(super::lock::WAIT, &mut || {}) {
            Ok(()) => {}
            Err(NoLock::Failed(error)) => return Err(Failure::Before(error)),
            Err(NoLock::Busy) => return Err(Failure::Before(io::ErrorKind::ResourceBusy.into())),
            Err(NoLock::Strange(what)) => return Err(Failure::Before(strange(what))),
        }
        match seal::vet(&within, None) {
            Ok(()) => {}
            Err(seal::Unclaimed::Strange(what)) => return Err(Failure::Before(strange(what))),
            Err(seal::Unclaimed::Failed(error)) => return Err(Failure::Before(error)),
        }
        seal::set(&self.ops, &within).map_err(Failure::Before)?;
        journal::write(&self.ops, &self.root, &within, new)
    }

    #[cfg(target_os = "linux")]
    fn switch(&self, new: &NewTree<'_>) -> Result<(), Failure> {
        let Some(beside) = &self.beside else {
            return Err(Failure::Before(io::ErrorKind::Unsupported.into()));
        };
        switch::Switch { ops: &self.ops, root: &self.root, beside }.write(new)
    }

    #[cfg(not(target_os = "linux"))]
    #[expect(clippy::unused_self, reason = "it has the same form everywhere")]
    fn switch(&self, _: &NewTree<'_>) -> Result<(), Failure> {
        Err(Failure::Before(io::ErrorKind::Unsupported.into()))
    }

    #[cfg(target_os = "linux")]
    fn recover_beside(&self) -> Result<(), Trouble> {
        let Some(beside) = &self.beside else { return Ok(()) };
        let switch = switch::Switch { ops: &self.ops, root: &self.root, beside };
        match switch.recover() {
            Ok(None) => Ok(()),
            Ok(Some(orphan)) => Err(Trouble::Orphan(orphan)),
            Err(error) => Err(Trouble::Unrecovered(error)),
        }
    }

    #[cfg(not(target_os = "linux"))]
    #[expect(
        clippy::unused_self,
        clippy::unnecessary_wraps,
        reason = "it has the same form everywhere"
    )]
    fn recover_beside(&self) -> Result<(), Trouble> {
        Ok(())
    }

    fn lock_within(&mut self, wait: Duration, waiting: &mut dyn FnMut()) -> Result<(), NoLock> {
        if self.locks.len() == usize::from(self.beside.is_some()) {
            self.locks.push(Lock::take(&self.root.join(WORK), wait, waiting)?);
        }
        Ok(())
    }
}

impl Drop for Output {
    fn drop(&mut self) {
        if self.locks.len() > usize::from(self.beside.is_some()) {
            seal::give_back(&self.root.join(WORK));
        }
        if let Some(beside) = &self.beside {
            seal::give_back(&beside.work);
        }
        // The lock that was taken last is within the folder.
        while self.locks.len() > usize::from(self.beside.is_some()) {
            self.locks.pop();
        }
        if self.is_new {
            // This only succeeds if nothing was written to it.
            let _ = fs::remove_dir(&self.root);
        }
    }
}

/// The real path of the folder, without links.
fn resolve(output: &Path) -> Result<PathBuf> {
    let whole = shown(output);
    match fs::metadata(output) {
        Ok(found) if found.is_dir() => {
            fs::canonicalize(output).with_context(|| format!("cannot read {whole}"))
        }
        Ok(_) => bail!("{whole} is not a folder"),
        Err(error) if error.kind() == io::ErrorKind::NotFound => {
            if is_there(output) {
                bail!("{whole} is a link to a folder that does not exist: make that folder first");
            }
            let name = output.file_name().with_context(|| format!("{whole} has no name"))?;
            let above = output.parent().filter(|above| *above != Path::new(""));
            let above = above.unwrap_or(Path::new("."));
            fs::create_dir_all(above).with_context(|| format!("cannot make {}", shown(above)))?;
            Ok(fs::canonicalize(above).with_context(|| format!("cannot read {whole}"))?.join(name))
        }
        Err(error) => Err(error).with_context(|| format!("cannot read {whole}")),
    }
}

/// Whether the folder is on another disk than its parent.
#[cfg(unix)]
fn is_mount_point(root: &Path) -> bool {
    use std::os::unix::fs::MetadataExt as _;
    let device = |path: &Path| fs::metadata(path).ok().map(|found| found.dev());
    let (own, above) = (device(root), root.parent().and_then(device));
    own.is_some() && own != above
}

#[cfg(not(unix))]
fn is_mount_point(_: &Path) -> bool {
    false
}
