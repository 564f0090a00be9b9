//! What a contact is for only a little longer than it must last: it must be told now and then.
//!
//! In: the values that came. Out: how often the world has such a moment, where none of them was ever told. A contact
//! that must last for longer in the firmware than in the file never sees them, and nothing else shows it.

use sensedsl_job::{BoardJob, JobDevice};
use sensedsl_model::design::Device;
use sensedsl_wire::ScalarType;

use super::pace::reporter_ns;
use super::{Finding, Wrong};
use crate::arith::number;
use crate::parts::line::{Spikes, levels};
use crate::truth::Subject;

/// So many must be seen by the file for it to be wrong that none is.
const SEEN_MIN: f64 = 4.0;

/// The values of a contact.
#[derive(Clone, Debug)]
pub(super) struct Pressed {
    lasting_ns: u64,
    spikes: Spikes,
    /// From one look at its wire to the next; 0 where its edges interrupt.
    look_ns: u64,
    /// From one value to the next; 0 where each change is told.
    delay_ns: u64,
    /// Since when each element is what it is, on or off.
    told: Vec<Vec<(u64, bool)>>,
}

impl Pressed {
    /// The one of a contact that must last; none of others.
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
            told: vec![Vec::new(); device.value.value.count()],
        })
    }

    /// A value has come.
    pub(super) fn take(&mut self, now_ns: u64, raw: &[f64]) {
        for (told, raw) in self.told.iter_mut().zip(raw) {
            let level = *raw >= 0.5;
            if told.last().is_none_or(|(_, before)| *before != level) {
                told.push((now_ns, level));
            }
        }
    }

    /// Whether none was told of all that ought to be seen from a time on, each within so much time.
    pub(super) fn differs(
        &self,
        subject: &Subject,
        (from_ns, now_ns): (u64, u64),
        age_ns: u64,
    ) -> Option<Wrong> {
        let (mut count, mut seen) = (0_u64, 0.0);
        for (element, told) in self.told.iter().enumerate() {
            let levels = levels(subject, element, from_ns, now_ns);
            for window in levels.windows(4) {
                let &[(before_ns, _), (start_ns, level), (end_ns, _), (next_ns, _)] = window else {
                    continue;
                };
                let is_alone = start_ns - before_ns > age_ns && next_ns - end_ns > age_ns;
                if !is_alone || !self.is_short(start_ns, end_ns) {
                    continue;
                }
                let is_told = |(at_ns, what): &(u64, bool)| {
                    *what == level && (start_ns..=end_ns + age_ns).contains(at_ns)
                };
                if told.iter().any(is_told) {
                    return None;
                }
                count += 1;
                seen += self.share(end_ns - start_ns);
            }
        }
        let finding = Finding::Unseen { count, lasting_ns: self.lasting_ns };
        (seen >= SEEN_MIN).then_some(Wrong { at_ns: now_ns, finding, off: 1_000.0 })
    }

    /// Whether a level lasts for longer than it must, and not for twice as long; nothing disturbs it.
    fn is_short(&self, start_ns: u64, end_ns: u64) -> bool {
        let for_ns = end_ns - start_ns;
        let is_long_enough = for_ns > self.lasting_ns + self.lasting_ns / 20 + self.look_ns;
        let spare_ns = self.lasting_ns + self.look_ns;
        let is_disturbed =
            self.spikes.is_within(start_ns.saturating_sub(spare_ns), end_ns + spare_ns);
        is_long_enough && for_ns < 2 * self.lasting_ns && !is_disturbed
    }

    /// How likely it is that a level of that length meets a value.
    fn share(&self, for_ns: u64) -> f64 {
        let sure_ns = for_ns - self.look_ns.min(for_ns);
        number(sure_ns) / number(self.delay_ns.max(sure_ns).max(1))
    }
}
