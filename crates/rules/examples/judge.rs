//! Judges formulas and rules over traces, a case a line on the standard input, for `tests/rules/compare.py`.
//!
//! A line has the number of signals, the number of samples, the samples of one signal after the other at 0, 1, 2, … ns,
//! and what is asked: `F` and a formula, `W FROM TO WITHIN` and two formulas of a `when`, or `E FROM WITHIN` and the
//! formula of an `eventually`. Formulas stand in prefix order. The answer to `F` is robustness and verdict at each
//! nanosecond at which they are known, that to a rule its robustness, its verdict, and its first violation.

use std::io::{BufRead as _, Write as _};
use std::str::SplitWhitespace;

use sensedsl_rules::{Compare, Formula, Rule, Shape, Signal, Term, Trace, Verdict, evaluate};

fn main() -> std::io::Result<()> {
    let mut out = std::io::BufWriter::new(std::io::stdout().lock());
    for line in std::io::stdin().lock().lines() {
        let line = line?;
        let mut words = line.split_whitespace();
        match answer(&mut words) {
            Some(text) => writeln!(out, "{text}")?,
            None => writeln!(out, "not understood: {line}")?,
        }
    }
    out.flush()
}

fn answer(words: &mut SplitWhitespace<'_>) -> Option<String> {
    let (signals, samples): (usize, u64) = (number(words)?, number(words)?);
    let signal = |words: &mut SplitWhitespace<'_>| {
        let all: Option<Vec<(u64, f64)>> =
            (0..samples).map(|at_ns| Some((at_ns, number(words)?))).collect();
        all.map(|samples| Signal { samples })
    };
    let all: Option<Vec<Signal>> = (0..signals).map(|_| signal(words)).collect();
    let trace = Trace { signals: all?, end_ns: samples.checked_sub(1)? };
    let rule = match words.next()? {
        "F" => return Some(series(&formula(words)?, &trace)),
        "W" => {
            let (from_ns, to_ns, within_ns) = (number(words)?, number(words)?, number(words)?);
            let (condition, then) = (formula(words)?, formula(words)?);
            let shape = Shape::When(condition, then, Some(within_ns));
            Rule { shape, from_ns, to_ns: Some(to_ns) }
        }
        "E" => {
            let (from_ns, within_ns) = (number(words)?, number(words)?);
            let shape = Shape::Eventually(formula(words)?, Some(within_ns));
            Rule { shape, from_ns, to_ns: None }
        }
        _ => return None,
    };
    let outcome = rule.judge(&trace);
    Some(match outcome.verdict {
        Verdict::Held => format!("{:e} held", outcome.robustness),
        Verdict::Violated { at_ns, .. } => format!("{:e} violated {at_ns}", outcome.robustness),
        Verdict::Unknown => "unknown".to_owned(),
    })
}

fn series(formula: &Formula, trace: &Trace) -> String {
    let known = evaluate(formula, trace);
    let mut text = String::new();
    for at_ns in 0..=trace.end_ns {
        if let Some(truth) = known.at(at_ns) {
            text.push_str(&format!("{at_ns} {:e} {} ", truth.robustness, u8::from(truth.holds)));
        }
    }
    text
}

fn number<N: std::str::FromStr>(words: &mut SplitWhitespace<'_>) -> Option<N> {
    words.next()?.parse().ok()
}

fn term(words: &mut SplitWhitespace<'_>) -> Option<Term> {
    let word = words.next()?;
    let mut next = || term(words).map(Box::new);
    Some(match word {
        "+" => Term::Sum(next()?, next()?),
        "-" => Term::Difference(next()?, next()?),
        "*" => Term::Product(next()?, next()?),
        "abs" => Term::Absolute(next()?),
        _ => match word.split_at_checked(1)? {
            ("s", signal) => Term::Signal(signal.parse().ok()?),
            ("n", value) => Term::Number(value.parse().ok()?),
            _ => return None,
        },
    })
}

fn formula(words: &mut SplitWhitespace<'_>) -> Option<Formula> {
    let word = words.next()?;
    let how = match word {
        "<" => Some(Compare::Less),
        "<=" => Some(Compare::AtMost),
        ">" => Some(Compare::Greater),
        ">=" => Some(Compare::AtLeast),
        "==" => Some(Compare::Equal),
        "!=" => Some(Compare::Unequal),
        _ => None,
    };
    if let Some(how) = how {
        return Some(Formula::Compare(term(words)?, how, term(words)?));
    }
    let interval = match word {
        "always" | "eventually" => Some((number(words)?, number(words)?)),
        _ => None,
    };
    let mut next = || formula(words).map(Box::new);
    Some(match (word, interval) {
        ("not", _) => Formula::Not(next()?),
        ("and", _) => Formula::And(next()?, next()?),
        ("or", _) => Formula::Or(next()?, next()?),
        ("implies", _) => Formula::Implies(next()?, next()?),
        ("rising", _) => Formula::Rising(next()?),
        ("always", Some((from_ns, to_ns))) => Formula::Always(from_ns, to_ns, next()?),
        ("eventually", Some((from_ns, to_ns))) => Formula::Eventually(from_ns, to_ns, next()?),
        _ => return None,
    })
}
