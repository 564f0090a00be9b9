//! What ends a command: its `--timeout`, in seconds, and Ctrl-C. Out: whether it is over.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};

use anyhow::Result;
use signal_hook::consts::{SIGINT, SIGTERM};

/// The status that a shell gives a program that a signal ended is this and the signal's number.
const STATUS_OF_SIGNALS: i32 = 128;

/// A flag that the first Ctrl-C sets; the second one ends the program.
pub(crate) fn interruption() -> Result<Arc<AtomicBool>> {
    let flag = Arc::new(AtomicBool::new(false));
    signal_hook::flag::register_conditional_shutdown(
        SIGINT,
        STATUS_OF_SIGNALS + SIGINT,
        Arc::clone(&flag),
    )?;
    signal_hook::flag::register(SIGINT, Arc::clone(&flag))?;
    Ok(flag)
}

/// A flag that Ctrl-C and a request to end set, for a program that gives a terminal back before it ends; without one, the
/// second signal ends the program.
pub(crate) fn ending(has_terminal: bool) -> Result<Arc<AtomicBool>> {
    let flag = Arc::new(AtomicBool::new(false));
    for signal in [SIGINT, SIGTERM] {
        if !has_terminal {
            let status = STATUS_OF_SIGNALS + signal;
            signal_hook::flag::register_conditional_shutdown(signal, status, Arc::clone(&flag))?;
        }
        signal_hook::flag::register(signal, Arc::clone(&flag))?;
    }
    // `nohup` lets a program without a terminal live.
    #[cfg(unix)]
    if has_terminal {
        signal_hook::flag::register(signal_hook::consts::SIGHUP, Arc::clone(&flag))?;
    }
    Ok(flag)
}

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
