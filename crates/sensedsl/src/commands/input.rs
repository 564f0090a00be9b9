//! From a file on disk to a snapshot: the code shared by the commands that read a design.

use std::path::Path;
use std::time::{Duration, Instant};

use anyhow::{Result, bail};
use sensedsl_diagnostics::codes::{
    e0111_file_unreadable, e0226_not_an_answer, e0301_unknown_board, e0302_table_unreadable,
    e0313_unknown_target, e0505_unknown_host,
};
use sensedsl_diagnostics::{Diagnostic, Span};
use sensedsl_model::design::Design;
use sensedsl_model::{FileUse, ReadError};
use sensedsl_session::{Answer, Patience, Snapshot, Workspace, has_errors};
use sensedsl_wiring::assignment::Assignment;
use sensedsl_wiring::{Cancel, Keep};

use crate::cli::On;
use crate::files::{Disk, Refused, read_text, shown};
use crate::status::{Reported, Status};
use crate::terminal::Terminal;

/// How long `check` searches for the best wiring.
pub(super) const BEST_MAX: Duration = Duration::from_secs(2);

/// Reads a file and everything that it uses. A file that cannot be read becomes a diagnostic like any other.
pub(crate) fn load(path: &Path, on: &On) -> Snapshot {
    match read_text(path, FileUse::Sense) {
        Ok(text) => of_text(path, text, on),
        Err(Refused { diagnostic, sources }) => Snapshot::unread(*diagnostic, sources),
    }
}

/// Makes the snapshot of a file with this text; see [`load`].
pub(crate) fn of_text(path: &Path, text: String, on: &On) -> Snapshot {
    let shown = shown(path);
    let mut workspace = Workspace::default();
    workspace.open(&shown, text);
    let disk = Disk::of(path, &on.reach.allow_outside);
    workspace.snapshot(&shown, on.asked(), &disk)
}

/// The design and its wiring, for a command that cannot do without them.
///
/// # Errors
/// [`Reported`], once all errors have been reported.
pub(crate) fn wired<'a>(
    answer: &'a Answer<'_>,
    snapshot: &Snapshot,
    on: &On,
    terminal: &Terminal,
) -> Result<(&'a Design, &'a Assignment)> {
    let Some(wired) = answer.wired() else {
        terminal.diagnostics(&answer.diagnostics, snapshot.sources())?;
        bail!(Reported(status(&answer.diagnostics, on).max(Status::Wrong)));
    };
    Ok(wired)
}

/// The earlier answer of `--keep`.
pub(crate) fn keep(path: Option<&Path>) -> Result<Option<Keep>> {
    let Some(path) = path else { return Ok(None) };
    Ok(Some(keep_in(path, &read_text(path, FileUse::Answer)?)?))
}

/// The earlier answer in a text.
pub(crate) fn keep_in(path: &Path, text: &str) -> Result<Keep, Refused> {
    let keep = sensedsl_report::json::keep(&answer_in(path, text)?);
    keep.ok_or_else(|| not_an_answer(path, "boards, devices or wires are missing"))
}

/// An earlier answer in JSON.
pub(crate) fn answer_in(path: &Path, text: &str) -> Result<serde_json::Value, Refused> {
    if text.len() > FileUse::Answer.bytes_max() {
        return Err(Refused::unread(path, FileUse::Answer, &ReadError::TooLarge));
    }
    serde_json::from_str(text).map_err(|error| not_an_answer(path, &error.to_string()))
}

/// Reports that a file is not an answer of `solve`.
pub(crate) fn not_an_answer(path: &Path, why: &str) -> Refused {
    Refused::new(path, |at, shown| e0226_not_an_answer::not_an_answer(at, shown, why))
}

/// Whether the sound part of the design has a wiring. Warnings are about the best wiring, which `solve` gives, or about
/// the best one found in time.
pub(crate) fn feasible(snapshot: &Snapshot) -> Answer<'_> {
    let deadline = Instant::now() + BEST_MAX;
    let late = || Instant::now() >= deadline;
    snapshot.solve_best_or_any(Patience { late: Cancel::when(&late), stop: Cancel::NEVER })
}

/// The exit status for these diagnostics. It distinguishes a wrong input from a wrong call, such as a target that does
/// not exist or a `--board` that cannot be read.
pub(crate) fn status(diagnostics: &[Diagnostic], on: &On) -> Status {
    let by_call =
        [e0111_file_unreadable::CODE, e0313_unknown_target::CODE, e0505_unknown_host::CODE];
    let by_board = [e0301_unknown_board::CODE, e0302_table_unreadable::CODE];
    let misused = |one: &Diagnostic| {
        by_call.contains(&one.code) || (on.board.is_some() && by_board.contains(&one.code))
    };
    if diagnostics.iter().any(misused) {
        Status::Misused
    } else if has_errors(diagnostics) {
        Status::Wrong
    } else {
        Status::Done
    }
}

/// The name of the first board: the place for diagnostics about the whole design.
pub(crate) fn place(design: &Design) -> Span {
    let board = design.boards.first();
    board.map_or_else(|| Span::new(design.file, 0..0), |board| board.name.span)
}
