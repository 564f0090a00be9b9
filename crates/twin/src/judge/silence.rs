//! Silences, and the events in the world that explain them.
//!
//! A device is silent if the world gives it nothing to report: a value that is `invalid` or has not changed by
//! `change`, a capture without pulses, a fault. All this is computed from the world, piece by piece; the silence that
//! remains must not be longer than a few cycles.

use sensedsl_model::kind::icu::Icu;
use sensedsl_model::protocol::Filter;

use super::findings::MS;
use crate::parts::pulses;
use crate::truth::Subject;

/// The number of pieces that a gap is cut into.
const PIECES: u64 = 4;
/// The greatest number of pieces that are checked.
const PIECES_MAX: u64 = 4_000;

/// The possible explanations of a silence.
#[derive(Clone, Debug)]
pub(super) struct Reasons {
    pub(super) filter: Filter,
    /// The settings of a capture that does not count.
    pub(super) icu: Option<Icu>,
    /// By how much a correct value can be off.
    pub(super) tolerance: f64,
    /// The greatest age of a value.
    pub(super) age_ns: u64,
}

impl Reasons {
    /// The time since which a device that last reported at `from_ns` has been silent, without the silence that the
    /// world explains.
    pub(super) fn unexplained_since(
        &self,
        subject: &Subject,
        span: (u64, u64),
        gap_ns: u64,
        last: &[f64],
        faults: &dyn Fn(u64, u64) -> bool,
    ) -> u64 {
        let (from_ns, now_ns) = span;
        let piece_ns = (gap_ns / PIECES).max(MS).max((now_ns - from_ns) / PIECES_MAX);
        let mut since_ns = from_ns;
        let mut at_ns = from_ns;
        while at_ns < now_ns {
            let end_ns = (at_ns + piece_ns).min(now_ns);
            let is_still = self.is_still(subject, (at_ns, end_ns), end_ns - from_ns, last);
            if is_still || self.is_mute(subject, (at_ns, end_ns)) || faults(at_ns, end_ns) {
                since_ns = end_ns;
            }
            at_ns = end_ns;
        }
        since_ns
    }

    /// How much of a span the world gives the device something to report.
    pub(super) fn reportable_ns(
        &self,
        subject: &Subject,
        (from_ns, now_ns): (u64, u64),
        faults: &dyn Fn(u64, u64) -> bool,
    ) -> u64 {
        let piece_ns = (20 * MS).max(now_ns.saturating_sub(from_ns) / PIECES_MAX);
        let (mut at_ns, mut sum_ns) = (from_ns, 0);
        while at_ns < now_ns {
            let end_ns = (at_ns + piece_ns).min(now_ns);
            if !self.is_mute(subject, (at_ns, end_ns)) && !faults(at_ns, end_ns) {
                sum_ns += end_ns - at_ns;
            }
            at_ns = end_ns;
        }
        sum_ns
    }

    /// Whether it may be that nothing measured in a span is reported.
    pub(super) fn is_mute(&self, subject: &Subject, (from_ns, to_ns): (u64, u64)) -> bool {
        let early_ns = from_ns.saturating_sub(self.age_ns);
        let has_no_pulses = self
            .icu
            .as_ref()
            .is_some_and(|icu| pulses::apart(icu, subject, early_ns, to_ns).is_none());
        has_no_pulses || self.may_be_invalid(subject, early_ns, to_ns)
    }

    /// Whether an element may have had an invalid raw number.
    pub(super) fn may_be_invalid(&self, subject: &Subject, from_ns: u64, to_ns: u64) -> bool {
        !self.filter.invalid.is_empty()
            && (0..subject.signals.len()).any(|element| {
                let (least, greatest) = subject.raw_range(element, from_ns, to_ns);
                let hits = |(low, high): &(f64, f64)| {
                    *low <= greatest + self.tolerance && least - self.tolerance <= *high
                };
                self.filter.invalid.iter().any(hits)
            })
    }

    /// Whether all elements may have stayed so close to the last reported value that it is not reported again.
    fn is_still(
        &self,
        subject: &Subject,
        (from_ns, to_ns): (u64, u64),
        silent_ns: u64,
        last: &[f64],
    ) -> bool {
        let Some(change) = self.filter.change else { return false };
        let heartbeat_ns = MS * u64::from(self.filter.heartbeat_ms);
        if last.is_empty() || (heartbeat_ns > 0 && silent_ns > heartbeat_ns) {
            return false;
        }
        let early_ns = from_ns.saturating_sub(self.age_ns);
        last.iter().enumerate().all(|(element, last)| {
            let (least, greatest) = subject.raw_range(element, early_ns, to_ns);
            let distance = (least - last).max(last - greatest);
            distance - self.tolerance < change
        })
    }
}
