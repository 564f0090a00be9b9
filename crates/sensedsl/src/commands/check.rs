//! `sensedsl check`: what is wrong, and whether there is a wiring.

use anyhow::Result;
use sensedsl_diagnostics::{Diagnostic, Severity, SourceMap, render, visible};
use sensedsl_wiring::Solved;

use super::input;
use crate::Status;
use crate::cli::{CheckArgs, CheckFormat};
use crate::files::shown;
use crate::terminal::Terminal;

pub(crate) fn run(args: &CheckArgs, terminal: &mut Terminal) -> Result<Status> {
    let mut status = Status::Done;
    let mut values = Vec::new();
    let mut plain = String::new();
    let mut logs = Vec::new();
    for path in &args.files {
        let resolved = input::load(path, &args.on);
        let sources = resolved.sources;
        let (diagnostics, feasible) = match &resolved.design {
            None => (resolved.diagnostics, None),
            Some(design) => {
                let answer = input::feasible(design, resolved.diagnostics);
                let feasible = match answer.solved {
                    Some(Solved::Wired(_)) => Some(true),
                    Some(Solved::Infeasible(_)) => Some(false),
                    Some(Solved::Failed(_)) | None => None,
                };
                (answer.diagnostics, feasible)
            }
        };
        status = status.max(input::status(&diagnostics, &args.on));
        match args.format {
            CheckFormat::Human => {
                terminal.diagnostics(&diagnostics, &sources)?;
                terminal.note(&summary(&visible(&shown(path)), &diagnostics, feasible))?;
            }
            CheckFormat::Json => {
                values.extend(diagnostics.iter().map(|one| render::json_value(one, &sources)));
            }
            CheckFormat::Sarif => logs.push((diagnostics, sources)),
            CheckFormat::Github => plain.push_str(&render::github(&diagnostics, &sources)),
        }
    }
    match args.format {
        CheckFormat::Human => {}
        CheckFormat::Json => {
            let all = serde_json::json!({ "diagnostics": values });
            terminal.result(&render::json_text(&all))?;
        }
        CheckFormat::Sarif => terminal.result(&merged_sarif(logs))?,
        CheckFormat::Github => terminal.result(&plain)?,
    }
    Ok(status)
}

/// One line a file. Whether there is a wiring is said only where it was looked for.
fn summary(file: &str, diagnostics: &[Diagnostic], feasible: Option<bool>) -> String {
    let count = |severity| diagnostics.iter().filter(|one| one.severity == severity).count();
    let (errors, warnings) = (count(Severity::Error), count(Severity::Warning));
    let plural = |n: usize| if n == 1 { "" } else { "s" };
    let wiring = feasible.map(|yes| if yes { "a wiring exists" } else { "no wiring" }.to_owned());
    let errors = (errors > 0).then(|| format!("{errors} error{}", plural(errors)));
    let warnings = (warnings > 0).then(|| format!("{warnings} warning{}", plural(warnings)));
    let parts: Vec<String> = [wiring, errors, warnings].into_iter().flatten().collect();
    format!("{file}: {}\n", parts.join(", "))
}

/// One log for all files: each file's diagnostics are a run of their own.
fn merged_sarif(logs: Vec<(Vec<Diagnostic>, SourceMap)>) -> String {
    let version = env!("CARGO_PKG_VERSION");
    let mut merged: Option<serde_json::Value> = None;
    for (diagnostics, sources) in logs {
        let text = render::sarif(&diagnostics, &sources, version);
        let Ok(mut log) = serde_json::from_str::<serde_json::Value>(&text) else { continue };
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
