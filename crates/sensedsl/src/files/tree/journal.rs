//! The way to a new tree where two names cannot change places: a journal.
//!
//! All files are written and on the disk before the first one takes its place, and a mark says
//! that they are. A run that is stopped before the mark has changed nothing; one that is stopped
//! after it leaves a tree in between, which the next run completes.

use std::io;
use std::path::Path;

use super::apply::{apply, clear, stage};
use super::layout::is_there;
use super::{Failure, NewTree};
use crate::files::ops::{self, Ops};

/// The mark: from here on there is only the way forward.
const COMPLETE: &str = "complete";

/// Makes `root` hold a tree; `work` is a folder in it, with the lock that is held.
pub(super) fn write(ops: &Ops, root: &Path, work: &Path, new: &NewTree<'_>) -> Result<(), Failure> {
    let staged = stage(ops, work, root, new, &|_| false)
        .and_then(|()| ops.create(&work.join(COMPLETE), b"", None))
        .and_then(|()| ops::sync(&[work.join(COMPLETE), work.to_path_buf()]));
    if let Err(error) = staged {
        // What cannot be removed now is removed by the next run. The mark goes first.
        let _ = clear(ops, work, &[COMPLETE]);
        return Err(Failure::Before(error));
    }
    recover(ops, root, work).map_err(Failure::After)
}

/// Completes what an earlier run has begun, or removes it.
pub(super) fn recover(ops: &Ops, root: &Path, work: &Path) -> io::Result<()> {
    if is_there(&work.join(COMPLETE)) {
        apply(ops, work, root)?;
        ops.remove_file(&work.join(COMPLETE))?;
    }
    clear(ops, work, &[])
}
