//! The time of the core: cycles become nanoseconds at a frequency that firmware changes.

use super::wires::SECOND_NS;

/// The conversion from cycles to time: a straight line from a moment on.
#[derive(Clone, Copy, Debug)]
pub(super) struct Line {
    pub(super) cycles: u64,
    pub(super) ns: u64,
    pub(super) hz: u64,
}

impl Line {
    pub(super) fn ns_at(&self, cycles: u64) -> u64 {
        let passed = u128::from(cycles - self.cycles) * u128::from(SECOND_NS) / u128::from(self.hz);
        self.ns + u64::try_from(passed).unwrap_or(u64::MAX - self.ns)
    }

    /// The first cycle at which the time is `ns` or later.
    pub(super) fn cycles_at(&self, ns: u64) -> u64 {
        let ahead = u128::from(ns.saturating_sub(self.ns)) * u128::from(self.hz);
        let cycles = ahead.div_ceil(u128::from(SECOND_NS));
        self.cycles.saturating_add(u64::try_from(cycles).unwrap_or(u64::MAX))
    }
}
