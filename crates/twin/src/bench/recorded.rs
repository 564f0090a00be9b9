//! What the host does to a board, and what comes out of it.

use super::Bench;
use crate::commands::Command;
use crate::commands::outputs::{Outputs, Recorder};

impl Bench {
    /// Whether the world does something to the board itself or to its link.
    #[must_use]
    pub fn is_disturbed(&self) -> bool {
        self.faults.iter().any(|one| one.kind.is_of_board())
    }

    /// What the board puts out.
    #[must_use]
    pub const fn outputs(&self) -> &Outputs {
        self.recorder.outputs()
    }

    /// What the world has the host set.
    #[must_use]
    pub fn commands(&self) -> &[Command] {
        &self.commands
    }

    pub(crate) const fn recorder(&mut self) -> &mut Recorder {
        &mut self.recorder
    }
}
