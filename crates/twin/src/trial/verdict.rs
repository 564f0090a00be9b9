//! The verdict on each rule of a test: a recording in; whether it held, the first moment at which it did not with the
//! values there, and by how much, out, in the words of people.

use sensedsl_model::design::{Design, SignalOf, Test, TestRule, TestSignal, TestUnit};
use sensedsl_rules::{Formula, Outcome, Shape, Trace, Verdict};
use sensedsl_wire::{ScalarType, Status};

/// Significant digits of what people read.
const SHORT_DIGITS: usize = 5;

/// Whether a rule held.
#[derive(Clone, Debug, PartialEq)]
pub enum RuleVerdict {
    /// It did.
    Held,
    /// It did not.
    Violated {
        /// The first moment at which it did not, and the values there.
        first: Moment,
        /// The end of the time that was given from there, and the values of what should have come.
        last: Option<Moment>,
    },
    /// Nothing is known of it, because no value of this signal came.
    Unknown(String),
    /// The run ended before it was clear.
    Open,
    /// Nobody sees this signal on a board that cannot be looked into.
    Unseen(String),
}

/// A moment of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Moment {
    /// The time since the beginning.
    pub at_ns: u64,
    /// The signals of the rule with their values, as people read them.
    pub values: Vec<(String, String)>,
}

/// What came of a rule.
#[derive(Clone, Debug, PartialEq)]
pub struct Judged {
    /// Whether it held.
    pub verdict: RuleVerdict,
    /// What the rules' own crate says.
    pub outcome: Outcome,
    /// By how much it held or did not, for people: `3.1 cm to spare`, `late by 12 ms`.
    pub margin: Option<String>,
    /// What else a person should know: that a condition was never true.
    pub note: Option<String>,
}

impl Judged {
    /// Whether the rule held.
    #[must_use]
    pub fn is_held(&self) -> bool {
        self.verdict == RuleVerdict::Held
    }
}

impl Moment {
    /// Its values in one line: `Front = 18.3 cm, Left = 40 %`.
    #[must_use]
    pub fn words(&self) -> String {
        let each = self.values.iter().map(|(name, value)| format!("{name} = {value}"));
        each.collect::<Vec<_>>().join(", ")
    }
}

/// Holds a run to the rules of a test, in their order; those about `unseen` signals are not judged.
#[must_use]
pub fn judge(design: &Design, test: &Test, trace: &Trace, unseen: &[usize]) -> Vec<Judged> {
    let judge = Judge { design, test, trace, unseen };
    test.rules.iter().map(|rule| judge.rule(rule)).collect()
}

/// Holds a run to one rule of a test.
pub(super) fn judge_rule(design: &Design, test: &Test, rule: &TestRule, trace: &Trace) -> Judged {
    Judge { design, test, trace, unseen: &[] }.rule(rule)
}

/// The verdicts on a run that ended too early to say anything.
#[must_use]
pub fn not_judged(test: &Test) -> Vec<Judged> {
    let nothing = Trace::default();
    let open = |rule: &TestRule| {
        let outcome = rule.rule.judge(&nothing);
        Judged { verdict: RuleVerdict::Open, outcome, margin: None, note: None }
    };
    test.rules.iter().map(open).collect()
}

struct Judge<'a> {
    design: &'a Design,
    test: &'a Test,
    trace: &'a Trace,
    unseen: &'a [usize],
}

impl Judge<'_> {
    fn rule(&self, rule: &TestRule) -> Judged {
        let outcome = rule.rule.judge(self.trace);
        let (all, answers) = formulas(&rule.rule.shape);
        let unseen = signals(&all).into_iter().find(|number| self.unseen.contains(number));
        if let Some(signal) = unseen.and_then(|number| self.test.signals.get(number)) {
            let verdict = RuleVerdict::Unseen(signal.name.clone());
            return Judged { verdict, outcome, margin: None, note: None };
        }
        let verdict = match outcome.verdict {
            Verdict::Held => RuleVerdict::Held,
            Verdict::Violated { at_ns, .. } => {
                let waits_ns = match rule.rule.shape {
                    Shape::When(_, _, within_ns) => within_ns.filter(|ns| *ns > 0),
                    Shape::Always(_) | Shape::Never(_) | Shape::Eventually(..) => None,
                };
                let first = self.moment(at_ns, &all);
                let last = waits_ns.map(|ns| self.moment(at_ns.saturating_add(ns), &answers));
                RuleVerdict::Violated { first, last }
            }
            Verdict::Unknown => match self.silent(&all) {
                Some(signal) => RuleVerdict::Unknown(signal.name.clone()),
                None => RuleVerdict::Open,
            },
        };
        let (margin, note) = (margin(rule, &outcome), note(rule, &outcome));
        Judged { verdict, outcome, margin, note }
    }

    /// The first signal of the formulas without a value.
    fn silent(&self, formulas: &[&Formula]) -> Option<&TestSignal> {
        let number = signals(formulas).into_iter().find(|number| {
            self.trace.signals.get(*number).is_none_or(|signal| signal.samples.is_empty())
        });
        self.test.signals.get(number?)
    }

    fn moment(&self, at_ns: u64, formulas: &[&Formula]) -> Moment {
        let value = |number: usize| {
            let signal = self.test.signals.get(number)?;
            let samples = &self.trace.signals.get(number)?.samples;
            let next = samples.partition_point(|sample| sample.0 <= at_ns);
            let (_, value) = samples.get(next.checked_sub(1)?)?;
            Some((signal.name.clone(), self.words(signal, *value)))
        };
        Moment { at_ns, values: signals(formulas).into_iter().filter_map(value).collect() }
    }

    /// A value as people read it.
    fn words(&self, signal: &TestSignal, computed: f64) -> String {
        match signal.of {
            SignalOf::Health => state(computed).to_owned(),
            SignalOf::Age => amount(&signal.unit, computed),
            SignalOf::Value(_) => {
                let device = self.design.device(signal.device);
                let is_truth =
                    device.is_some_and(|device| device.value.value.scalar == ScalarType::Bool);
                if is_truth {
                    return (computed != 0.0).to_string();
                }
                amount(&signal.unit, computed)
            }
        }
    }
}

/// The formulas of a rule, and those that answer its condition.
fn formulas(shape: &Shape) -> (Vec<&Formula>, Vec<&Formula>) {
    match shape {
        Shape::Always(one) | Shape::Never(one) | Shape::Eventually(one, _) => {
            (vec![one], Vec::new())
        }
        Shape::When(condition, then, _) => (vec![condition, then], vec![then]),
    }
}

/// The numbers of the signals in formulas, each once, in their order.
fn signals(formulas: &[&Formula]) -> Vec<usize> {
    let mut all = Vec::new();
    for formula in formulas {
        formula.for_each_signal(&mut |number| {
            if !all.contains(&number) {
                all.push(number);
            }
        });
    }
    all
}

fn state(code: f64) -> &'static str {
    let statuses = [
        (Status::NeverRead, "never_read"),
        (Status::Good, "good"),
        (Status::Stale, "stale"),
        (Status::Failed, "failed"),
        (Status::Invalid, "invalid"),
    ];
    let is_it = |(status, _): &&(Status, &str)| f64::from(status.code()) == code;
    statuses.iter().find(is_it).map_or("unknown", |(_, word)| word)
}

/// A number with as many digits as a person reads.
fn short(number: f64) -> String {
    let text = format!("{number:.*e}", SHORT_DIGITS - 1);
    // Not `-0`.
    text.parse::<f64>().map_or(text, |number| format!("{}", number + 0.0))
}

/// A number in the unit that it is shown in.
fn amount(unit: &TestUnit, computed: f64) -> String {
    let number = short(unit.shown(computed));
    unit.name.as_ref().map_or_else(|| number.clone(), |name| format!("{number} {name}"))
}

/// By how much a rule held or did not.
fn margin(rule: &TestRule, outcome: &Outcome) -> Option<String> {
    let is_timed =
        matches!(rule.rule.shape, Shape::Eventually(_, Some(_)) | Shape::When(_, _, Some(1..)));
    let distance = rule.margin.as_ref().filter(|_| outcome.robustness.is_finite());
    match outcome.verdict {
        Verdict::Held => match (outcome.spare_ns, distance) {
            (Some(spare_ns), _) => Some(format!("{} to spare", time(spare_ns))),
            (None, Some(unit)) if !is_timed && outcome.robustness > 0.0 => {
                Some(format!("{} to spare", amount(unit, outcome.robustness)))
            }
            (None, _) => None,
        },
        Verdict::Violated { late_ns: Some(late_ns), .. } => {
            Some(format!("late by {}", time(late_ns)))
        }
        Verdict::Violated { late_ns: None, .. } => match (is_timed, distance) {
            (true, _) if matches!(rule.rule.shape, Shape::When(..)) => {
                Some("it did not come before the end".to_owned())
            }
            (_, Some(unit)) if outcome.robustness < 0.0 => {
                let off = amount(unit, -outcome.robustness);
                let is_best = matches!(rule.rule.shape, Shape::Eventually(..));
                Some(format!("off by {off} at {}", if is_best { "best" } else { "worst" }))
            }
            (_, _) => None,
        },
        Verdict::Unknown => None,
    }
}

/// What else a person should know.
fn note(rule: &TestRule, outcome: &Outcome) -> Option<String> {
    if !matches!(rule.rule.shape, Shape::When(..)) {
        return None;
    }
    match (outcome.occasions, outcome.open) {
        (0, _) if outcome.verdict == Verdict::Held => {
            Some("its condition was never true".to_owned())
        }
        (0, _) => None,
        (_, 0) => None,
        (all, open) => Some(format!("of {all} occasions {open} open at the end")),
    }
}

/// Nanoseconds as people read times.
#[must_use]
pub(super) fn time(ns: u64) -> String {
    let number = crate::arith::number(ns);
    if ns >= 1_000_000_000 {
        format!("{} s", short(number / 1e9))
    } else {
        format!("{} ms", short(number / 1e6))
    }
}
