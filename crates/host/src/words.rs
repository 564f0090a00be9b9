//! Words for how devices are.

use sensedsl_wire::{ResetCause, Status};

/// How a device is, in a word or two.
#[must_use]
pub fn status(status: Status) -> &'static str {
    match status {
        Status::NeverRead => "never read",
        Status::Good => "good",
        Status::Stale => "stale",
        Status::Failed => "failed",
        Status::Invalid => "invalid",
        Status::Other(_) => "unknown",
    }
}

/// Why a board started, in a word or two.
#[must_use]
pub fn reset_cause(cause: ResetCause) -> &'static str {
    match cause {
        ResetCause::Unknown | ResetCause::Other(_) => "unknown",
        ResetCause::Power => "power",
        ResetCause::Pin => "reset pin",
        ResetCause::Software => "software",
        ResetCause::Watchdog => "watchdog",
        ResetCause::WindowWatchdog => "window watchdog",
        ResetCause::LowPower => "low-power mode",
        ResetCause::Halt => "halt of the kernel",
    }
}

/// How often a device failed, by cause: `3 timed out, 1 invalid`; empty if it did not.
#[must_use]
pub fn causes(counts: [u16; 6]) -> String {
    let words = [
        "not acknowledged",
        "bus errors",
        "arbitration lost",
        "timed out",
        "wrong checksums",
        "invalid",
    ];
    let some = counts.iter().zip(words).filter(|(count, _)| **count > 0);
    some.map(|(count, word)| format!("{count} {word}")).collect::<Vec<_>>().join(", ")
}
