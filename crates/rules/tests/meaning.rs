//! Formulas and rules against their definition, moment by moment, on traces drawn by chance.
#![expect(clippy::unwrap_used, clippy::indexing_slicing, reason = "a panic is a failure here")]

use proptest::prelude::*;
use sensedsl_rules::{
    Compare, Formula, Outcome, Rule, Shape, Signal, Term, Trace, Verdict, evaluate,
};

const SIGNALS: usize = 3;
const END: u64 = 40;

fn trace() -> impl Strategy<Value = Trace> {
    let samples = proptest::collection::btree_map(0..=END, -4_i8..=4, 1..12);
    let signal = samples.prop_map(|all| Signal {
        samples: all.into_iter().map(|(at, value)| (at, f64::from(value))).collect(),
    });
    proptest::collection::vec(signal, SIGNALS).prop_map(|signals| Trace { signals, end_ns: END })
}

fn term() -> impl Strategy<Value = Term> {
    let leaf = prop_oneof![
        3 => (0..SIGNALS).prop_map(Term::Signal),
        1 => (-4_i8..=4).prop_map(|value| Term::Number(f64::from(value))),
    ];
    leaf.prop_recursive(2, 6, 2, |inner| {
        let two = || (inner.clone().prop_map(Box::new), inner.clone().prop_map(Box::new));
        prop_oneof![
            two().prop_map(|(one, other)| Term::Sum(one, other)),
            two().prop_map(|(one, other)| Term::Difference(one, other)),
            two().prop_map(|(one, other)| Term::Product(one, other)),
            two().prop_map(|(one, other)| Term::Quotient(one, other)),
            two().prop_map(|(one, other)| Term::Least(one, other)),
            two().prop_map(|(one, other)| Term::Greatest(one, other)),
            inner.clone().prop_map(|one| Term::Negative(Box::new(one))),
            inner.prop_map(|one| Term::Absolute(Box::new(one))),
        ]
    })
}

fn formula() -> impl Strategy<Value = Formula> {
    let how = prop_oneof![
        Just(Compare::Less),
        Just(Compare::AtMost),
        Just(Compare::Greater),
        Just(Compare::AtLeast),
        Just(Compare::Equal),
        Just(Compare::Unequal)
    ];
    let leaf =
        (term(), how, term()).prop_map(|(one, how, other)| Formula::Compare(one, how, other));
    leaf.prop_recursive(3, 10, 2, |inner| {
        let two = || (inner.clone().prop_map(Box::new), inner.clone().prop_map(Box::new));
        let one = || inner.clone().prop_map(Box::new);
        let span = || (0_u64..8, 0_u64..8).prop_map(|(from, more)| (from, from + more));
        prop_oneof![
            one().prop_map(Formula::Not),
            one().prop_map(Formula::Rising),
            two().prop_map(|(one, other)| Formula::And(one, other)),
            two().prop_map(|(one, other)| Formula::Or(one, other)),
            two().prop_map(|(one, other)| Formula::Implies(one, other)),
            (span(), one()).prop_map(|((from, to), one)| Formula::Always(from, to, one)),
            (span(), one()).prop_map(|((from, to), one)| Formula::Eventually(from, to, one)),
        ]
    })
}

/// The value of a term at a moment, by its definition.
fn number(term: &Term, trace: &Trace, at: u64) -> Option<f64> {
    let two = |one: &Term, other: &Term| Some((number(one, trace, at)?, number(other, trace, at)?));
    Some(match term {
        Term::Signal(signal) => {
            trace.signals[*signal].samples.iter().rev().find(|sample| sample.0 <= at)?.1
        }
        Term::Number(value) => *value,
        Term::Negative(one) => -number(one, trace, at)?,
        Term::Absolute(one) => number(one, trace, at)?.abs(),
        Term::Sum(one, other) => two(one, other).map(|(one, other)| one + other)?,
        Term::Difference(one, other) => two(one, other).map(|(one, other)| one - other)?,
        Term::Product(one, other) => two(one, other).map(|(one, other)| one * other)?,
        Term::Quotient(one, other) => {
            let (one, other) = two(one, other)?;
            if other == 0.0 { f64::NAN } else { one / other }
        }
        Term::Least(one, other) => two(one, other).map(|(one, other)| one.min(other))?,
        Term::Greatest(one, other) => two(one, other).map(|(one, other)| one.max(other))?,
    })
}

/// Whether some signal of a formula has a sample at a moment.
fn is_sampled(formula: &Formula, trace: &Trace, at: u64) -> bool {
    match formula {
        // What looks ahead changes at other moments as well; those are compared through the pieces.
        Formula::Always(..) | Formula::Eventually(..) => unreachable!("not below `rising` here"),
        Formula::Rising(one) | Formula::Not(one) => is_sampled(one, trace, at),
        Formula::And(one, other) | Formula::Or(one, other) | Formula::Implies(one, other) => {
            is_sampled(one, trace, at) || is_sampled(other, trace, at)
        }
        Formula::Compare(..) => {
            let mut is_sampled = false;
            formula.for_each_signal(&mut |signal| {
                is_sampled |= trace.signals[signal].samples.iter().any(|sample| sample.0 == at);
            });
            is_sampled
        }
    }
}

fn looks_ahead(formula: &Formula) -> bool {
    match formula {
        Formula::Always(..) | Formula::Eventually(..) => true,
        Formula::Rising(one) | Formula::Not(one) => looks_ahead(one),
        Formula::And(one, other) | Formula::Or(one, other) | Formula::Implies(one, other) => {
            looks_ahead(one) || looks_ahead(other)
        }
        Formula::Compare(..) => false,
    }
}

/// Whether `rising` is of something that looks ahead.
fn is_strange(formula: &Formula) -> bool {
    match formula {
        Formula::Rising(one) => looks_ahead(one) || is_strange(one),
        Formula::Not(one) | Formula::Always(_, _, one) | Formula::Eventually(_, _, one) => {
            is_strange(one)
        }
        Formula::And(one, other) | Formula::Or(one, other) | Formula::Implies(one, other) => {
            is_strange(one) || is_strange(other)
        }
        Formula::Compare(..) => false,
    }
}

/// Robustness and truth at a moment, by their definitions.
fn truth(formula: &Formula, trace: &Trace, at: u64) -> Option<(f64, bool)> {
    let not = |(robustness, holds): (f64, bool)| (-robustness, !holds);
    let all = |from: u64, to: u64, one: &Formula, is_turned: bool| {
        let mut least: Option<(f64, bool)> = None;
        for moment in at + from..=at + to {
            let now = (moment <= END).then(|| truth(one, trace, moment)).flatten()?;
            let now = if is_turned { not(now) } else { now };
            least = Some(least.map_or(now, |least| (least.0.min(now.0), least.1 && now.1)));
        }
        least
    };
    match formula {
        Formula::Compare(one, how, other) => {
            let (one, other) = (number(one, trace, at)?, number(other, trace, at)?);
            if one.is_nan() || other.is_nan() {
                return Some((f64::NEG_INFINITY, false));
            }
            Some(match how {
                Compare::Less => (other - one, one < other),
                Compare::AtMost => (other - one, one <= other),
                Compare::Greater => (one - other, one > other),
                Compare::AtLeast => (one - other, one >= other),
                Compare::Equal => (-(one - other).abs(), one == other),
                Compare::Unequal => ((one - other).abs(), one != other),
            })
        }
        Formula::Not(one) => truth(one, trace, at).map(not),
        Formula::And(one, other) => {
            let (one, other) = (truth(one, trace, at)?, truth(other, trace, at)?);
            Some((one.0.min(other.0), one.1 && other.1))
        }
        Formula::Or(one, other) => {
            let (one, other) = (truth(one, trace, at)?, truth(other, trace, at)?);
            Some((one.0.max(other.0), one.1 || other.1))
        }
        Formula::Implies(one, other) => {
            let (one, other) = (not(truth(one, trace, at)?), truth(other, trace, at)?);
            Some((one.0.max(other.0), one.1 || other.1))
        }
        Formula::Rising(one) => {
            let now = truth(one, trace, at)?;
            let since = (0..=at).rev().find(|moment| is_sampled(one, trace, *moment));
            let before = since.filter(|since| *since > 0).map(|since| since - 1);
            let before = before.and_then(|before| truth(one, trace, before));
            let before = before.unwrap_or((f64::INFINITY, true));
            Some((now.0.min(-before.0), now.1 && !before.1))
        }
        Formula::Always(from, to, one) => all(*from, *to, one, false),
        Formula::Eventually(from, to, one) => all(*from, *to, one, true).map(not),
    }
}

proptest! {
    #[test]
    fn formulas_mean_what_they_are_defined_to(formula in formula(), trace in trace()) {
        prop_assume!(!is_strange(&formula));
        let found = evaluate(&formula, &trace);
        for at in 0..=END {
            let expected = truth(&formula, &trace, at);
            let got = found.at(at).map(|one| (one.robustness, one.holds));
            prop_assert_eq!(got, expected, "at {}", at);
        }
    }

    #[test]
    fn rules_are_formulas_at_all_their_moments(
        one in formula(), other in formula(), trace in trace(),
        from in 0_u64..20, length in 0_u64..30, within in 0_u64..10,
    ) {
        prop_assume!(!is_strange(&one) && !is_strange(&other));
        let to = (from + length).min(END);
        let judge = |shape: Shape| Rule { shape, from_ns: from, to_ns: Some(to) }.judge(&trace);
        let always = |formula: &Formula| -> (f64, Option<u64>, bool) {
            let known: Vec<_> = (from..=to)
                .filter_map(|at| Some((at, truth(formula, &trace, at)?))).collect();
            let least = known.iter().map(|one| one.1.0).fold(f64::INFINITY, f64::min);
            (least, known.iter().find(|one| !one.1.1).map(|one| one.0), known.is_empty())
        };
        let verdict = |outcome: Outcome| match outcome.verdict {
            Verdict::Violated { at_ns, .. } => (outcome.robustness, Some(at_ns), false),
            Verdict::Held => (outcome.robustness, None, false),
            Verdict::Unknown => (outcome.robustness, None, true),
        };
        prop_assert_eq!(verdict(judge(Shape::Always(one.clone()))), always(&one));
        let opposite = Formula::Not(Box::new(one.clone()));
        prop_assert_eq!(verdict(judge(Shape::Never(one.clone()))), always(&opposite));
        let soon = Formula::Eventually(0, within, Box::new(other.clone()));
        let response = Formula::Implies(Box::new(one.clone()), Box::new(soon));
        let when = judge(Shape::When(one.clone(), other.clone(), Some(within)));
        prop_assert_eq!(verdict(when), always(&response));
        // The least that was left of the time, by waiting from each moment.
        let holds = |formula: &Formula, at: u64| truth(formula, &trace, at).map(|one| one.1);
        let is_known = |at: u64| truth(&response, &trace, at).is_some();
        let waits = (from..=to).filter(|at| is_known(*at) && holds(&one, *at) == Some(true));
        let came = waits.filter_map(|at| {
            (at..=at + within).find(|then| holds(&other, *then) == Some(true)).map(|then| then - at)
        });
        let spare = came.max().map(|longest| within - longest);
        if within > 0 {
            prop_assert_eq!(when.spare_ns, spare);
        }
    }
}

#[test]
fn a_late_answer_is_late_by_so_much() {
    let signals = vec![
        Signal { samples: vec![(0, 30.0), (10, 5.0)] },
        Signal { samples: vec![(0, 50.0), (17, 0.0)] },
    ];
    let trace = Trace { signals, end_ns: 40 };
    let near = Formula::Compare(Term::Signal(0), Compare::Less, Term::Number(20.0));
    let still = Formula::Compare(Term::Signal(1), Compare::Equal, Term::Number(0.0));
    let when = |within_ns| Rule {
        shape: Shape::When(near.clone(), still.clone(), Some(within_ns)),
        from_ns: 0,
        to_ns: None,
    };
    let late = when(5).judge(&trace);
    assert_eq!(late.verdict, Verdict::Violated { at_ns: 10, late_ns: Some(2) });
    assert_eq!((late.robustness, late.occasions), (-15.0, 1));
    let good = when(12).judge(&trace);
    assert_eq!((good.verdict, good.spare_ns, good.open), (Verdict::Held, Some(5), 0));
    let soon = |within_ns| Rule {
        shape: Shape::Eventually(still.clone(), Some(within_ns)),
        from_ns: 0,
        to_ns: None,
    };
    assert_eq!(soon(20).judge(&trace).spare_ns, Some(3));
    let late = soon(15).judge(&trace).verdict;
    assert_eq!(late, Verdict::Violated { at_ns: 15, late_ns: Some(2) });
    let never = Signal::default();
    let trace = Trace { signals: vec![never.clone(), never], end_ns: 40 };
    assert_eq!(when(5).judge(&trace).verdict, Verdict::Unknown);
}

/// The piece before one that begins at the very end of the trace has nothing to say about the end.
#[test]
fn a_piece_that_begins_at_the_end_stands_alone_there() {
    let one = Signal { samples: vec![(0, -5.0), (10, 3.0)] };
    let trace = Trace { signals: vec![one], end_ns: 10 };
    let above = || Formula::Compare(Term::Signal(0), Compare::Greater, Term::Number(0.0));
    let rule = Rule { shape: Shape::Always(above()), from_ns: 10, to_ns: None };
    let outcome = rule.judge(&trace);
    assert_eq!((outcome.verdict, outcome.robustness), (Verdict::Held, 3.0));
    let below = Formula::Not(Box::new(above()));
    let rule = Rule { shape: Shape::When(above(), below, Some(0)), from_ns: 0, to_ns: None };
    assert_eq!(rule.judge(&trace).verdict, Verdict::Violated { at_ns: 10, late_ns: None });
}
