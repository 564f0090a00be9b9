//! The effect of `median` and `smooth`: the range in which a filtered value can be, from what the world was.
//!
//! Both filters are monotonic: greater samples never give a smaller value. So the filter's result for the least samples
//! possible is a lower bound, and that for the greatest ones an upper bound.

use std::collections::VecDeque;

use super::findings::MS;
use crate::arith::{decay, number};
use crate::truth::Subject;

/// The step in which a low-pass is followed.
const STEP_NS: u64 = MS;
/// A low-pass remembers no more than this many of its time constants.
const REMEMBERED: u64 = 8;
/// The most by which a sample may be early or late.
const JITTER_NS: u64 = 2 * MS;
/// The rounding of an integer low-pass, as a fraction of the range that it has seen.
const ROUNDED: f64 = 0.002;

/// The filters of a device.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Shape {
    /// The number of samples that the median is taken of; 0 for none.
    pub(super) median: u8,
    /// The time constant of the low-pass; 0 for none.
    pub(super) smooth_ns: u64,
    /// The greatest age of an unfiltered value.
    pub(super) age_ns: u64,
    /// The longest time from one sample to the next.
    pub(super) cycle_ns: u64,
    /// Whether the time between samples is within a tenth of their cycle.
    pub(super) is_regular: bool,
    /// The range of measurable values.
    pub(super) bounds: Option<(f64, f64)>,
}

impl Shape {
    /// Whether a value is reported as it is measured.
    pub(super) const fn is_plain(&self) -> bool {
        self.median < 2 && self.smooth_ns == 0
    }

    /// How long a filter must be fed before its result can be predicted.
    pub(super) fn settles_ns(&self) -> u64 {
        (u64::from(self.median) + 1) * self.cycle_ns + self.age_ns
    }

    /// The range of values that can be measured in a span of time.
    pub(super) fn range(
        &self,
        subject: &Subject,
        element: usize,
        from_ns: u64,
        to_ns: u64,
    ) -> (f64, f64) {
        let (least, greatest) = subject.raw_range(element, from_ns, to_ns);
        let within =
            |end: f64| self.bounds.map_or(end, |(low, high)| end.clamp(low, high.max(low)));
        (within(least), within(greatest))
    }

    /// The range of the median of samples, the last of which was taken between two moments.
    fn median(
        &self,
        subject: &Subject,
        element: usize,
        (from_ns, to_ns): (u64, u64),
    ) -> (f64, f64) {
        let count = u64::from(self.median);
        let step_ns = (self.cycle_ns / 8).max(MS);
        let slack_ns = step_ns / 2 + JITTER_NS + self.cycle_ns / 10;
        let mut range = (f64::MAX, f64::MIN);
        let mut last_ns = from_ns;
        while last_ns < to_ns.saturating_add(step_ns) {
            let sample = |place: u64| {
                let at_ns = last_ns.saturating_sub(place * self.cycle_ns);
                self.range(subject, element, at_ns.saturating_sub(slack_ns), at_ns + slack_ns)
            };
            let samples: Vec<(f64, f64)> = (0..count).map(sample).collect();
            let least = middle(samples.iter().map(|one| one.0).collect());
            let greatest = middle(samples.iter().map(|one| one.1).collect());
            range = (range.0.min(least), range.1.max(greatest));
            last_ns += step_ns;
        }
        range
    }

    /// The range of a sample, or of the median of the last ones, taken between two moments.
    fn sample(
        &self,
        subject: &Subject,
        element: usize,
        (from_ns, to_ns): (u64, u64),
    ) -> (f64, f64) {
        let early_ns = from_ns.saturating_sub(self.age_ns);
        if self.median < 2 {
            return self.range(subject, element, early_ns, to_ns);
        }
        if !self.is_regular || self.smooth_ns > 0 {
            let older_ns = u64::from(self.median) * self.cycle_ns;
            return self.range(subject, element, early_ns.saturating_sub(older_ns), to_ns);
        }
        self.median(subject, element, (early_ns, to_ns))
    }
}

fn middle(mut all: Vec<f64>) -> f64 {
    all.sort_by(f64::total_cmp);
    all.get(all.len().saturating_sub(1) / 2).copied().unwrap_or(0.0)
}

/// The state of the filters of one element.
#[derive(Clone, Debug, Default)]
pub(super) struct Filtered {
    /// The least and the greatest value of the low-pass, for each step that may still be reported.
    past: VecDeque<(f64, f64)>,
    at_ns: u64,
    /// The least and the greatest number that it has seen.
    seen: Option<(f64, f64)>,
}

impl Filtered {
    /// Forgets everything.
    pub(super) fn forget(&mut self) {
        self.past.clear();
    }

    /// The range of the values that can be reported now, and what rounding adds to it. `since_ns` is the time since
    /// which the filter has certainly been fed.
    pub(super) fn expected(
        &mut self,
        shape: &Shape,
        subject: &Subject,
        element: usize,
        (since_ns, now_ns): (u64, u64),
    ) -> (f64, f64, f64) {
        let has_settled = now_ns.saturating_sub(since_ns) > shape.settles_ns();
        if shape.smooth_ns == 0 {
            if has_settled {
                let (least, greatest) = shape.sample(subject, element, (now_ns, now_ns));
                return (least, greatest, 0.0);
            }
            let older_ns = now_ns.saturating_sub(shape.settles_ns()).min(since_ns);
            let (least, greatest) = shape.range(subject, element, older_ns, now_ns);
            return (least, greatest, 0.0);
        }
        if self.past.is_empty() {
            let older_ns = now_ns.saturating_sub(REMEMBERED * shape.smooth_ns + shape.settles_ns());
            let hull = shape.range(subject, element, older_ns.min(since_ns), now_ns);
            self.past.push_back(hull);
            self.at_ns = now_ns;
        }
        self.follow(shape, subject, element, now_ns);
        let all = self.past.iter();
        let (least, greatest) =
            all.fold((f64::MAX, f64::MIN), |(l, g), one| (l.min(one.0), g.max(one.1)));
        let width = self.seen.map_or(0.0, |(least, greatest)| greatest - least);
        (least, greatest, 1.0 + ROUNDED * width)
    }

    /// Follows the filter up to now.
    fn follow(&mut self, shape: &Shape, subject: &Subject, element: usize, now_ns: u64) {
        let kept = usize::try_from(shape.age_ns / STEP_NS + 2).unwrap_or(usize::MAX);
        let left = decay(number(STEP_NS) / number(shape.smooth_ns.max(1)));
        while self.at_ns < now_ns {
            self.at_ns += STEP_NS;
            let span = (self.at_ns, self.at_ns + shape.cycle_ns + JITTER_NS);
            let (least, greatest) = shape.sample(subject, element, span);
            let seen = self.seen.unwrap_or((least, greatest));
            self.seen = Some((seen.0.min(least), seen.1.max(greatest)));
            let before = self.past.back().copied().unwrap_or((least, greatest));
            let next = (least + (before.0 - least) * left, greatest + (before.1 - greatest) * left);
            self.past.push_back(next);
            while self.past.len() > kept {
                let _ = self.past.pop_front();
            }
        }
    }
}
