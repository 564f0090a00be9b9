//! The host's commands to a board, and the board's outputs.

use super::Bench;
use crate::commands::Command;
use crate::commands::outputs::{Outputs, Recorder};

impl Bench {
    /// Whether the world disturbs the board itself or its link.
    #[must_use]
    pub fn is_disturbed(&self) -> bool {
        self.faults.iter().any(|one| one.fault.kind.is_of_board())
    }

    /// The outputs of the board.
    #[must_use]
    pub const fn outputs(&self) -> &Outputs {
        self.recorder.outputs()
    }

    /// The commands that the world has the host send.
    #[must_use]
    pub fn commands(&self) -> &[Command] {
        &self.commands
    }

    pub(crate) const fn recorder(&mut self) -> &mut Recorder {
        &mut self.recorder
    }
}
