//! For tests: lets the n-th change fail, once or with all that follow.

use std::cell::Cell;
use std::io;

/// Which change fails.
#[derive(Debug, Default)]
pub(crate) struct Fault {
    /// Changes that still succeed; none for all.
    left: Cell<Option<usize>>,
    once: bool,
    has_struck: Cell<bool>,
}

impl Fault {
    /// As a kill does: from the n-th change on nothing happens any more.
    pub(crate) fn killed_at(n: usize) -> Self {
        Self { left: Cell::new(Some(n)), ..Self::default() }
    }

    /// As a full disk does: the n-th change fails, and later ones succeed.
    pub(crate) fn full_at(n: usize) -> Self {
        Self { left: Cell::new(Some(n)), once: true, ..Self::default() }
    }

    /// Whether the moment came.
    pub(crate) fn has_struck(&self) -> bool {
        self.has_struck.get()
    }

    pub(super) fn strike(&self) -> io::Result<()> {
        match self.left.get() {
            None => Ok(()),
            Some(0) => {
                self.has_struck.set(true);
                if self.once {
                    self.left.set(None);
                }
                Err(io::ErrorKind::StorageFull.into())
            }
            Some(n) => {
                self.left.set(Some(n - 1));
                Ok(())
            }
        }
    }
}
