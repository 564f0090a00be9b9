//! The load of a board's processor, compared with the load that the board reports.

use std::collections::VecDeque;

use sensedsl_wire::Health;

use super::findings::{MS, SECOND};

/// A board reports the greatest load of any window of this length.
const WINDOW_NS: u64 = SECOND;
/// The sampling interval.
const EVERY_NS: u64 = 50 * MS;
/// The tolerance of the reported load: waiting in a loop does not count as work here, and the board's clock ticks in
/// whole steps.
const SLACK_PERCENT: u64 = 10;
/// The value by which a board reports that it does not know its load.
const UNKNOWN: u8 = 255;

/// The record of the processor's work.
#[derive(Clone, Debug, Default)]
pub(super) struct Load {
    past: VecDeque<(u64, u64)>,
    /// The greatest load of a window so far.
    most_percent: u64,
}

impl Load {
    /// Takes the time for which the processor has worked until now.
    pub(super) fn take(&mut self, now_ns: u64, worked_ns: u64) {
        if !now_ns.is_multiple_of(EVERY_NS) {
            return;
        }
        self.past.push_back((now_ns, worked_ns));
        while self.past.front().is_some_and(|(at_ns, _)| at_ns + WINDOW_NS < now_ns) {
            let _ = self.past.pop_front();
        }
        let Some((at_ns, before_ns)) = self.past.front() else { return };
        if at_ns + WINDOW_NS == now_ns {
            let percent = worked_ns.saturating_sub(*before_ns) * 100 / WINDOW_NS;
            self.most_percent = self.most_percent.max(percent);
        }
    }

    /// The error in the board's reported load.
    pub(super) fn differs(&self, health: &Health) -> Option<String> {
        let reported = u64::from(health.load_percent);
        let is_known = health.load_percent != UNKNOWN && self.past.len() > 1;
        let least = self.most_percent.saturating_sub(SLACK_PERCENT);
        let is_right = (least..=self.most_percent + SLACK_PERCENT).contains(&reported);
        (is_known && !is_right).then(|| {
            let most = self.most_percent;
            format!("its processor works {reported} % of the time at most, and it worked {most} %")
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_load_is_compared_with_what_was_worked() {
        let mut load = Load::default();
        for step in 1..=60 {
            // 30 % of the time.
            load.take(step * EVERY_NS, step * EVERY_NS / 10 * 3);
        }
        let reported = |load_percent: u8| Health {
            uptime_ms: 3_000,
            reset_cause: sensedsl_wire::ResetCause::Power,
            reset_device: 0,
            reports_sent: 0,
            reports_refused: 0,
            load_percent,
            stack_left_bytes: 100,
            devices: Vec::new(),
        };
        assert_eq!(load.differs(&reported(30)), None);
        assert_eq!(load.differs(&reported(UNKNOWN)), None);
        assert!(load.differs(&reported(3)).is_some() && load.differs(&reported(100)).is_some());
        assert_eq!(Load::default().differs(&reported(100)), None);
    }
}
