//! `sensedsl generate`: firmware, host applications, wiring sheet and picture.

use std::path::Path;

use anyhow::{Result, bail};
use sensedsl_diagnostics::codes::{
    e0502_foreign_files, e0503_out_of_date, e0505_unknown_host, e0507_folder_busy,
    e0509_not_written, e0510_unfinished, e0524_through_a_link, e0525_not_our_work,
    e0526_unproved_files,
};
use sensedsl_diagnostics::{Diagnostic, SourceMap, Span, visible};
use sensedsl_files::FileSet;
use sensedsl_generate::host::{HOSTS, find};
use sensedsl_generate::{Selection, target};
use sensedsl_job::{Target, host::Host};
use sensedsl_model::design::Design;
use sensedsl_model::{drop_allowed, sort};
use sensedsl_report::human;
use sensedsl_session::{Ask, has_errors};
use sensedsl_wiring::assignment::Assignment;

use super::input;
use super::interface;
use super::output::{self, Changes};
use crate::cli::{GenerateArgs, LeftOut};
use crate::files::tree::{Away, Failure, Output, Trouble};
use crate::files::{lock, shown};
use crate::status::Status;
use crate::terminal::Terminal;

/// The number of files named in one message.
const NAMED_MAX: usize = 5;

pub(crate) fn run(args: &GenerateArgs, terminal: &mut Terminal) -> Result<Status> {
    if !args.host.is_empty() && args.without.contains(&LeftOut::Host) {
        bail!("--host asks for what --without host leaves out");
    }
    made(args, terminal, &mut |made| match made.update(args, terminal)? {
        Ok(changes) => {
            report(args, terminal, made.design, made.assignment, &changes)?;
            Ok(Status::Done)
        }
        Err(status) => Ok(status),
    })
}

/// A design with everything that is generated from it.
pub(super) struct Made<'a> {
    pub(super) design: &'a Design,
    pub(super) assignment: &'a Assignment,
    pub(super) files: &'a FileSet,
    pub(super) sources: &'a SourceMap,
}

/// Generates everything, and passes it on if there are no errors.
pub(super) fn made(
    args: &GenerateArgs,
    terminal: &Terminal,
    then: &mut dyn FnMut(&Made<'_>) -> Result<Status>,
) -> Result<Status> {
    let keep = input::keep(args.keep.as_deref())?;
    let snapshot = input::load(&args.file, &args.on);
    let sources = snapshot.sources();
    let answer = snapshot.solve(&Ask { keep: keep.as_ref(), rise: args.neat, ..Ask::default() });
    let (design, assignment) = input::wired(&answer, &snapshot, &args.on, terminal)?;
    let mut diagnostics = answer.diagnostics.clone();
    let files = match files(args, design, assignment) {
        Ok(files) => files,
        Err(mut reports) => {
            drop_allowed(design, &mut reports);
            diagnostics.append(&mut reports);
            sort(&mut diagnostics);
            terminal.diagnostics(&diagnostics, sources)?;
            return Ok(input::status(&diagnostics, &args.on));
        }
    };
    terminal.diagnostics(&diagnostics, sources)?;
    if has_errors(&diagnostics) {
        return Ok(Status::Wrong);
    }
    then(&Made { design, assignment, files: &files, sources })
}

impl Made<'_> {
    /// Brings the folder up to date. If that is not possible, the reason has been reported.
    pub(super) fn update(
        &self,
        args: &GenerateArgs,
        terminal: &Terminal,
    ) -> Result<Result<Changes, Status>> {
        match update(args, terminal, self.design, self.files)? {
            Ok(changes) => Ok(Ok(changes)),
            Err(refusal) => {
                terminal.diagnostics(&[*refusal.why], self.sources)?;
                Ok(Err(refusal.status))
            }
        }
    }
}

/// All files to write. A gap in the firmware is an error: a user who can do without says so.
fn files(
    args: &GenerateArgs,
    design: &Design,
    assignment: &Assignment,
) -> Result<FileSet, Vec<Diagnostic>> {
    let hosts = hosts(args, design)?;
    let firmware = !args.without.contains(&LeftOut::Firmware);
    let wanted = Selection { firmware, hosts: &hosts };
    let name = design_name(&args.file);
    let made = sensedsl_generate::project(&name, design, assignment, &wanted);
    if made.gaps.is_empty() { Ok(made.files) } else { Err(made.gaps) }
}

/// The name of the design for people: that of its file.
fn design_name(file: &Path) -> String {
    let stem = file.file_stem().map(|stem| stem.to_string_lossy().into_owned());
    stem.filter(|stem| stem != "-").unwrap_or_else(|| "design".to_owned())
}

/// The reason why the folder was not written, or not properly.
struct Refusal {
    why: Box<Diagnostic>,
    status: Status,
}

impl Refusal {
    fn new(why: Diagnostic, status: Status) -> Self {
        Self { why: Box::new(why), status }
    }
}

/// Compares the folder with its new contents, and writes it unless only the comparison was
/// requested.
fn update(
    args: &GenerateArgs,
    terminal: &Terminal,
    design: &Design,
    files: &FileSet,
) -> Result<Result<Changes, Refusal>> {
    let (at, folder) = (input::place(design), shown(&args.output));
    if args.check {
        let changes = output::compare(&args.output, files)?;
        let why = foreign(at, &folder, &changes).or_else(|| out_of_date(at, &folder, &changes));
        return Ok(why.map_or(Ok(changes), |why| Err(Refusal::new(why, Status::Wrong))));
    }
    let mut waiting = || {
        // There is nowhere to report a failure to report.
        let _ = terminal.aside(&format!("waiting for another run that writes {folder}"));
    };
    let project = args.file.parent().unwrap_or(Path::new(""));
    let mut output = match Output::take(&args.output, project, lock::WAIT, &mut waiting) {
        Ok(output) => output,
        Err(trouble) => return trouble_taking(trouble, at, &folder).map(Err),
    };
    let changes = output::compare(output.root(), files)?;
    let why = foreign(at, &folder, &changes)
        .or_else(|| linked(at, &folder, &changes))
        .or_else(|| unproved(at, &folder, &changes).filter(|_| !args.adopt));
    if let Some(why) = why {
        return Ok(Err(Refusal::new(why, Status::Wrong)));
    }
    let to_change = interface::changes(output.root(), files, &changes.different);
    Ok(match output::write(&mut output, files, &changes) {
        Ok(()) => {
            for one in to_change {
                terminal.aside(&one)?;
            }
            Ok(changes)
        }
        Err(Failure::Before(error)) => {
            let why = e0509_not_written::not_written(at, &folder, &error.to_string());
            Err(Refusal::new(why, Status::Misused))
        }
        Err(Failure::After(error)) => {
            let why = e0509_not_written::not_completed(at, &folder, &error.to_string());
            Err(Refusal::new(why, Status::Misused))
        }
    })
}

fn trouble_taking(trouble: Trouble, at: Span, folder: &str) -> Result<Refusal> {
    let (why, status) = match trouble {
        Trouble::Failed(error) => return Err(error),
        Trouble::Busy => {
            let why = e0507_folder_busy::folder_busy(at, folder, lock::WAIT.as_secs());
            (why, Status::Misused)
        }
        Trouble::Orphan(left) => {
            (e0510_unfinished::unfinished(at, folder, &shown(&left)), Status::Wrong)
        }
        Trouble::Strange(left) => {
            (e0525_not_our_work::not_our_work(at, folder, &shown(&left)), Status::Wrong)
        }
        Trouble::Linked(Away { link, target }) => {
            let (link, target) = (shown(&link), shown(&target));
            (e0524_through_a_link::folder_is_elsewhere(at, &link, &target), Status::Wrong)
        }
        Trouble::Unwritten(error) => {
            (e0509_not_written::not_written(at, folder, &error.to_string()), Status::Misused)
        }
        Trouble::Unrecovered(error) => {
            (e0509_not_written::not_completed(at, folder, &error.to_string()), Status::Misused)
        }
    };
    Ok(Refusal::new(why, status))
}

fn hosts(args: &GenerateArgs, design: &Design) -> Result<Vec<&'static dyn Host>, Vec<Diagnostic>> {
    if args.without.contains(&LeftOut::Host) {
        return Ok(Vec::new());
    }
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

/// Reports files in the folder that were not generated.
fn foreign(at: Span, folder: &str, changes: &Changes) -> Option<Diagnostic> {
    let files = (!changes.foreign.is_empty()).then(|| some(&changes.foreign))?;
    Some(e0502_foreign_files::foreign_files(at, folder, &files))
}

/// Reports files that would be written through links.
fn linked(at: Span, folder: &str, changes: &Changes) -> Option<Diagnostic> {
    let files = (!changes.linked.is_empty()).then(|| some(&changes.linked))?;
    Some(e0524_through_a_link::files_are_elsewhere(at, folder, &files))
}

/// Reports files that would be lost although nothing proves that they were generated.
fn unproved(at: Span, folder: &str, changes: &Changes) -> Option<Diagnostic> {
    let files = (!changes.unproved.is_empty()).then(|| some(&changes.unproved))?;
    Some(e0526_unproved_files::unproved_files(at, folder, &files))
}

/// Reports that the folder is not what would be written.
fn out_of_date(at: Span, folder: &str, changes: &Changes) -> Option<Diagnostic> {
    if changes.is_up_to_date() {
        return None;
    }
    let parts = [
        ("missing", &changes.missing),
        ("different", &changes.different),
        ("behind a link", &changes.linked),
        ("no longer made", &changes.stale),
    ];
    let parts: Vec<String> = parts
        .iter()
        .filter(|(_, files)| !files.is_empty())
        .map(|(what, files)| format!("{what}: {}", some(files)))
        .collect();
    Some(e0503_out_of_date::out_of_date(at, folder, &parts.join("; ")))
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
    terminal.coloured_note(&human::human(design, assignment, terminal.colour()))?;
    let folder = shown(&args.output);
    let folder = visible(&folder);
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
    if args.without.contains(&LeftOut::Firmware) {
        return Ok(());
    }
    let targets = assignment.used(design).filter_map(|(_, board)| target::of(board.profile()?));
    let option = targets.map(<dyn Target>::build_option).max().unwrap_or_default();
    let folder = output::typed(&args.output, "");
    terminal.note(&format!("next: sensedsl build {folder}{option}\n"))?;
    Ok(())
}
