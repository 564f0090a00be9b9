//! A board's report on the health of its devices, checked against the faults of the world.
//!
//! A device with which nothing is wrong must not fail, and nothing may be counted against it.

use sensedsl_job::{BoardJob, JobDevice};
use sensedsl_wire::{Causes, DeviceHealth, Health, NEVER_MS, ResetCause, Status};

use super::findings::{DeviceFindings, Disagreement, Finding, MS};
use crate::bench::Bench;

/// The health that the world lets a device have when the board is asked for it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Expected {
    /// Whether nothing in the world keeps it from answering now.
    pub(super) is_well: bool,
    /// Whether nothing in the world has ever kept it from answering.
    pub(super) was_well: bool,
    /// Whether its measurements may be, or may have been, `invalid`.
    pub(super) may_be_invalid: bool,
    /// The greatest age of its value; `None` if it need not have one.
    pub(super) age_ns: Option<u64>,
    /// The number of messages that the board may have received only in part.
    pub(super) halves: u16,
}

impl Expected {
    /// The difference from the board's report, in words.
    pub(super) fn differs(&self, row: &DeviceHealth) -> Option<String> {
        let counted = if self.was_well { self.counted(row.causes) } else { None };
        let with = |what: &str| {
            counted.as_ref().map_or_else(|| what.to_owned(), |all| format!("{what}, {all}"))
        };
        let is_due = self.is_well && self.age_ns.is_some();
        match row.status {
            Status::Failed if self.is_well => return Some(with("failed")),
            Status::NeverRead if is_due => return Some(with("never read")),
            Status::Stale if is_due => return Some(with("stale")),
            Status::Invalid if self.is_well && !self.may_be_invalid => {
                return Some(with("invalid"));
            }
            Status::Failed
            | Status::NeverRead
            | Status::Stale
            | Status::Invalid
            | Status::Good
            | Status::Other(_) => {}
        }
        if let Some(age_ns) = self.age_ns.filter(|_| self.is_well)
            && row.age_ms != NEVER_MS
            && MS * u64::from(row.age_ms) > age_ns
        {
            return Some(format!(
                "its value is {} ms old, and not {} at most",
                row.age_ms,
                age_ns / MS
            ));
        }
        counted
    }

    /// The counted faults that nothing explains.
    fn counted(&self, causes: Causes) -> Option<String> {
        let checksums = causes.wrong_checksum.saturating_sub(self.halves);
        let invalid = if self.may_be_invalid { 0 } else { causes.invalid };
        let all = [
            (causes.not_acknowledged, "not acknowledged"),
            (causes.bus_error.saturating_sub(self.halves), "with an error of the bus"),
            (causes.arbitration_lost, "lost to another master"),
            (causes.timed_out, "not in time"),
            (checksums, "with a wrong checksum"),
            (invalid, "not a measurement"),
        ];
        let all = all.iter().filter(|(count, _)| *count > 0);
        let all: Vec<String> =
            all.map(|(count, what)| format!("{count} {} {what}", times(*count))).collect();
        (!all.is_empty()).then(|| all.join(", "))
    }
}

const fn times(count: u16) -> &'static str {
    if count == 1 { "reading" } else { "readings" }
}

/// By how much a board's clock may be off, including the time that it takes to start.
const CLOCK_MS: u64 = 500;
/// The longest time until a command takes effect.
const SET_NS: u64 = 500 * MS;
/// The reports that are on their way when the board counts them.
const UNDERWAY: u64 = 2;

/// The error in a board's report on itself, if nothing in the world has disturbed it.
pub(super) fn board_differs(health: &Health, now_ns: u64, received: u64) -> Option<String> {
    let (now_ms, up_ms) = (now_ns / MS, u64::from(health.uptime_ms));
    if up_ms > now_ms + now_ms / 100 || up_ms + CLOCK_MS + now_ms / 100 < now_ms {
        return Some(format!("it runs for {up_ms} ms, and not for {now_ms} ms"));
    }
    match health.reset_cause {
        ResetCause::Unknown | ResetCause::Power | ResetCause::Pin => {}
        ResetCause::Software
        | ResetCause::Watchdog
        | ResetCause::WindowWatchdog
        | ResetCause::LowPower
        | ResetCause::Halt
        | ResetCause::Other(_) => return Some("it was started anew".to_owned()),
    }
    if health.reset_device != 0 {
        return Some(format!("device {} hung before it started", health.reset_device));
    }
    let sent = u64::from(health.reports_sent);
    if !(received..=received + UNDERWAY).contains(&sent) {
        return Some(format!("it has sent {sent} reports, of which {received} came"));
    }
    (health.stack_left_bytes == 0).then(|| "a stack is full".to_owned())
}

/// A finding about the board's report.
pub(super) fn wrong(at_ns: u64, what: String) -> Disagreement {
    Disagreement { at_ns, finding: Finding::Health(what), off: 100_000.0 }
}

/// A device that reports no values: its bus may still count faults, and the board knows when the device was set.
#[derive(Clone, Debug)]
pub(super) struct SilentDeviceJudge {
    pub(super) id: u8,
    pub(super) judged: DeviceFindings,
    pub(super) is_well: bool,
    /// The time at which the host last set it.
    pub(super) reported_ns: Option<u64>,
}

impl SilentDeviceJudge {
    pub(super) fn new(job: &BoardJob<'_>, bench: &Bench, one: &JobDevice<'_>) -> Self {
        let judged = DeviceFindings::new(one.name().to_owned(), one.device.shown.quantity.clone());
        let is_well = bench.excused(job, one.index).is_empty();
        Self { id: one.device.id.value, judged, is_well, reported_ns: None }
    }

    /// A value that is set has no cycle in which it must come again: it is never stale, and it is as old as the
    /// command.
    pub(super) fn health(&mut self, now_ns: u64, row: &DeviceHealth) {
        let since_ns = self.reported_ns.map(|at_ns| now_ns.saturating_sub(at_ns));
        let expected = Expected {
            is_well: self.is_well,
            was_well: self.is_well,
            may_be_invalid: false,
            age_ns: since_ns.filter(|since_ns| *since_ns > SET_NS).map(|ns| ns + SET_NS),
            halves: 0,
        };
        let stale = (self.is_well && row.status == Status::Stale)
            .then(|| "stale, though it is set and not read".to_owned());
        let what = stale.or_else(|| expected.differs(row));
        self.judged.note(what.map(|what| wrong(now_ns, what)));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_set_is_never_stale_and_as_old_as_its_command() {
        let judge = |reported_ns| SilentDeviceJudge {
            id: 20,
            judged: DeviceFindings::new("Motor".to_owned(), None),
            is_well: true,
            reported_ns,
        };
        let row =
            |status, age_ms| DeviceHealth { id: 20, status, age_ms, causes: Causes::default() };
        for (reported_ns, status, age_ms, is_right) in [
            (Some(4_000 * MS), Status::Good, 2_000, true),
            (Some(4_000 * MS), Status::Stale, 2_000, false),
            (Some(4_000 * MS), Status::NeverRead, NEVER_MS, false),
            (Some(4_000 * MS), Status::Good, 4_000, false),
            (Some(5_900 * MS), Status::NeverRead, NEVER_MS, true),
            (None, Status::NeverRead, NEVER_MS, true),
            (None, Status::Stale, 5_000, false),
        ] {
            let mut judge = judge(reported_ns);
            judge.health(6_000 * MS, &row(status, age_ms));
            assert_eq!(judge.judged.wrong == 0, is_right, "{reported_ns:?} {status:?} {age_ms}");
        }
    }

    #[test]
    fn what_a_board_says_of_itself_is_compared_with_what_came() {
        let right = Health {
            uptime_ms: 6_000,
            reset_cause: ResetCause::Power,
            reset_device: 0,
            reports_sent: 100,
            reports_refused: 1,
            load_percent: 20,
            stack_left_bytes: 200,
            devices: Vec::new(),
        };
        let now_ns = 6_000 * MS;
        assert_eq!(board_differs(&right, now_ns, 100), None);
        for wrong in [
            Health { uptime_ms: 600, ..right.clone() },
            Health { uptime_ms: 60_000, ..right.clone() },
            Health { reset_cause: ResetCause::Watchdog, ..right.clone() },
            Health { reset_device: 4, ..right.clone() },
            Health { reports_sent: 50, ..right.clone() },
            Health { reports_sent: 200, ..right.clone() },
            Health { stack_left_bytes: 0, ..right.clone() },
        ] {
            assert!(board_differs(&wrong, now_ns, 100).is_some(), "{wrong:?}");
        }
    }
}
