//! What came of tests: their verdicts in; text for people, JSON for scripts, `JUnit` for build servers, out.

use sensedsl_diagnostics::codes::e0538_test_failed;
use sensedsl_diagnostics::render::json_text;
use sensedsl_diagnostics::{Span, visible};
use sensedsl_model::design::TestRule;
use sensedsl_report::junit::{Case, Failure, Suite, junit};
use sensedsl_twin::trial::{Judged, Moment, RuleVerdict};
use serde_json::{Value, json};

use super::bed::Bed;
use super::one::{Ran, failure, seconds, violation};
use crate::cli::TestFormat;

/// Version of the JSON.
const VERSION: u32 = 1;

pub(super) fn text(bed: &Bed<'_>, all: &[Ran<'_>]) -> String {
    match bed.args.format {
        TestFormat::Human => human(all),
        TestFormat::Json => {
            let tests: Vec<Value> = all.iter().map(|ran| value(bed, ran)).collect();
            let is_passed = all.iter().all(Ran::is_passed);
            json_text(&json!({ "version": VERSION, "passed": is_passed, "tests": tests }))
        }
        TestFormat::Junit => junit(&all.iter().map(|ran| suite(bed, ran)).collect::<Vec<_>>()),
    }
}

fn human(all: &[Ran<'_>]) -> String {
    let mut out = String::new();
    for ran in all {
        let verdict = if ran.is_passed() { "passed" } else { "FAILED" };
        let lasts = seconds_short(ran.test.lasts_ns);
        out.push_str(&format!("{} {verdict} ({lasts})\n", visible(&ran.test.name.value)));
        if let Some(stopped) = &ran.stopped {
            let why = ran.stop(stopped).message;
            out.push_str(&format!("  {}; no rule was judged\n", visible(&why)));
            continue;
        }
        for (rule, one) in ran.test.rules.iter().zip(&ran.judged) {
            let word = match one.verdict {
                RuleVerdict::Held => "held",
                RuleVerdict::Violated { .. } => "VIOLATED",
                RuleVerdict::Unknown(_) => "UNKNOWN",
                RuleVerdict::Open => "OPEN",
                RuleVerdict::Unseen(_) => "not seen",
            };
            let unseen = unseen(one);
            let mut more: Vec<&str> = Vec::new();
            more.extend(unseen.as_deref());
            more.extend(one.margin.as_deref());
            more.extend(one.note.as_deref());
            let more =
                if more.is_empty() { String::new() } else { format!(" ({})", more.join("; ")) };
            out.push_str(&format!("  {word:8}  {}{more}\n", visible(&rule.text)));
            if !one.is_held() && unseen.is_none() {
                let (_, values) = violation(one);
                let values = values.replace("; ", "\n            ");
                if !values.is_empty() {
                    out.push_str(&format!("            {}\n", visible_lines(&values)));
                }
            }
        }
    }
    let failed = all.iter().filter(|ran| !ran.is_passed()).count();
    let plural = if all.len() == 1 { "" } else { "s" };
    let passed = all.len() - failed;
    let unseen = all.iter().flat_map(|ran| &ran.judged).filter(|one| unseen(one).is_some()).count();
    let not_seen = match unseen {
        0 => String::new(),
        1 => "; 1 rule was not seen".to_owned(),
        many => format!("; {many} rules were not seen"),
    };
    out.push_str(&format!(
        "\n{} test{plural}: {passed} passed, {failed} failed{not_seen}\n",
        all.len()
    ));
    out
}

/// Why a rule was not judged.
fn unseen(one: &Judged) -> Option<String> {
    let RuleVerdict::Unseen(name) = &one.verdict else { return None };
    Some(format!("code on the board sets {name}, and no report has it"))
}

fn visible_lines(text: &str) -> String {
    text.split('\n').map(visible).collect::<Vec<_>>().join("\n")
}

/// A length for people: `10 s`.
fn seconds_short(ns: u64) -> String {
    let text = seconds(ns);
    let number = text.trim_end_matches(" s").trim_end_matches('0').trim_end_matches('.');
    format!("{number} s")
}

fn line(bed: &Bed<'_>, span: Span) -> u32 {
    bed.sources.line_column(span.file, span.start).line
}

/// Seconds as a number.
#[expect(clippy::cast_precision_loss, reason = "an hour of nanoseconds is exact")]
fn number(ns: u64) -> f64 {
    ns as f64 / 1e9
}

fn value(bed: &Bed<'_>, ran: &Ran<'_>) -> Value {
    let rules = ran.test.rules.iter().zip(&ran.judged);
    let rules: Vec<Value> = rules.map(|(rule, one)| rule_value(bed, rule, one)).collect();
    let stopped = ran.stopped.as_ref();
    json!({
        "name": ran.test.name.value,
        "file": bed.sources.name(ran.test.name.span.file),
        "line": line(bed, ran.test.name.span),
        "world": ran.test.world.as_ref().map(|world| &world.value),
        "seconds": number(ran.test.lasts_ns),
        "passed": ran.is_passed(),
        "stopped": stopped.map(|one| json!({ "at": number(one.at_ns), "why": ran.stop(one).message })),
        "rules": rules,
    })
}

fn rule_value(bed: &Bed<'_>, rule: &TestRule, one: &Judged) -> Value {
    let (word, first, last) = match &one.verdict {
        RuleVerdict::Held => ("held", None, None),
        RuleVerdict::Violated { first, last } => ("violated", Some(first), last.as_ref()),
        RuleVerdict::Unknown(_) => ("unknown", None, None),
        RuleVerdict::Open => ("open", None, None),
        RuleVerdict::Unseen(_) => ("unseen", None, None),
    };
    let late_ns = match one.outcome.verdict {
        sensedsl_rules::Verdict::Violated { late_ns, .. } => late_ns,
        sensedsl_rules::Verdict::Held | sensedsl_rules::Verdict::Unknown => None,
    };
    let distance = rule.margin.as_ref().filter(|_| one.outcome.robustness.is_finite());
    let distance = distance
        .map(|unit| json!({ "value": unit.shown(one.outcome.robustness), "unit": unit.name }));
    json!({
        "text": rule.text,
        "line": line(bed, rule.span),
        "verdict": word,
        "margin": one.margin,
        "distance": distance,
        "spare": one.outcome.spare_ns.map(number),
        "late": late_ns.map(number),
        "occasions": one.outcome.occasions,
        "open": one.outcome.open,
        "first": first.map(moment),
        "last": last.map(moment),
    })
}

fn moment(one: &Moment) -> Value {
    let values = one.values.iter().map(|(name, value)| json!({ "name": name, "value": value }));
    json!({ "at": number(one.at_ns), "values": values.collect::<Vec<_>>() })
}

fn suite(bed: &Bed<'_>, ran: &Ran<'_>) -> Suite {
    let file = bed.sources.name(ran.test.name.span.file).to_owned();
    let case = |(rule, one): (&TestRule, &Judged)| {
        let failure = failure(rule.span, one).map(|why| Failure {
            code: e0538_test_failed::CODE.name().to_owned(),
            message: why.message,
            text: why.help.unwrap_or_default(),
        });
        let said = [one.margin.as_deref(), one.note.as_deref()];
        let unseen = unseen(one);
        let said = said.into_iter().flatten().chain(unseen.as_deref());
        let output = said.collect::<Vec<_>>().join("\n");
        let output = if failure.is_some() { String::new() } else { output };
        Case { name: rule.text.clone(), file: file.clone(), failure, output }
    };
    let mut cases: Vec<Case> = ran.test.rules.iter().zip(&ran.judged).map(case).collect();
    if let Some(stopped) = &ran.stopped {
        let why = ran.stop(stopped);
        let (code, text) = (why.code.name().to_owned(), why.help.unwrap_or_default());
        let failure = Failure { code, message: why.message, text };
        let name = "the run reaches its end".to_owned();
        cases.clear();
        cases.insert(0, Case { name, file, failure: Some(failure), output: String::new() });
    }
    Suite { name: ran.test.name.value.clone(), cases }
}
