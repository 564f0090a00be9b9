//! For tests: makes the n-th change fail, once or together with all later ones.

use std::cell::Cell;
use std::io;

/// The change that fails.
#[derive(Debug, Default)]
pub(crate) struct Fault {
    /// The number of changes that still succeed; `None` if all do.
    left: Cell<Option<usize>>,
    once: bool,
    has_struck: Cell<bool>,
}

impl Fault {
    /// Fails as after a kill: from the n-th change on, nothing happens any more.
    pub(crate) fn killed_at(n: usize) -> Self {
        Self { left: Cell::new(Some(n)), ..Self::default() }
    }

    /// Fails as with a full disk: the n-th change fails, and later ones succeed.
    pub(crate) fn full_at(n: usize) -> Self {
        Self { left: Cell::new(Some(n)), once: true, ..Self::default() }
    }

    /// Whether the fault has occurred.
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
