//! The end of a command that has a `--timeout`: seconds in, the question whether they are over out.

use std::time::{Duration, Instant};

/// When the whole command is to be over, reading included: made before anything else is done.
pub(crate) struct Deadline(Option<Instant>);

impl Deadline {
    pub(crate) fn after(timeout: Option<f64>) -> Self {
        Self(timeout.map(|seconds| Instant::now() + Duration::from_secs_f64(seconds)))
    }

    pub(crate) fn is_over(&self) -> bool {
        self.0.is_some_and(|end| Instant::now() >= end)
    }
}
