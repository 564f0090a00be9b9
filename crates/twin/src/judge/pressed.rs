//! Changes of a contact that last only a little longer than its debounce time: some of them must be reported.
//!
//! In: the reported values. Out: how often the world has such a change, if none of them was ever reported. A contact
//! whose debounce time in the firmware is longer than in the file never sees them, and nothing else shows that.

use sensedsl_job::{BoardJob, JobDevice};
use sensedsl_model::design::Device;
use sensedsl_wire::ScalarType;

use super::findings::{Disagreement, Finding};
use super::pace::reporter_ns;
use crate::arith::number;
use crate::parts::line::{Spikes, levels};
use crate::truth::Subject;

/// It is a finding that no change is reported only if at least this many must be seen according to the file.
const SEEN_MIN: f64 = 4.0;

/// The values of a contact.
#[derive(Clone, Debug)]
pub(super) struct ContactValues {
    lasting_ns: u64,
    spikes: Spikes,
    /// The time from one sample of its wire to the next; 0 if its edges interrupt.
    look_ns: u64,
    /// The time from one value to the next; 0 if each change is reported.
    delay_ns: u64,
    /// For each element, its changes so far: the time, and whether it was on from then.
    reported: Vec<Vec<(u64, bool)>>,
}

impl ContactValues {
    /// The state for a contact with a debounce time; `None` for any other device.
    pub(super) fn of(job: &BoardJob<'_>, one: &JobDevice<'_>) -> Option<Self> {
        let device: &Device = one.device;
        let own = device.kind.digital()?;
        let is_level = device.value.value.scalar == ScalarType::Bool;
        if own.debounce_us == 0 || !is_level {
            return None;
        }
        let lasting_ns = 1_000 * u64::from(own.debounce_us);
        let is_looked_at = own.edge.is_none();
        let delay_ns = 1_000_000 * u64::from(one.cycle.delay_ms.max(device.delay_ms));
        Some(Self {
            lasting_ns,
            spikes: Spikes::below(lasting_ns),
            look_ns: if is_looked_at { reporter_ns(job) } else { 0 },
            delay_ns: if is_looked_at { delay_ns } else { 0 },
            reported: vec![Vec::new(); device.value.value.count()],
        })
    }

    /// A value has come.
    pub(super) fn take(&mut self, now_ns: u64, raw: &[f64]) {
        for (reported, raw) in self.reported.iter_mut().zip(raw) {
            let level = *raw >= 0.5;
            if reported.last().is_none_or(|(_, before)| *before != level) {
                reported.push((now_ns, level));
            }
        }
    }

    /// The finding if none of the changes that should be seen in a span was reported; each must be within the given
    /// age.
    pub(super) fn differs(
        &self,
        subject: &Subject,
        (from_ns, now_ns): (u64, u64),
        age_ns: u64,
    ) -> Option<Disagreement> {
        let (mut count, mut seen) = (0_u64, 0.0);
        for (element, reported) in self.reported.iter().enumerate() {
            let levels = levels(subject, element, from_ns, now_ns);
            for window in levels.windows(4) {
                let &[(before_ns, _), (start_ns, level), (end_ns, _), (next_ns, _)] = window else {
                    continue;
                };
                let is_alone = start_ns - before_ns > age_ns && next_ns - end_ns > age_ns;
                if !is_alone || !self.is_short(start_ns, end_ns) {
                    continue;
                }
                let is_reported = |(at_ns, what): &(u64, bool)| {
                    *what == level && (start_ns..=end_ns + age_ns).contains(at_ns)
                };
                if reported.iter().any(is_reported) {
                    return None;
                }
                count += 1;
                seen += self.share(end_ns - start_ns);
            }
        }
        let finding = Finding::Unseen { count, lasting_ns: self.lasting_ns };
        (seen >= SEEN_MIN).then_some(Disagreement { at_ns: now_ns, finding, off: 1_000.0 })
    }

    /// Whether a level lasts longer than the debounce time but less than twice as long, and nothing disturbs it.
    fn is_short(&self, start_ns: u64, end_ns: u64) -> bool {
        let for_ns = end_ns - start_ns;
        let is_long_enough = for_ns > self.lasting_ns + self.lasting_ns / 20 + self.look_ns;
        let spare_ns = self.lasting_ns + self.look_ns;
        let is_disturbed =
            self.spikes.is_within(start_ns.saturating_sub(spare_ns), end_ns + spare_ns);
        is_long_enough && for_ns < 2 * self.lasting_ns && !is_disturbed
    }

    /// The probability that a level of that length coincides with a value.
    fn share(&self, for_ns: u64) -> f64 {
        let sure_ns = for_ns - self.look_ns.min(for_ns);
        number(sure_ns) / number(self.delay_ns.max(sure_ns).max(1))
    }
}
