//! Rules: what must hold in a run, whether it did, and by how much.

use crate::evaluate::{evaluate, eventually};
use crate::formula::Formula;
use crate::steps::{Steps, Truth};
use crate::trace::Trace;

/// What a rule asks.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// The formula holds at all times.
    Always(Formula),
    /// The formula holds at no time.
    Never(Formula),
    /// The formula holds at some time, at most so many nanoseconds after the rule begins.
    Eventually(Formula, Option<u64>),
    /// Whenever the first one holds, the second one holds at some time of the next nanoseconds, or at once.
    When(Formula, Formula, Option<u64>),
}

/// A rule, and the part of the run that it is about.
#[derive(Clone, Debug, PartialEq)]
pub struct Rule {
    /// What it asks.
    pub shape: Shape,
    /// Where it begins, in nanoseconds.
    pub from_ns: u64,
    /// Where it ends, the end included; at the end of the run unless given.
    pub to_ns: Option<u64>,
}

/// Whether a rule held.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// It did, at all times that are known.
    Held,
    /// It did not.
    Violated {
        /// The first moment at which it did not.
        at_ns: u64,
        /// How much later than asked it came; `None` if it never came, or if no time was asked.
        late_ns: Option<u64>,
    },
    /// Nothing that it is about is known: a signal never had a value, or the run is too short.
    Unknown,
}

/// What came of a rule.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outcome {
    /// Whether it held.
    pub verdict: Verdict,
    /// The smallest distance from a violation, in the unit of what is compared; negative if it was violated, infinite if
    /// it was about nothing.
    pub robustness: f64,
    /// Of a rule with a time, the least that was left of it.
    pub spare_ns: Option<u64>,
    /// How often the condition of a `when` became true; 1 for other rules.
    pub occasions: usize,
    /// How often the run ended before it was clear.
    pub open: usize,
}

impl Shape {
    /// Calls back with the number of each signal in it.
    pub fn for_each_signal(&self, seen: &mut dyn FnMut(usize)) {
        match self {
            Self::Always(one) | Self::Never(one) | Self::Eventually(one, _) => {
                one.for_each_signal(seen);
            }
            Self::When(condition, then, _) => {
                condition.for_each_signal(seen);
                then.for_each_signal(seen);
            }
        }
    }
}

impl Rule {
    /// Judges a run.
    #[must_use]
    pub fn judge(&self, trace: &Trace) -> Outcome {
        let to_ns = self.to_ns.unwrap_or(trace.end_ns).min(trace.end_ns);
        match &self.shape {
            Shape::Always(one) => self.always(&evaluate(one, trace), to_ns),
            Shape::Never(one) => {
                self.always(&evaluate(&Formula::Not(Box::new(one.clone())), trace), to_ns)
            }
            Shape::Eventually(one, within_ns) => {
                self.eventually(&evaluate(one, trace), *within_ns, to_ns, trace.end_ns)
            }
            Shape::When(condition, then, within_ns) => {
                let (condition, then) = (evaluate(condition, trace), evaluate(then, trace));
                self.when(&condition, &then, within_ns.unwrap_or(0), to_ns)
            }
        }
    }

    fn always(&self, of: &Steps<Truth>, to_ns: u64) -> Outcome {
        let mut outcome = UNKNOWN;
        for (_, truth, at_ns) in within(of, self.from_ns, to_ns) {
            outcome.see(truth);
            if !truth.holds {
                outcome.violated(at_ns, None);
            }
        }
        outcome
    }

    fn eventually(
        &self,
        of: &Steps<Truth>,
        within_ns: Option<u64>,
        to_ns: u64,
        end_ns: u64,
    ) -> Outcome {
        let last_ns = within_ns.map_or(to_ns, |within_ns| self.from_ns.saturating_add(within_ns));
        let mut best: Option<f64> = None;
        let mut first = None;
        for (_, truth, at_ns) in within(of, self.from_ns, last_ns.min(end_ns)) {
            best = Some(best.map_or(truth.robustness, |best| best.max(truth.robustness)));
            if truth.holds && first.is_none() {
                first = Some(at_ns);
            }
        }
        let Some(robustness) = best else { return UNKNOWN };
        let mut outcome = Outcome { robustness, occasions: 1, ..UNKNOWN };
        match first {
            Some(at_ns) => {
                outcome.verdict = Verdict::Held;
                outcome.spare_ns = within_ns.map(|_| last_ns.saturating_sub(at_ns));
            }
            None if last_ns > end_ns => outcome.open = 1,
            None => {
                let later = of.spans().find(|span| span.0 > last_ns && span.2.holds);
                let late_ns = later.filter(|_| within_ns.is_some()).map(|span| span.0 - last_ns);
                outcome.verdict = Verdict::Violated { at_ns: last_ns, late_ns };
            }
        }
        outcome
    }

    fn when(
        &self,
        condition: &Steps<Truth>,
        then: &Steps<Truth>,
        within_ns: u64,
        to_ns: u64,
    ) -> Outcome {
        let holding = answers(then);
        let mut outcome = Outcome { occasions: 0, ..UNKNOWN };
        // Whoever asks when it no longer holds waits longest, so its pieces count as well.
        let soon = eventually(then, 0, within_ns).join(then, |soon, _| soon);
        let both = condition.join(&soon, |condition, soon| (condition, soon));
        for (_, (condition, soon), at_ns) in within(&both, self.from_ns, to_ns) {
            let truth = Truth {
                robustness: (-condition.robustness).max(soon.robustness),
                holds: !condition.holds || soon.holds,
            };
            outcome.see(truth);
            if !condition.holds {
                continue;
            }
            let waited_ns = next(&holding, at_ns).map(|came_ns| came_ns - at_ns);
            if truth.holds {
                if let Some(waited_ns) = waited_ns {
                    let spare_ns = within_ns.saturating_sub(waited_ns);
                    let least_ns = outcome.spare_ns.map_or(spare_ns, |least| least.min(spare_ns));
                    outcome.spare_ns = Some(least_ns);
                }
            } else {
                let late_ns = waited_ns.map(|waited_ns| waited_ns.saturating_sub(within_ns));
                outcome.violated(at_ns, late_ns.filter(|_| within_ns > 0));
            }
        }
        outcome.occasions = occasions(condition, self.from_ns, to_ns);
        outcome.open = open(condition, &both, &holding, self.from_ns, to_ns);
        if within_ns == 0 {
            outcome.spare_ns = None;
        }
        outcome
    }
}

const UNKNOWN: Outcome = Outcome {
    verdict: Verdict::Unknown,
    robustness: f64::INFINITY,
    spare_ns: None,
    occasions: 1,
    open: 0,
};

impl Outcome {
    fn see(&mut self, truth: Truth) {
        if self.verdict == Verdict::Unknown {
            self.verdict = Verdict::Held;
        }
        self.robustness = self.robustness.min(truth.robustness);
    }

    /// The first violation counts.
    fn violated(&mut self, at_ns: u64, late_ns: Option<u64>) {
        if self.verdict == Verdict::Held {
            self.verdict = Verdict::Violated { at_ns, late_ns };
        }
    }
}

/// The pieces of a function in a part of the run: where each ends, its value, and its first moment there.
fn within<V: Copy>(
    of: &Steps<V>,
    from_ns: u64,
    to_ns: u64,
) -> impl Iterator<Item = (u64, V, u64)> + '_ {
    // The piece before one that begins at the very end stops there as well, and does not include it.
    let last_ns = of.pieces.last().map(|piece| piece.0);
    of.spans().filter_map(move |(begin_ns, stop_ns, value)| {
        let is_last = Some(begin_ns) == last_ns;
        let at_ns = begin_ns.max(from_ns);
        let is_inside = at_ns <= to_ns && (at_ns < stop_ns || (is_last && at_ns == stop_ns));
        is_inside.then_some((stop_ns, value, at_ns))
    })
}

/// The spans in which something holds, their ends excluded.
fn answers(of: &Steps<Truth>) -> Vec<(u64, u64)> {
    let last_ns = of.pieces.last().map(|piece| piece.0);
    let is_last = |begin_ns: u64| Some(begin_ns) == last_ns;
    let end = |begin_ns, stop_ns: u64| stop_ns.saturating_add(u64::from(is_last(begin_ns)));
    of.spans().filter(|span| span.2.holds).map(|span| (span.0, end(span.0, span.1))).collect()
}

/// The first moment at or after `at_ns` that lies in a span.
fn next(spans: &[(u64, u64)], at_ns: u64) -> Option<u64> {
    let index = spans.partition_point(|span| span.1 <= at_ns);
    spans.get(index).map(|span| span.0.max(at_ns))
}

/// How often a condition becomes true in a part of the run.
fn occasions(of: &Steps<Truth>, from_ns: u64, to_ns: u64) -> usize {
    let mut count = 0;
    let mut before = false;
    for (_, truth, _) in within(of, from_ns, to_ns) {
        count += usize::from(truth.holds && !before);
        before = truth.holds;
    }
    count
}

/// How many times a condition holds for which nothing has come when the run ends.
fn open<V: Copy>(
    condition: &Steps<Truth>,
    known: &Steps<V>,
    holding: &[(u64, u64)],
    from_ns: u64,
    to_ns: u64,
) -> usize {
    let known_ns = if known.pieces.is_empty() { None } else { Some(known.end_ns) };
    let first_ns = known_ns.map_or(from_ns, |known_ns| from_ns.max(known_ns.saturating_add(1)));
    let mut count = 0;
    let mut before = false;
    for (_, truth, at_ns) in within(condition, first_ns, to_ns) {
        let is_open = truth.holds && next(holding, at_ns).is_none();
        count += usize::from(is_open && !before);
        before = is_open;
    }
    count
}
