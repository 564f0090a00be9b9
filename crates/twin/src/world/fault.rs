//! Faults: what breaks, when, and for how long.

use sensedsl_model::design::DeviceIndex;
pub use sensedsl_model::design::FaultKind;

/// A fault.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault {
    /// The kind of fault.
    pub kind: FaultKind,
    /// The device whose wires are affected; `None` if it is the board or its link.
    pub device: Option<DeviceIndex>,
    /// The start.
    pub at_ns: u64,
    /// The end; the same as the start for a single moment.
    pub until_ns: u64,
}

impl Fault {
    /// Whether it is present at a moment.
    #[must_use]
    pub const fn is_there(&self, now_ns: u64) -> bool {
        self.at_ns <= now_ns && now_ns < self.until_ns
    }
}
