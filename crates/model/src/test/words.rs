//! The words and limits of tests: what a reader knows, and what an editor offers.

use sensedsl_wire::Status;

/// The properties of a test.
pub(crate) const PROPERTIES: &[&str] = &["world", "for", "seed"];
/// The shortest test: a millisecond, in microseconds.
pub(crate) const LENGTH_MIN_US: u32 = 1_000;
/// The longest test: an hour, in microseconds.
pub(crate) const LENGTH_MAX_US: u32 = 3_600_000_000;

/// The states of a device, by the words of conditions.
pub const STATES: [(&str, Status); 5] = [
    ("good", Status::Good),
    ("stale", Status::Stale),
    ("failed", Status::Failed),
    ("invalid", Status::Invalid),
    ("never_read", Status::NeverRead),
];

/// The functions of conditions: each with what it takes and what it is.
pub const FUNCTIONS: [(&str, &str, &str); 7] = [
    ("abs", "a number", "without its sign"),
    ("min", "an array, or two numbers", "the smallest of them"),
    ("max", "an array, or two numbers", "the greatest of them"),
    ("age", "a sensor", "the time since its last value came"),
    ("health", "a device", "what the board says of it"),
    ("rising", "a condition", "the moment at which it becomes true"),
    ("falling", "a condition", "the moment at which it becomes false"),
];
