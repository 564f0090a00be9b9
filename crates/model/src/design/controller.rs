//! Code of the user's that runs on a board in a cycle of its own.

use sensedsl_diagnostics::Span;

use super::{BoardIndex, DeviceIndex};
use crate::spanned::Spanned;

/// Code of the user's: once a cycle it gets the newest values, and says what to set.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Controller {
    /// The device that it is to the host: its value counts the steps that were late or too long.
    pub device: DeviceIndex,
    /// The board that it runs on.
    pub board: BoardIndex,
    /// The time from the beginning of a step to that of the next one.
    pub every_ms: u32,
    /// Where that time is given.
    pub every_span: Span,
    /// The devices whose values it gets, in the order of the file; each once.
    pub reads: Vec<Spanned<DeviceIndex>>,
    /// The devices that it sets, in the order of the file; each once.
    pub sets: Vec<Spanned<DeviceIndex>>,
    /// The longest that a step may take; none if the file does not say.
    pub takes_us: Option<u32>,
    /// Whether a value of the host's wins over the code until the host falls silent.
    pub host_overrides: bool,
}

impl Controller {
    /// Whether it sets the device.
    #[must_use]
    pub fn sets(&self, device: DeviceIndex) -> bool {
        self.sets.iter().any(|one| one.value == device)
    }

    /// Gives its devices new numbers; those without one are left out. Tells whether the controller is left.
    pub(super) fn renumber(&mut self, new: &dyn Fn(DeviceIndex) -> Option<DeviceIndex>) -> bool {
        let kept = |list: &mut Vec<Spanned<DeviceIndex>>| {
            list.retain_mut(|one| new(one.value).map(|new| one.value = new).is_some());
        };
        kept(&mut self.reads);
        kept(&mut self.sets);
        new(self.device).map(|new| self.device = new).is_some()
    }
}
