//! What terms and formulas are worth at each moment of a trace.

use crate::formula::{Compare, Formula, Term};
use crate::steps::{Steps, Truth};
use crate::trace::Trace;
use crate::window::least;

/// The values of a term, from the first moment at which all its signals have one.
#[must_use]
pub fn values(term: &Term, trace: &Trace) -> Steps<f64> {
    let two = |one: &Term, other: &Term, of: fn(f64, f64) -> f64| {
        values(one, trace).join(&values(other, trace), of)
    };
    match term {
        Term::Signal(number) => signal(*number, trace),
        Term::Number(value) => Steps { pieces: vec![(0, *value)], end_ns: trace.end_ns },
        Term::Negative(one) => values(one, trace).map(|value| -value),
        Term::Absolute(one) => values(one, trace).map(f64::abs),
        Term::Sum(one, other) => two(one, other, |one, other| one + other),
        Term::Difference(one, other) => two(one, other, |one, other| one - other),
        Term::Product(one, other) => two(one, other, |one, other| one * other),
        Term::Quotient(one, other) => {
            two(one, other, |one, other| if other == 0.0 { f64::NAN } else { one / other })
        }
        Term::Least(one, other) => two(one, other, f64::min),
        Term::Greatest(one, other) => two(one, other, f64::max),
    }
}

fn signal(number: usize, trace: &Trace) -> Steps<f64> {
    let samples = trace.signals.get(number).map_or(&[][..], |signal| &signal.samples);
    let mut pieces: Vec<(u64, f64)> = Vec::with_capacity(samples.len());
    for sample in samples.iter().filter(|sample| sample.0 <= trace.end_ns) {
        match pieces.last_mut() {
            Some(last) if last.0 >= sample.0 => last.1 = sample.1,
            Some(_) | None => pieces.push(*sample),
        }
    }
    Steps { pieces, end_ns: trace.end_ns }
}

/// What a formula is worth, where it is known.
#[must_use]
pub fn evaluate(formula: &Formula, trace: &Trace) -> Steps<Truth> {
    match formula {
        Formula::Compare(one, how, other) => {
            values(one, trace).join(&values(other, trace), |one, other| compare(one, *how, other))
        }
        Formula::Not(one) => evaluate(one, trace).map(not),
        Formula::And(one, other) => evaluate(one, trace).join(&evaluate(other, trace), and),
        Formula::Or(one, other) => evaluate(one, trace).join(&evaluate(other, trace), or),
        Formula::Implies(one, other) => {
            evaluate(one, trace).join(&evaluate(other, trace), |one, other| or(not(one), other))
        }
        Formula::Rising(one) => rising(&evaluate(one, trace)),
        Formula::Always(from_ns, to_ns, one) => always(&evaluate(one, trace), *from_ns, *to_ns),
        Formula::Eventually(from_ns, to_ns, one) => {
            eventually(&evaluate(one, trace), *from_ns, *to_ns)
        }
    }
}

/// The comparison of two numbers. With something that is not a number none holds.
fn compare(one: f64, how: Compare, other: f64) -> Truth {
    if one.is_nan() || other.is_nan() {
        return Truth { robustness: f64::NEG_INFINITY, holds: false };
    }
    let (robustness, holds) = match how {
        Compare::Less => (other - one, one < other),
        Compare::AtMost => (other - one, one <= other),
        Compare::Greater => (one - other, one > other),
        Compare::AtLeast => (one - other, one >= other),
        Compare::Equal => (-(one - other).abs(), one == other),
        Compare::Unequal => ((one - other).abs(), one != other),
    };
    Truth { robustness, holds }
}

fn not(one: Truth) -> Truth {
    Truth { robustness: -one.robustness, holds: !one.holds }
}

fn and(one: Truth, other: Truth) -> Truth {
    let robustness = one.robustness.min(other.robustness);
    Truth { robustness, holds: one.holds && other.holds }
}

fn or(one: Truth, other: Truth) -> Truth {
    not(and(not(one), not(other)))
}

fn rising(of: &Steps<Truth>) -> Steps<Truth> {
    // What was before the first sample nobody knows: nothing has risen yet.
    let mut before = Truth { robustness: f64::INFINITY, holds: true };
    let mut pieces = Vec::with_capacity(of.pieces.len());
    for (at_ns, now) in &of.pieces {
        pieces.push((*at_ns, and(*now, not(before))));
        before = *now;
    }
    Steps { pieces, end_ns: of.end_ns }
}

fn always(of: &Steps<Truth>, from_ns: u64, to_ns: u64) -> Steps<Truth> {
    let robustness = least(&of.map(|one| one.robustness), from_ns, to_ns);
    let holds = least(&of.map(|one| f64::from(u8::from(one.holds))), from_ns, to_ns);
    robustness.join(&holds, |robustness, holds| Truth { robustness, holds: holds > 0.0 })
}

/// At each moment whether something holds at some time of the interval.
pub(crate) fn eventually(of: &Steps<Truth>, from_ns: u64, to_ns: u64) -> Steps<Truth> {
    always(&of.map(not), from_ns, to_ns).map(not)
}
