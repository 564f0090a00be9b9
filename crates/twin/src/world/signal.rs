//! A quantity of the world over time: its value at each moment, and its range in a span.

use super::course::Course;
use crate::arith::{TURN, chance, number, sine};
use crate::commands::track::Track;

/// The time in which noise goes from one value to the next: shorter than any cycle of a device. The noise does not
/// jump, because a wheel cannot and an encoder would miss steps.
const NOISE_NS: u64 = 1_000_000;
/// Nanoseconds of a second.
const SECOND_NS: f64 = 1e9;

/// A quantity over time, in the device's own unit.
#[derive(Clone, Debug, PartialEq)]
pub struct Signal {
    /// Its movement without noise.
    pub shape: Shape,
    /// The greatest deviation caused by noise, up or down.
    pub noise: f64,
    /// The key of its random numbers: different for each quantity and seed.
    pub key: u64,
}

/// The movement of a quantity without noise.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// It stays constant.
    Constant(f64),
    /// It goes from one value to another in a straight line, and stays there.
    Ramp {
        /// At the start.
        from: f64,
        /// At the end.
        to: f64,
        /// The time that this takes.
        over_ns: u64,
    },
    /// It follows a sine.
    Sine {
        /// The middle.
        offset: f64,
        /// The amplitude to either side.
        amplitude: f64,
        /// The period.
        period_ns: u64,
    },
    /// It has one value for half of a period, and another one for the other half.
    Square {
        /// The value at the start.
        first: f64,
        /// The value after half of a period.
        second: f64,
        /// The period, with both values.
        period_ns: u64,
    },
    /// It grows at a constant rate.
    Rate {
        /// The value at the start.
        from: f64,
        /// The growth in a second.
        a_second: f64,
    },
    /// It follows points in the order of time. Before the first point it has the value of that one, after the last
    /// point of the last one.
    Points {
        /// Time and value.
        points: Vec<(u64, f64)>,
        /// Whether it goes straight from one point to the next instead of jumping.
        is_straight: bool,
    },
    /// It follows another shape, and goes somewhere else at the end of each period.
    Visits {
        /// The other shape.
        base: Box<Shape>,
        /// The time from one visit to the next.
        every_ns: u64,
        /// The length of each visit.
        for_ns: u64,
        /// The value during a visit.
        to: Visit,
    },
    /// It is where the board has moved a motor to.
    Walked(Track),
    /// It is what a plant makes of it.
    Followed(Course),
}

/// The value that a quantity has during a visit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Visit {
    /// This value.
    To(f64),
    /// The value of the other shape plus this.
    By(f64),
    /// This minus the value of the other shape: the other one of two values whose sum this is.
    Other(f64),
}

impl Visit {
    fn of(self, value: f64) -> f64 {
        match self {
            Self::To(to) => to,
            Self::By(by) => value + by,
            Self::Other(sum) => sum - value,
        }
    }
}

impl Signal {
    /// A signal without noise.
    #[must_use]
    pub const fn of(shape: Shape) -> Self {
        Self { shape, noise: 0.0, key: 0 }
    }

    /// The value at a moment.
    #[must_use]
    pub fn at(&self, now_ns: u64) -> f64 {
        let value = self.shape.at(now_ns);
        if self.noise == 0.0 {
            return value;
        }
        value + self.noise_at(now_ns)
    }

    fn noise_at(&self, now_ns: u64) -> f64 {
        let piece = now_ns / NOISE_NS;
        let [from, to] = [piece, piece.saturating_add(1)].map(|piece| chance(self.key ^ piece));
        let share = number(now_ns % NOISE_NS) / number(NOISE_NS);
        self.noise * (from + (to - from) * share)
    }

    /// The least and the greatest value in a span of time, both ends included.
    #[must_use]
    pub fn range(&self, from_ns: u64, to_ns: u64) -> (f64, f64) {
        let to_ns = to_ns.max(from_ns);
        let (least, greatest) = self.shape.range(from_ns, to_ns);
        let (below, above) = if self.noise != 0.0 && from_ns / NOISE_NS == to_ns / NOISE_NS {
            ordered(self.noise_at(from_ns), self.noise_at(to_ns))
        } else {
            (-self.noise.abs(), self.noise.abs())
        };
        (least + below, greatest + above)
    }

    /// The least and the greatest value that it ever has; `None` if it has no bounds.
    #[must_use]
    pub fn bounds(&self) -> Option<(f64, f64)> {
        match &self.shape {
            Shape::Rate { a_second, .. } if *a_second != 0.0 => None,
            Shape::Walked(_) => None,
            Shape::Followed(course) => {
                course.bounds().map(|(least, most)| (least - self.noise, most + self.noise))
            }
            Shape::Constant(_)
            | Shape::Ramp { .. }
            | Shape::Sine { .. }
            | Shape::Square { .. }
            | Shape::Rate { .. }
            | Shape::Points { .. }
            | Shape::Visits { .. } => Some(self.range(0, u64::MAX)),
        }
    }

    /// The steepest growth in a second; `None` if it does not grow steadily.
    #[must_use]
    pub fn steepest(&self) -> Option<f64> {
        let a_second = |from: f64, to: f64, ns: u64| (to - from) * SECOND_NS / number(ns.max(1));
        match &self.shape {
            Shape::Rate { a_second, .. } => Some(*a_second),
            Shape::Ramp { from, to, over_ns } => Some(a_second(*from, *to, *over_ns)),
            Shape::Points { points, .. } => points
                .windows(2)
                .filter_map(|pair| match pair {
                    [one, next] => Some(a_second(one.1, next.1, next.0.saturating_sub(one.0))),
                    _ => None,
                })
                .reduce(f64::max),
            Shape::Constant(_)
            | Shape::Sine { .. }
            | Shape::Square { .. }
            | Shape::Visits { .. }
            | Shape::Followed(_)
            | Shape::Walked(_) => None,
        }
    }

    /// The period of a signal that repeats.
    #[must_use]
    pub const fn period_ns(&self) -> Option<u64> {
        match self.shape {
            Shape::Sine { period_ns, .. } | Shape::Square { period_ns, .. } => Some(period_ns),
            Shape::Constant(_)
            | Shape::Ramp { .. }
            | Shape::Rate { .. }
            | Shape::Points { .. }
            | Shape::Visits { .. }
            | Shape::Followed(_)
            | Shape::Walked(_) => None,
        }
    }

    /// The fastest change in a second, up or down, without jumps.
    #[must_use]
    pub fn fastest(&self) -> f64 {
        let a_second = |from: f64, to: f64, ns: u64| ((to - from) / number(ns.max(1))).abs() * 1e9;
        let shape = match &self.shape {
            Shape::Rate { a_second, .. } => a_second.abs(),
            Shape::Ramp { from, to, over_ns } => a_second(*from, *to, *over_ns),
            Shape::Sine { amplitude, period_ns, .. } => {
                a_second(0.0, *amplitude, *period_ns) * std::f64::consts::TAU
            }
            Shape::Points { points, .. } => points
                .windows(2)
                .filter_map(|pair| match pair {
                    [one, next] => Some(a_second(one.1, next.1, next.0.saturating_sub(one.0))),
                    _ => None,
                })
                .fold(0.0, f64::max),
            Shape::Constant(_)
            | Shape::Square { .. }
            | Shape::Visits { .. }
            | Shape::Followed(_)
            | Shape::Walked(_) => 0.0,
        };
        shape + a_second(0.0, 2.0 * self.noise, NOISE_NS)
    }

    /// Whether it ever decreases.
    #[must_use]
    pub fn falls(&self) -> bool {
        match &self.shape {
            Shape::Constant(_) => false,
            Shape::Ramp { from, to, .. } => to < from,
            Shape::Rate { a_second, .. } => *a_second < 0.0,
            Shape::Sine { amplitude, .. } => *amplitude != 0.0,
            Shape::Square { first, second, .. } => first != second,
            Shape::Points { points, .. } => !points.is_sorted_by(|one, next| one.1 <= next.1),
            Shape::Visits { .. } | Shape::Walked(_) | Shape::Followed(_) => true,
        }
    }
}

impl Shape {
    fn at(&self, now_ns: u64) -> f64 {
        match self {
            Self::Constant(value) => *value,
            Self::Ramp { from, to, over_ns } => {
                let share = number(now_ns.min(*over_ns)) / number((*over_ns).max(1));
                from + (to - from) * share
            }
            Self::Sine { offset, amplitude, period_ns } => {
                offset + amplitude * sine(phase(now_ns, *period_ns))
            }
            Self::Square { first, second, period_ns } => {
                if phase(now_ns, *period_ns) < TURN / 2 {
                    *first
                } else {
                    *second
                }
            }
            Self::Rate { from, a_second } => from + a_second * (number(now_ns) / SECOND_NS),
            Self::Points { points, is_straight } => at_points(points, *is_straight, now_ns),
            Self::Visits { base, every_ns, for_ns, to } => {
                let value = base.at(now_ns);
                let is_there = now_ns % (*every_ns).max(1) >= every_ns.saturating_sub(*for_ns);
                if is_there { to.of(value) } else { value }
            }
            Self::Walked(track) => track.at(now_ns),
            Self::Followed(course) => course.at(now_ns),
        }
    }

    fn range(&self, from_ns: u64, to_ns: u64) -> (f64, f64) {
        let mut range = ordered(self.at(from_ns), self.at(to_ns));
        if let Self::Walked(track) = self {
            return track.range(from_ns, to_ns);
        }
        if let Self::Followed(course) = self {
            return course.range(from_ns, to_ns);
        }
        let mut take = |value: f64| range = (range.0.min(value), range.1.max(value));
        match self {
            Self::Constant(_)
            | Self::Ramp { .. }
            | Self::Rate { .. }
            | Self::Walked(_)
            | Self::Followed(_) => {}
            Self::Visits { base, every_ns, for_ns, to } => {
                let every_ns = (*every_ns).max(1);
                let (least, greatest) = base.range(from_ns, to_ns);
                let (begins, ends) = (from_ns / every_ns, to_ns / every_ns);
                let rest_ns = every_ns.saturating_sub(*for_ns);
                let is_there = |at_ns: u64| at_ns % every_ns >= rest_ns;
                let has_none = begins == ends && !is_there(to_ns);
                let has_others = !(begins == ends && is_there(from_ns));
                range = (f64::MAX, f64::MIN);
                let ends = [least, greatest];
                let plain = ends.into_iter().filter(|_| has_others);
                let visited = ends.into_iter().map(|end| to.of(end)).filter(|_| !has_none);
                for end in plain.chain(visited) {
                    range = (range.0.min(end), range.1.max(end));
                }
            }
            Self::Sine { offset, amplitude, period_ns } => {
                let quarter = TURN / 4;
                if passes(from_ns, to_ns, *period_ns, quarter) {
                    take(offset + amplitude);
                }
                if passes(from_ns, to_ns, *period_ns, 3 * quarter) {
                    take(offset - amplitude);
                }
            }
            Self::Square { first, second, period_ns } => {
                if passes(from_ns, to_ns, *period_ns, 0) {
                    take(*first);
                }
                if passes(from_ns, to_ns, *period_ns, TURN / 2) {
                    take(*second);
                }
            }
            Self::Points { points, .. } => {
                let start = points.partition_point(|point| point.0 < from_ns);
                let end = points.partition_point(|point| point.0 <= to_ns);
                points.get(start..end).unwrap_or_default().iter().for_each(|one| take(one.1));
                // A signal that jumps at a point has the value of the point before until then.
                let before = start.checked_sub(1).and_then(|before| points.get(before));
                before.into_iter().for_each(|one| {
                    if matches!(self, Self::Points { is_straight: false, .. }) {
                        take(one.1);
                    }
                });
            }
        }
        range
    }
}

fn ordered(one: f64, other: f64) -> (f64, f64) {
    if one <= other { (one, other) } else { (other, one) }
}

/// The phase of a moment in a period, in units of 2^-32.
fn phase(now_ns: u64, period_ns: u64) -> u64 {
    let period = u128::from(period_ns.max(1));
    let share = (u128::from(now_ns) % period) * u128::from(TURN) / period;
    u64::try_from(share).unwrap_or(0)
}

/// Whether a periodic signal passes a phase in a span of time.
fn passes(from_ns: u64, to_ns: u64, period_ns: u64, at: u64) -> bool {
    let period_ns = period_ns.max(1);
    let offset = u128::from(period_ns) * u128::from(at) / u128::from(TURN);
    let offset = u64::try_from(offset).unwrap_or(0);
    let whole = from_ns.saturating_sub(offset).div_ceil(period_ns);
    whole.checked_mul(period_ns).is_some_and(|start| {
        let next = start.saturating_add(offset);
        next >= from_ns && next <= to_ns
    })
}

fn at_points(points: &[(u64, f64)], is_straight: bool, now_ns: u64) -> f64 {
    let next = points.partition_point(|point| point.0 <= now_ns);
    let (before, after) = (next.checked_sub(1).and_then(|at| points.get(at)), points.get(next));
    match (before, after) {
        (Some(before), Some(after)) if is_straight => {
            let share = number(now_ns - before.0) / number((after.0 - before.0).max(1));
            before.1 + (after.1 - before.1) * share
        }
        (Some(one), _) | (None, Some(one)) => one.1,
        (None, None) => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const S: u64 = 1_000_000_000;

    fn shapes() -> Vec<Shape> {
        let points = vec![(S, 3.0), (2 * S, -1.0), (2 * S + 5, 7.0), (6 * S, 0.5)];
        vec![
            Shape::Constant(3.5),
            Shape::Ramp { from: 1.0, to: -4.0, over_ns: 3 * S },
            Shape::Sine { offset: 2.0, amplitude: 5.0, period_ns: 3 * S },
            Shape::Square { first: 1.0, second: 4.0, period_ns: S },
            Shape::Rate { from: 10.0, a_second: 2.5 },
            Shape::Points { points: points.clone(), is_straight: true },
            Shape::Points { points, is_straight: false },
        ]
    }

    #[test]
    fn a_value_is_never_outside_of_the_range_of_its_span() {
        for shape in shapes() {
            for noise in [0.0, 0.25] {
                let signal = Signal { shape: shape.clone(), noise, key: 7 };
                for start in (0..8 * S).step_by(333_000_007) {
                    for span in [0, 1, S / 7, S, 4 * S] {
                        let (least, greatest) = signal.range(start, start + span);
                        for step in 0..=50 {
                            let value = signal.at(start + span * step / 50);
                            let within = value >= least - 1e-9 && value <= greatest + 1e-9;
                            assert!(within, "{signal:?} {start} {span}: {value}");
                        }
                    }
                }
            }
        }
    }

    #[test]
    fn a_range_is_no_wider_than_what_there_is() {
        for shape in shapes() {
            let signal = Signal::of(shape);
            for start in (0..8 * S).step_by(333_000_007) {
                let values = (0..=10_000).map(|step| signal.at(start + S * step / 10_000));
                let seen = values.fold((f64::MAX, f64::MIN), |(l, g), v| (l.min(v), g.max(v)));
                let (least, greatest) = signal.range(start, start + S);
                assert!(
                    seen.0 - least < 0.6 && greatest - seen.1 < 0.6
                        || matches!(signal.shape, Shape::Points { .. }),
                    "{signal:?} at {start}: {seen:?} {least} {greatest}"
                );
            }
        }
    }

    #[test]
    fn noise_is_the_same_for_the_same_seed_alone() {
        let of = |key| Signal { shape: Shape::Constant(0.0), noise: 1.0, key };
        let run = |key| (0..100).map(|ms| of(key).at(ms * 1_000_000)).collect::<Vec<_>>();
        assert_eq!(run(3), run(3));
        assert_ne!(run(3), run(4));
    }
}
