//! `sensedsl generate`: firmware, host applications, wiring sheet and picture.

use anyhow::Result;
use sensedsl_codegen::host::{HOSTS, Host, find};
use sensedsl_codegen::report::human;
use sensedsl_diagnostics::Diagnostic;
use sensedsl_diagnostics::codes::{e0502_foreign_files, e0503_out_of_date, e0505_unknown_host};
use sensedsl_model::design::Design;
use sensedsl_model::{apply_allows, sort};
use sensedsl_wiring::assignment::Assignment;
use sensedsl_wiring::{Search, Solved};

use super::input;
use super::output::{self, Changes};
use crate::Status;
use crate::cli::GenerateArgs;
use crate::files::shown;
use crate::terminal::Terminal;

/// Names of files in one message.
const NAMED_MAX: usize = 5;

pub(crate) fn run(args: &GenerateArgs, terminal: &mut Terminal) -> Result<Status> {
    let keep = input::keep(args.keep.as_deref())?;
    let resolved = input::load(&args.file, &args.on)?;
    let sources = resolved.sources;
    let Some(design) = &resolved.design else {
        terminal.diagnostics(&resolved.diagnostics, &sources)?;
        return Ok(input::status(&resolved.diagnostics, &args.on));
    };
    let answer = input::solve(design, resolved.diagnostics, keep.as_ref(), &Search::default());
    let mut diagnostics = answer.diagnostics;
    let Some(Solved::Wired(assignment)) = answer.solved else {
        terminal.diagnostics(&diagnostics, &sources)?;
        return Ok(Status::Wrong);
    };
    let files = hosts(args, design)
        .and_then(|hosts| sensedsl_codegen::project(design, &assignment, &hosts));
    let files = match files {
        Ok(files) => files,
        Err(mut reports) => {
            diagnostics.append(&mut reports);
            apply_allows(design, &mut diagnostics);
            sort(&mut diagnostics);
            terminal.diagnostics(&diagnostics, &sources)?;
            return Ok(input::status(&diagnostics, &args.on));
        }
    };
    terminal.diagnostics(&diagnostics, &sources)?;
    if input::has_errors(&diagnostics) {
        return Ok(Status::Wrong);
    }
    let changes = output::compare(&args.output, &files)?;
    if let Some(refusal) = refusal(args, design, &changes) {
        terminal.diagnostics(&[refusal], &sources)?;
        return Ok(Status::Wrong);
    }
    if !args.check {
        output::write(&args.output, &files, &changes)?;
    }
    report(args, terminal, design, &assignment, &changes)?;
    Ok(Status::Done)
}

fn hosts(args: &GenerateArgs, design: &Design) -> Result<Vec<&'static dyn Host>, Vec<Diagnostic>> {
    if args.host.is_empty() {
        return Ok(HOSTS.to_vec());
    }
    let known: Vec<&str> = HOSTS.iter().map(|host| host.name()).collect();
    let mut hosts: Vec<&'static dyn Host> = Vec::new();
    let mut unknown = Vec::new();
    for name in &args.host {
        match find(name) {
            Some(host) if hosts.iter().any(|one| one.name() == host.name()) => {}
            Some(host) => hosts.push(host),
            None => {
                let at = input::place(design);
                unknown.push(e0505_unknown_host::unknown_host(at, name, &known.join(", ")));
            }
        }
    }
    if unknown.is_empty() { Ok(hosts) } else { Err(unknown) }
}

/// Why the folder is not written, or not as it should be.
fn refusal(args: &GenerateArgs, design: &Design, changes: &Changes) -> Option<Diagnostic> {
    let (at, folder) = (input::place(design), shown(&args.output));
    if !changes.foreign.is_empty() {
        let files = some(&changes.foreign);
        return Some(e0502_foreign_files::foreign_files(at, &folder, &files));
    }
    if !args.check || changes.is_up_to_date() {
        return None;
    }
    let parts = [
        ("missing", &changes.missing),
        ("different", &changes.different),
        ("no longer made", &changes.stale),
    ];
    let parts: Vec<String> = parts
        .iter()
        .filter(|(_, files)| !files.is_empty())
        .map(|(what, files)| format!("{what}: {}", some(files)))
        .collect();
    Some(e0503_out_of_date::out_of_date(at, &folder, &parts.join("; ")))
}

/// The first few names.
fn some(files: &[String]) -> String {
    let named: Vec<&str> = files.iter().take(NAMED_MAX).map(String::as_str).collect();
    let more = files.len().saturating_sub(NAMED_MAX);
    let tail = if more > 0 { format!(" and {more} more") } else { String::new() };
    format!("{}{tail}", named.join(", "))
}

fn report(
    args: &GenerateArgs,
    terminal: &Terminal,
    design: &Design,
    assignment: &Assignment,
    changes: &Changes,
) -> Result<()> {
    terminal.note(&human::human(design, assignment, terminal.colour()))?;
    let folder = shown(&args.output);
    if args.check {
        terminal.note(&format!("\n{folder} is up to date\n"))?;
        return Ok(());
    }
    let written = changes.missing.len() + changes.different.len();
    terminal.note(&format!(
        "\nwrote {written} files to {folder} ({} unchanged, {} removed)\n",
        changes.same,
        changes.stale.len()
    ))?;
    if terminal.verbose() {
        for path in changes.missing.iter().chain(&changes.different) {
            terminal.note(&format!("  {path}\n"))?;
        }
        for path in &changes.stale {
            terminal.note(&format!("  {path} (removed)\n"))?;
        }
    }
    terminal.note(&format!("  wiring   {}\n", output::typed(&args.output, "wiring.md")))?;
    terminal.note(&format!("  picture  {}\n", output::typed(&args.output, "pinout.svg")))?;
    terminal.note("next:\n")?;
    for (_, board) in assignment.used(design) {
        let folder = output::typed(&args.output, &format!("firmware/{}", board.name.value));
        terminal.note(&format!("  make -C {folder} CHIBIOS=/path/to/ChibiOS\n"))?;
    }
    Ok(())
}
