//! Words for how devices are.

use sensedsl_wire::{Health, ResetCause, Status};

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

/// What a board was restarted by, and which device's thread hung before a watchdog did: `restarted by the watchdog: Follow
/// hung`. None if it began with its supply, or does not know. `name` gives the name of the device with that identifier.
#[must_use]
pub fn restarted(health: &Health, name: impl FnOnce(u8) -> Option<String>) -> Option<String> {
    let cause = match health.reset_cause {
        ResetCause::Unknown | ResetCause::Other(_) | ResetCause::Power => return None,
        ResetCause::Pin | ResetCause::Watchdog | ResetCause::WindowWatchdog | ResetCause::Halt => {
            format!("the {}", reset_cause(health.reset_cause))
        }
        ResetCause::Software | ResetCause::LowPower => reset_cause(health.reset_cause).to_owned(),
    };
    let hung = (health.reset_device != 0).then(|| {
        let number = || format!("device {}", health.reset_device);
        format!(": {} hung", name(health.reset_device).unwrap_or_else(number))
    });
    Some(format!("restarted by {cause}{}", hung.unwrap_or_default()))
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

#[cfg(test)]
mod tests {
    use super::*;

    fn started(reset_cause: ResetCause, reset_device: u8) -> Option<String> {
        let health = Health {
            uptime_ms: 1,
            reports_sent: 0,
            reports_refused: 0,
            reset_cause,
            reset_device,
            load_percent: 0,
            stack_left_bytes: 0,
            devices: Vec::new(),
        };
        restarted(&health, |id| (id == 4).then(|| "Follow".to_owned()))
    }

    #[test]
    fn a_restart_is_told_with_whose_code_hung() {
        assert_eq!(started(ResetCause::Power, 0), None);
        assert_eq!(started(ResetCause::Pin, 0).unwrap(), "restarted by the reset pin");
        let told = started(ResetCause::Watchdog, 4).unwrap();
        assert_eq!(told, "restarted by the watchdog: Follow hung");
        let told = started(ResetCause::Watchdog, 9).unwrap();
        assert_eq!(told, "restarted by the watchdog: device 9 hung");
    }
}
