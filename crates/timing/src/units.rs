//! Units of time: how many nanoseconds each has, for every file that computes a duration.

/// Nanoseconds per second.
pub const SECOND_NS: u64 = 1_000_000_000;
/// Nanoseconds per millisecond.
pub(crate) const MILLISECOND_NS: u64 = 1_000_000;
