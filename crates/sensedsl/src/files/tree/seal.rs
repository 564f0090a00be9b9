//! Seals tell work that a run on this machine left from anything that somebody else put there. A folder with the work
//! of a run has a seal in it, which is made before anything else and removed after everything else.

use std::ffi::OsStr;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use super::failure::Trouble;
use super::layout::is_there;
use crate::files::lock;
use crate::files::ops::{self, Ops};
use crate::files::state::State;

const NAME: &str = "seal";

/// The reason why a working folder cannot be used.
#[derive(Debug)]
pub(super) enum Unclaimed {
    /// It is not from a run on this machine.
    Strange(PathBuf),
    /// Something is wrong with the machine.
    Failed(io::Error),
}

impl From<io::Error> for Unclaimed {
    fn from(error: io::Error) -> Self {
        Self::Failed(error)
    }
}

impl From<Unclaimed> for Trouble {
    fn from(why: Unclaimed) -> Self {
        match why {
            Unclaimed::Strange(what) => Self::Strange(what),
            Unclaimed::Failed(error) => Self::Unwritten(error),
        }
    }
}

/// Refuses a working folder with contents that no run on this machine left. Its lock is held. `tree` is the tree that
/// belongs to that work.
pub(super) fn vet(work: &Path, tree: Option<&Path>) -> Result<(), Unclaimed> {
    if is_sealed(work)? {
        return Ok(());
    }
    if let Some(tree) = tree.filter(|tree| is_there(tree)) {
        return Err(Unclaimed::Strange(tree.to_path_buf()));
    }
    if holds_nothing(work)? { Ok(()) } else { Err(Unclaimed::Strange(work.to_path_buf())) }
}

/// Seals a working folder that was vetted, and waits until the seal is on disk.
pub(super) fn set(ops: &Ops, work: &Path) -> io::Result<()> {
    if is_sealed(work)? {
        return Ok(());
    }
    let seal = work.join(NAME);
    // An incomplete seal is from a run that was stopped while it made the seal, and had made nothing else.
    ops.remove_file(&seal)?;
    ops.create(&seal, State::of_user().seal(work)?.as_bytes(), None)?;
    ops::sync(&[seal, work.to_path_buf()])
}

fn is_sealed(work: &Path) -> io::Result<bool> {
    let (seal, own) = (work.join(NAME), State::of_user().seal(work)?);
    let found = fs::symlink_metadata(&seal);
    let may_be = found.is_ok_and(|found| found.is_file() && found.len() == own.len() as u64);
    Ok(may_be && fs::read(&seal)? == own.as_bytes())
}

/// Removes the seal of a working folder in which nothing else is left.
pub(super) fn give_back(work: &Path) {
    if holds_nothing(work).unwrap_or(false) {
        // If that fails, the next run finds its own seal.
        let _ = fs::remove_file(work.join(NAME));
    }
}

/// Whether a working folder has nothing in it except its lock and its seal.
fn holds_nothing(work: &Path) -> io::Result<bool> {
    for entry in fs::read_dir(work)? {
        let name = entry?.file_name();
        if ![lock::NAME, NAME].iter().any(|own| name == OsStr::new(own)) {
            return Ok(false);
        }
    }
    Ok(true)
}
