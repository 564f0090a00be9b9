//! `sensedsl check`: the errors, and whether there is a wiring.

use anyhow::Result;
use sensedsl_diagnostics::{Diagnostic, Severity, SourceMap, render, visible};
use sensedsl_generate::target;
use sensedsl_report::junit::{Case, Failure, Suite, junit};
use sensedsl_session::Answer;
use sensedsl_wiring::Solved;

use super::input;
use crate::cli::{CheckArgs, CheckFormat};
use crate::files::shown;
use crate::status::Status;
use crate::terminal::Terminal;

const VERSION: &str = env!("CARGO_PKG_VERSION");

pub(crate) fn run(args: &CheckArgs, terminal: &mut Terminal) -> Result<Status> {
    let mut status = Status::Done;
    let mut values = Vec::new();
    let mut plain = String::new();
    let mut logs = Vec::new();
    let mut cases = Vec::new();
    for path in &args.files {
        let snapshot = input::load(path, &args.on);
        let sources = snapshot.sources();
        let answer = input::feasible(&snapshot);
        let mut diagnostics = answer.diagnostics.clone();
        if let Some((design, wiring)) = answer.wired().filter(|_| answer.left_out.is_empty()) {
            target::foresee(design, wiring, &mut diagnostics);
        }
        if let Some((design, wiring)) = answer.wired().filter(|_| args.typecheck) {
            diagnostics.extend(super::typecheck::judge(design, wiring, terminal)?);
        }
        let diagnostics = &diagnostics;
        status = status.max(input::status(diagnostics, &args.on));
        match args.format {
            CheckFormat::Human => {
                terminal.diagnostics(diagnostics, sources)?;
                terminal.note(&summary(&visible(&shown(path)), &answer, diagnostics))?;
            }
            CheckFormat::Json => {
                values.extend(diagnostics.iter().map(|one| render::json_value(one, sources)));
            }
            CheckFormat::Sarif => logs.push(render::sarif(diagnostics, sources, VERSION)),
            CheckFormat::Github => plain.push_str(&render::github(diagnostics, sources)),
            CheckFormat::Junit => cases.push(case(shown(path), diagnostics, sources)),
        }
    }
    match args.format {
        CheckFormat::Human => {}
        CheckFormat::Json => {
            let all = serde_json::json!({ "diagnostics": values });
            terminal.result(&render::json_text(&all))?;
        }
        CheckFormat::Sarif => terminal.result(&merged_sarif(&logs))?,
        CheckFormat::Github => terminal.result(&plain)?,
        CheckFormat::Junit => {
            terminal.result(&junit(&[Suite { name: "check".to_owned(), cases }]))?;
        }
    }
    Ok(status)
}

/// A file as a case: it fails with its first error, and the text has all of them.
fn case(file: String, diagnostics: &[Diagnostic], sources: &SourceMap) -> Case {
    let (errors, others): (Vec<Diagnostic>, Vec<Diagnostic>) =
        diagnostics.iter().cloned().partition(|one| one.severity == Severity::Error);
    let failure = errors.first().map(|first| Failure {
        code: first.code.name().to_owned(),
        message: first.message.clone(),
        text: render::human(&errors, sources, false),
    });
    Case { name: file.clone(), file, failure, output: render::human(&others, sources, false) }
}

/// A line for each file. It tells whether there is a wiring only if one was searched for.
fn summary(file: &str, answer: &Answer<'_>, diagnostics: &[Diagnostic]) -> String {
    let of = |severity| move |one: &&Diagnostic| one.severity == severity;
    let count = |severity| diagnostics.iter().filter(of(severity)).count();
    let (errors, warnings) = (count(Severity::Error), count(Severity::Warning));
    let plural = |n: usize| if n == 1 { "" } else { "s" };
    let is_partial = !answer.left_out.is_empty();
    let wiring = match (&answer.solved, is_partial) {
        (Some(Solved::Wired(_)), false) => Some("a wiring exists"),
        (Some(Solved::Wired(_)), true) => Some("a wiring of the other devices exists"),
        (Some(Solved::Infeasible(_)), false) => Some("no wiring"),
        (Some(Solved::Infeasible(_)), true) => Some("no wiring of the other devices"),
        (Some(Solved::Failed(_)) | None, _) => None,
    };
    let wiring = wiring.map(str::to_owned);
    let errors = (errors > 0).then(|| format!("{errors} error{}", plural(errors)));
    let warnings = (warnings > 0).then(|| format!("{warnings} warning{}", plural(warnings)));
    let parts: Vec<String> = [wiring, errors, warnings].into_iter().flatten().collect();
    let found = if parts.is_empty() { "no errors".to_owned() } else { parts.join(", ") };
    format!("{file}: {found}\n")
}

/// One log for all files: the diagnostics of each file are a run of their own.
fn merged_sarif(logs: &[String]) -> String {
    let mut merged: Option<serde_json::Value> = None;
    for text in logs {
        let Ok(mut log) = serde_json::from_str::<serde_json::Value>(text) else { continue };
        match merged.as_mut().and_then(|all| all.get_mut("runs")?.as_array_mut()) {
            Some(runs) => {
                let more = log.get_mut("runs").and_then(serde_json::Value::as_array_mut);
                runs.extend(more.into_iter().flat_map(std::mem::take));
            }
            None => merged = Some(log),
        }
    }
    merged.map_or(String::new(), |log| render::json_text(&log))
}
