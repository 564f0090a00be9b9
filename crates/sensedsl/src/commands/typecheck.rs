//! `check --typecheck`: a wiring is turned into types, and checked by the Rust compiler.
//!
//! For each board, a crate is written to a folder in the user's cache and checked for the host, with the versions of
//! the lock file that is part of this program. Crates for all chips share one folder of built dependencies.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use anyhow::{Context as _, Result};
use sensedsl_diagnostics::Diagnostic;
use sensedsl_diagnostics::codes::{
    e0530_wiring_not_of_the_chip, e0531_no_cargo, e0532_typecheck_stopped,
    e0533_typecheck_not_known,
};
use sensedsl_firmware_embassy::{TypeCheck, type_check};
use sensedsl_job::{BoardJob, jobs};
use sensedsl_model::design::Design;
use sensedsl_wiring::assignment::Assignment;
use serde_json::Value;

use crate::files::shown;
use crate::terminal::Terminal;

/// The compiler's verdict on the wiring of all boards.
pub(super) fn judge(
    design: &Design,
    wiring: &Assignment,
    terminal: &Terminal,
) -> Result<Vec<Diagnostic>> {
    let mut diagnostics = Vec::new();
    for job in jobs(design, wiring) {
        let name = &job.board.name;
        match type_check(&job) {
            Ok(check) => diagnostics.extend(board(&job, &check, terminal)?),
            Err(why) => {
                let report = e0533_typecheck_not_known::not_known(name.span, &name.value, &why);
                diagnostics.push(report);
            }
        }
    }
    Ok(diagnostics)
}

/// The compiler's verdict on one board.
fn board(job: &BoardJob<'_>, check: &TypeCheck, terminal: &Terminal) -> Result<Vec<Diagnostic>> {
    let name = &job.board.name;
    let cargo = std::env::var("CARGO").unwrap_or_else(|_| "cargo".to_owned());
    let asked = Command::new(&cargo).arg("--version").stdin(Stdio::null()).output();
    if !asked.is_ok_and(|output| output.status.success()) {
        return Ok(vec![e0531_no_cargo::no_cargo(name.span, &cargo, "the type check")]);
    }
    let cache = cache().join("embassy-0.6");
    let folder = cache.join(format!("wiring-{}", std::process::id()));
    for (path, file) in check.files.iter() {
        let path = folder.join(path);
        let parent = path.parent().unwrap_or(&folder);
        std::fs::create_dir_all(parent).with_context(|| shown(parent))?;
        std::fs::write(&path, &file.bytes).with_context(|| shown(&path))?;
    }
    // Dependencies that are in the cache need no network; only the first check of a chip downloads.
    let mut output = run(&cargo, &folder, &cache.join("target"), true)?;
    if !output.status.success() && messages(&output).next().is_none() {
        output = run(&cargo, &folder, &cache.join("target"), false)?;
    }
    let found = read(job, check, &output);
    if terminal.verbose() {
        terminal.aside(&format!("the check is in {}", shown(&folder)))?;
    } else {
        std::fs::remove_dir_all(&folder).with_context(|| shown(&folder))?;
    }
    if found.is_empty() {
        let (count, chip) = (check.lines.len(), &check.chip);
        terminal.aside(&format!(
            "{}: the compiler takes all {count} lines of its wiring for {chip}",
            name.value
        ))?;
        for wire in &check.unjudged {
            terminal.aside(&format!("not judged: {wire}, which the HAL has no types for"))?;
        }
    }
    Ok(found)
}

fn run(cargo: &str, folder: &Path, target: &Path, offline: bool) -> Result<Output> {
    let mut command = Command::new(cargo);
    command.args(["check", "--locked", "--message-format=json", "--target-dir"]).arg(target);
    if offline {
        command.arg("--offline");
    }
    // The check is for this computer, whatever else is built here.
    for name in ["CARGO_BUILD_TARGET", "CARGO_ENCODED_RUSTFLAGS", "RUSTFLAGS", "RUSTC_WRAPPER"] {
        command.env_remove(name);
    }
    command.env("CARGO_INCREMENTAL", "0").current_dir(folder).stdin(Stdio::null());
    command.output().with_context(|| cargo.to_owned())
}

/// The compiler's messages, as cargo passes them on.
fn messages(output: &Output) -> impl Iterator<Item = Value> {
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    let lines: Vec<Value> = text
        .lines()
        .filter_map(|line| serde_json::from_str::<Value>(line).ok())
        .filter(|line| line.get("reason").and_then(Value::as_str) == Some("compiler-message"))
        .filter_map(|line| line.get("message").cloned())
        .filter(|message| message.get("level").and_then(Value::as_str) == Some("error"))
        .collect();
    lines.into_iter()
}

/// The diagnostics of a run: one for each rejected line.
fn read(job: &BoardJob<'_>, check: &TypeCheck, output: &Output) -> Vec<Diagnostic> {
    let mut found = Vec::new();
    let mut seen = BTreeSet::new();
    let mut elsewhere = None;
    for message in messages(output) {
        let log = message.get("message").and_then(Value::as_str).unwrap_or_default();
        let log = ["embassy_stm32::", "embassy_rp::", "peripherals::"]
            .iter()
            .fold(log.to_owned(), |log, path| log.replace(path, ""));
        let Some(line) = line_of(&message) else { continue };
        match check.lines.get(&line) {
            Some(judged) if seen.insert(line) => {
                found.push(e0530_wiring_not_of_the_chip::refused(judged.span, &judged.what, &log));
            }
            Some(_) => {}
            None => elsewhere = elsewhere.or(Some(log)),
        }
    }
    let name = &job.board.name;
    if found.is_empty() && !output.status.success() {
        let log = elsewhere.unwrap_or_else(|| reason(&String::from_utf8_lossy(&output.stderr)));
        found.push(e0532_typecheck_stopped::stopped(name.span, &name.value, &log));
    }
    found
}

/// The line of the crate that a message is about.
fn line_of(message: &Value) -> Option<usize> {
    let spans = message.get("spans")?.as_array()?;
    let own = |span: &&Value| span.get("file_name").and_then(Value::as_str) == Some("src/lib.rs");
    let primary = |span: &&Value| span.get("is_primary").and_then(Value::as_bool) == Some(true);
    let span = spans.iter().filter(own).find(primary)?;
    // The code that a macro expands to is at the place of the macro.
    let outer = span.get("expansion").and_then(|expansion| expansion.get("span"));
    let line = outer.unwrap_or(span).get("line_start")?.as_u64()?;
    usize::try_from(line).ok()
}

/// The reason why cargo failed: its first error with the lines that belong to it.
fn reason(stderr: &str) -> String {
    let lines = stderr.lines().skip_while(|line| !line.starts_with("error"));
    let log: Vec<&str> = lines.map(str::trim).filter(|line| !line.is_empty()).take(4).collect();
    if log.is_empty() { "cargo says nothing".to_owned() } else { log.join("; ") }
}

/// The folder for this program in the user's cache.
fn cache() -> PathBuf {
    let of =
        |name: &str| std::env::var_os(name).filter(|value| !value.is_empty()).map(PathBuf::from);
    let home = || of("HOME").or_else(|| of("USERPROFILE"));
    let base = of("XDG_CACHE_HOME").or_else(|| of("LOCALAPPDATA"));
    let base = base.or_else(|| Some(home()?.join(".cache")));
    base.unwrap_or_else(std::env::temp_dir).join("sensedsl")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_message_is_about_the_line_that_calls_a_macro() {
        let message = serde_json::json!({ "spans": [
            { "file_name": "src/lib.rs", "is_primary": false, "line_start": 3 },
            { "file_name": "src/lib.rs", "is_primary": true, "line_start": 9,
              "expansion": { "span": { "line_start": 42 } } },
        ] });
        assert_eq!(line_of(&message), Some(42));
        assert_eq!(line_of(&serde_json::json!({ "spans": [] })), None);
    }

    #[test]
    fn the_reason_is_cargo_s_own() {
        let log = "    Updating crates.io index\nerror: failed to download from `x`\n\nCaused by:\n  no network\n";
        assert_eq!(reason(log), "error: failed to download from `x`; Caused by:; no network");
        assert_eq!(reason(""), "cargo says nothing");
    }
}
