//! `sensedsl fmt`: the canonical layout, and the identifiers that a file leaves out.

mod migrate;

use std::path::Path;

use anyhow::Result;
use sensedsl_diagnostics::{SourceMap, visible};
use sensedsl_model::{FileUse, syntax_diagnostic, with_ids};
use sensedsl_session::Snapshot;

use super::input;
use crate::cli::{FmtArgs, On, Reach};
use crate::files::{read_text, shown, write_whole};
use crate::status::Status;
use crate::terminal::Terminal;

pub(crate) fn run(args: &FmtArgs, terminal: &mut Terminal) -> Result<Status> {
    let mut status = Status::Done;
    for path in &args.files {
        let text = read_text(path, FileUse::Sense)?;
        let Some(formatted) = laid_out(path, &text, terminal)? else {
            status = Status::Wrong;
            continue;
        };
        let Some(wanted) = rewritten(path, &text, &formatted, args, terminal)? else {
            status = Status::Wrong;
            continue;
        };
        if args.check {
            let lacks = if formatted != text {
                "not laid out canonically"
            } else if wanted != text {
                if args.migrate {
                    "values are not as they are today"
                } else {
                    "identifiers are not written"
                }
            } else {
                continue;
            };
            terminal.note(&format!("{}: {lacks}\n", visible(&shown(path))))?;
            status = Status::Wrong;
        } else if path == Path::new("-") {
            terminal.result(&wanted)?;
        } else if wanted != text {
            write_whole(path, wanted.as_bytes())?;
            let done = match (wanted == formatted, args.migrate) {
                (true, _) => "laid out",
                (false, true) => "values written as they are today",
                (false, false) => "identifiers written",
            };
            terminal.note(&format!("{}: {done}\n", visible(&shown(path))))?;
        }
    }
    Ok(status)
}

/// The canonical text with the requested changes; `None` if it has errors, which have been reported.
fn rewritten(
    path: &Path,
    text: &str,
    formatted: &str,
    args: &FmtArgs,
    terminal: &Terminal,
) -> Result<Option<String>> {
    let mut wanted = (text.to_owned(), formatted.to_owned());
    if args.migrate {
        let migrated = match migrate::migrated(path, text, args) {
            Ok(migrated) => migrated,
            Err(before) => {
                terminal.diagnostics(before.diagnostics(), before.sources())?;
                terminal.aside(&format!("{}: a file with errors stays as it is", shown(path)))?;
                return Ok(None);
            }
        };
        let Some(formatted) = laid_out(path, &migrated, terminal)? else { return Ok(None) };
        wanted = (migrated, formatted);
    }
    if args.ids {
        return numbered(path, &wanted.0, &wanted.1, args, terminal);
    }
    Ok(Some(wanted.1))
}

/// The text in its canonical layout; `None` if it has errors, which have been reported.
fn laid_out(path: &Path, text: &str, terminal: &Terminal) -> Result<Option<String>> {
    let errors = match sensedsl_syntax::format(text) {
        Ok(formatted) => return Ok(Some(formatted)),
        Err(errors) => errors,
    };
    let mut sources = SourceMap::default();
    let file = sources.add(shown(path), text);
    let reports: Vec<_> = errors.iter().map(|error| syntax_diagnostic(error, file)).collect();
    terminal.diagnostics(&reports, &sources)?;
    Ok(None)
}

/// The canonical text with all identifiers; `None` if the design has errors, which have been reported.
fn numbered(
    path: &Path,
    text: &str,
    formatted: &str,
    args: &FmtArgs,
    terminal: &Terminal,
) -> Result<Option<String>> {
    let before = snapshot(path, text, &args.reach);
    let Some(design) = before.design() else {
        terminal.diagnostics(before.diagnostics(), before.sources())?;
        let name = shown(path);
        terminal.aside(&format!("{name}: no identifiers are written into a file with errors"))?;
        return Ok(None);
    };
    let tree = before.trees().iter().find(|(file, _)| *file == design.file);
    let with = tree.and_then(|(_, tree)| with_ids(design, &tree.ast(), text));
    let Some(with) = with else { return Ok(Some(formatted.to_owned())) };
    let Some(numbered) = laid_out(path, &with, terminal)? else { return Ok(None) };
    let moved = moved(&before, &snapshot(path, &numbered, &args.reach));
    if !moved.is_empty() {
        terminal.aside(&format!(
            "{}: write an `id` into the devices of used files, too, which have other numbers now: {}",
            shown(path),
            moved.join(", ")
        ))?;
    }
    Ok(Some(numbered))
}

/// The file with this text, without the abilities of a system, which matter neither for identifiers nor for values.
fn snapshot(path: &Path, text: &str, reach: &Reach) -> Snapshot {
    let on = On { board: None, target: Some("none".to_owned()), reach: reach.clone() };
    input::of_text(path, text.to_owned(), &on)
}

/// The devices whose identifiers have changed.
fn moved(before: &Snapshot, after: &Snapshot) -> Vec<String> {
    let (Some(before), Some(after)) = (before.design(), after.design()) else { return Vec::new() };
    let devices = before.devices.iter().zip(&after.devices);
    let moved = devices.filter(|(old, new)| old.id.value != new.id.value);
    moved.map(|(_, new)| format!("{} {}", new.name.value, new.id.value)).collect()
}
