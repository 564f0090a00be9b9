//! A quantity that comes about while the board runs: its values so far, as a plant gives them.
//!
//! In: times and values, in the order of time. Out: the value at a moment, and its range in a span. Whoever holds a copy
//! sees the same course, so that a sensor, its judge and a picture speak of the same truth.

use std::collections::VecDeque;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// The points that are kept: four minutes, if each millisecond is another one.
const KEPT: usize = 1 << 18;
/// A span that ends later than this asks what may ever be.
const EVER_NS: u64 = u64::MAX / 4;

/// The values of a quantity so far, in the sensor's own unit.
#[derive(Clone, Debug)]
pub struct Course(Arc<Mutex<Log>>);

#[derive(Debug)]
struct Log {
    points: VecDeque<(u64, f64)>,
    /// Whether it goes straight from one point to the next instead of jumping.
    is_straight: bool,
    /// The least and the greatest value that it may have; `None` if nothing bounds it.
    bounds: Option<(f64, f64)>,
}

impl PartialEq for Course {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

impl Course {
    /// A course without values; it is 0, or what of its bounds is nearest to that.
    #[must_use]
    pub fn new(is_straight: bool, bounds: Option<(f64, f64)>) -> Self {
        let points = VecDeque::new();
        Self(Arc::new(Mutex::new(Log { points, is_straight, bounds })))
    }

    fn log(&self) -> MutexGuard<'_, Log> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Forgets all values.
    pub(crate) fn clear(&self) {
        self.log().points.clear();
    }

    /// The next value. One at the time of the last one replaces it; an earlier one is dropped.
    pub(crate) fn push(&self, at_ns: u64, value: f64) {
        let mut log = self.log();
        let count = log.points.len();
        let at = |place: usize| log.points.get(place).copied();
        let last = count.checked_sub(1).and_then(at);
        let before = count.checked_sub(2).and_then(at);
        match (before, last) {
            (_, Some((time, _))) if time > at_ns => return,
            (_, Some((time, _))) if time == at_ns => {
                log.points.pop_back();
            }
            // A point between two equal ones tells nothing.
            (Some((_, one)), Some((_, other))) if one == value && other == value => {
                log.points.pop_back();
            }
            (_, _) => {}
        }
        if log.points.len() >= KEPT {
            log.points.pop_front();
        }
        log.points.push_back((at_ns, value));
    }

    /// The value at a moment; after the last point, the value of that one.
    #[must_use]
    pub fn at(&self, now_ns: u64) -> f64 {
        self.log().at(now_ns)
    }

    /// The least and the greatest value in a span of time, both ends included; that it may ever have, if the span has
    /// no end.
    #[must_use]
    pub fn range(&self, from_ns: u64, to_ns: u64) -> (f64, f64) {
        let log = self.log();
        if let Some(bounds) = log.bounds.filter(|_| to_ns > EVER_NS) {
            return bounds;
        }
        let ends = [log.at(from_ns), log.at(to_ns)];
        let mut range = (ends[0].min(ends[1]), ends[0].max(ends[1]));
        let start = log.points.partition_point(|point| point.0 < from_ns);
        let end = log.points.partition_point(|point| point.0 <= to_ns);
        for (_, value) in log.points.range(start..end.max(start)) {
            range = (range.0.min(*value), range.1.max(*value));
        }
        range
    }

    /// The least and the greatest value that it may ever have; `None` if nothing bounds it.
    #[must_use]
    pub fn bounds(&self) -> Option<(f64, f64)> {
        self.log().bounds
    }

    /// The time of its last value.
    #[must_use]
    pub fn end_ns(&self) -> u64 {
        self.log().points.back().map_or(0, |point| point.0)
    }
}

impl Log {
    fn at(&self, now_ns: u64) -> f64 {
        let next = self.points.partition_point(|point| point.0 <= now_ns);
        let before = next.checked_sub(1).and_then(|at| self.points.get(at));
        match (before, self.points.get(next)) {
            (Some(before), Some(after)) if self.is_straight => {
                let (since, all) = (now_ns - before.0, after.0 - before.0);
                let share = crate::arith::number(since) / crate::arith::number(all.max(1));
                before.1 + (after.1 - before.1) * share
            }
            (Some(one), _) | (None, Some(one)) => one.1,
            (None, None) => self.bounds.map_or(0.0, |(least, most)| 0.0_f64.max(least).min(most)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const MS: u64 = 1_000_000;

    #[test]
    fn a_value_is_never_outside_of_the_range_of_its_span() {
        for is_straight in [true, false] {
            let course = Course::new(is_straight, None);
            for step in 0..200_u64 {
                let value = f64::from(u32::try_from(step * 37 % 11).unwrap()) - 5.0;
                course.push(step * MS, value);
            }
            for start in (0..210 * MS).step_by(777_777) {
                for span in [0, 1, MS / 3, MS, 9 * MS] {
                    let (least, greatest) = course.range(start, start + span);
                    for part in 0..=20 {
                        let value = course.at(start + span * part / 20);
                        assert!((least..=greatest).contains(&value), "{start} {span}: {value}");
                    }
                }
            }
        }
    }

    #[test]
    fn what_stands_takes_two_points_and_what_is_past_is_bounded() {
        let course = Course::new(true, Some((-1.0, 9.0)));
        assert_eq!(course.at(5), 0.0);
        (0..1_000).for_each(|step| course.push(step * MS, 3.0));
        assert_eq!(course.log().points.len(), 2);
        course.push(1_000 * MS, 4.0);
        assert_eq!((course.at(999 * MS), course.at(2_000 * MS)), (3.0, 4.0));
        assert_eq!(course.range(0, u64::MAX), (-1.0, 9.0));
        (2_000..2_000 + 2 * KEPT as u64).for_each(|step| course.push(step * MS, step as f64));
        assert_eq!(course.log().points.len(), KEPT);
    }
}
