//! The way to a new tree where two names cannot be exchanged: a journal.
//!
//! All files are written and on disk before the first one takes its place, and a mark records that.
//! A run that is stopped before the mark has changed nothing; one that is stopped after it leaves
//! an intermediate tree, which the next run completes.

use std::io;
use std::path::Path;

use super::apply::{apply, clear, stage};
use super::failure::Failure;
use super::layout::is_there;
use super::new_tree::NewTree;
use crate::files::ops::{self, Ops};

/// The name of the mark: once it is there, the run can only go forward.
const COMPLETE: &str = "complete";

/// Writes a tree to `root`; `work` is a folder in it, whose lock is held.
pub(super) fn write(ops: &Ops, root: &Path, work: &Path, new: &NewTree<'_>) -> Result<(), Failure> {
    let staged = stage(ops, work, root, new, &|_| false)
        .and_then(|()| ops.create(&work.join(COMPLETE), b"", None))
        .and_then(|()| ops::sync(&[work.join(COMPLETE), work.to_path_buf()]));
    if let Err(error) = staged {
        // Anything that cannot be removed now is removed by the next run. The mark is removed
        // first.
        let _ = clear(ops, work, &[COMPLETE]);
        return Err(Failure::Before(error));
    }
    recover(ops, root, work).map_err(Failure::After)
}

/// Completes what an earlier run has started, or removes it.
pub(super) fn recover(ops: &Ops, root: &Path, work: &Path) -> io::Result<()> {
    if is_there(&work.join(COMPLETE)) {
        apply(ops, work, root)?;
        ops.remove_file(&work.join(COMPLETE))?;
    }
    clear(ops, work, &[])
}
