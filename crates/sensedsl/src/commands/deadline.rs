//! The end of a command that has a `--timeout`. In: seconds. Out: whether they are over.

use std::time::{Duration, Instant};

/// The time at which the whole command must end, including reading: computed before anything else.
pub(crate) struct Deadline(Option<Instant>);

impl Deadline {
    pub(crate) fn after(timeout: Option<f64>) -> Self {
        Self(timeout.map(|seconds| Instant::now() + Duration::from_secs_f64(seconds)))
    }

    pub(crate) fn is_over(&self) -> bool {
        self.0.is_some_and(|end| Instant::now() >= end)
    }
}
