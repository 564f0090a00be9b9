//! From a file on disk to a design: what check, solve and generate have in common.

use std::path::Path;
use std::time::{Duration, Instant};

use anyhow::Result;
use sensedsl_certify::Subject;
use sensedsl_diagnostics::codes::{
    e0111_file_unreadable, e0226_not_an_answer, e0301_unknown_board, e0302_table_unreadable,
    e0313_unknown_target, e0404_out_of_time, e0505_unknown_host,
};
use sensedsl_diagnostics::{Diagnostic, Severity, Span};
use sensedsl_model::design::Design;
use sensedsl_model::{Request, Resolved, Unread, What, apply_allows, resolve, sort};
use sensedsl_wiring::{Cancel, Keep, Proved, Search, Solved, Wiring};

use crate::Status;
use crate::cli::On;
use crate::files::{Disk, Refused, read_text, shown};

/// How long `check` looks for the best wiring.
const BEST: Duration = Duration::from_secs(2);

/// Reads and resolves a file. That it cannot be read is a diagnostic like any other.
pub(crate) fn load(path: &Path, on: &On) -> Resolved {
    match read_text(path, What::Sense) {
        Ok(text) => resolved(path, &text, on),
        Err(Refused { diagnostic, sources }) => {
            Resolved { design: None, diagnostics: vec![*diagnostic], sources, files: Vec::new() }
        }
    }
}

/// Resolves the text of a file.
pub(crate) fn resolved(path: &Path, text: &str, on: &On) -> Resolved {
    let shown = shown(path);
    let request =
        Request { path: &shown, text, board: on.board.as_deref(), target: on.target.as_deref() };
    resolve(&request, &Disk::of(path, &on.reach.allow_outside))
}

/// The earlier answer of `--keep`.
pub(crate) fn keep(path: Option<&Path>) -> Result<Option<Keep>> {
    let Some(path) = path else { return Ok(None) };
    Ok(Some(keep_in(path, &read_text(path, What::Answer)?)?))
}

/// The earlier answer in a text.
pub(crate) fn keep_in(path: &Path, text: &str) -> Result<Keep, Refused> {
    let keep = sensedsl_report::json::keep(&answer_in(path, text)?);
    keep.ok_or_else(|| not_an_answer(path, "boards, devices or wires are missing"))
}

/// An earlier answer in JSON.
pub(crate) fn answer_in(path: &Path, text: &str) -> Result<serde_json::Value, Refused> {
    if text.len() > What::Answer.bytes_max() {
        return Err(Refused::unread(path, What::Answer, &Unread::TooLarge));
    }
    serde_json::from_str(text).map_err(|error| not_an_answer(path, &error.to_string()))
}

/// That a file is not an answer of `solve`.
pub(crate) fn not_an_answer(path: &Path, why: &str) -> Refused {
    Refused::new(path, |at, shown| e0226_not_an_answer::not_an_answer(at, shown, why))
}

/// What one search gave, with everything there is to say.
pub(crate) struct Answer {
    pub(crate) solved: Option<Solved>,
    /// The text that proves it, or why there is none; where one was asked for.
    pub(crate) certificate: Option<Result<String, Box<Diagnostic>>>,
    pub(crate) diagnostics: Vec<Diagnostic>,
}

/// Solves a design unless single devices are hopeless already, and collects all diagnostics.
pub(crate) fn solve(
    design: &Design,
    diagnostics: Vec<Diagnostic>,
    keep: Option<&Keep>,
    search: &Search,
    cancel: Cancel<'_>,
) -> Answer {
    answer(design, diagnostics, keep, cancel, |wiring| Proved {
        solved: wiring.solve(search),
        certificate: None,
    })
}

/// Whether there is a wiring. Warnings speak of the best one, which `solve` gives, or of the best
/// that was found when that takes long.
pub(crate) fn feasible(design: &Design, diagnostics: Vec<Diagnostic>) -> Answer {
    let deadline = Instant::now() + BEST;
    let late = || Instant::now() >= deadline;
    let best = Search { any: false };
    let answer = solve(design, diagnostics.clone(), None, &best, Cancel::when(&late));
    match &answer.solved {
        Some(Solved::Failed(why)) if why.code.info() == &e0404_out_of_time::INFO => {
            solve(design, diagnostics, None, &Search { any: true }, Cancel::NEVER)
        }
        _ => answer,
    }
}

/// As [`solve`], with a certificate.
pub(crate) fn prove(
    design: &Design,
    diagnostics: Vec<Diagnostic>,
    keep: Option<&Keep>,
    of: &Subject,
    cancel: Cancel<'_>,
) -> Answer {
    answer(design, diagnostics, keep, cancel, |wiring| wiring.solve_with_proof(of))
}

fn answer(
    design: &Design,
    mut diagnostics: Vec<Diagnostic>,
    keep: Option<&Keep>,
    cancel: Cancel<'_>,
    ask: impl FnOnce(&Wiring<'_>) -> Proved,
) -> Answer {
    let wiring = Wiring::within(design, keep, cancel);
    diagnostics.extend(wiring.check());
    let proved = (!has_errors(&diagnostics)).then(|| ask(&wiring));
    let (solved, certificate) = match proved {
        Some(Proved { solved, certificate }) => (Some(solved), certificate),
        None => (None, None),
    };
    match &solved {
        Some(Solved::Wired(assignment)) => {
            diagnostics.extend(wiring.warnings(assignment));
            diagnostics.extend(sensedsl_timing::check(design, assignment));
        }
        Some(Solved::Infeasible(conflict)) => diagnostics.push(conflict.diagnostic(design)),
        Some(Solved::Failed(failure)) => diagnostics.push((**failure).clone()),
        None => {}
    }
    apply_allows(design, &mut diagnostics);
    sort(&mut diagnostics);
    Answer { solved, certificate, diagnostics }
}

/// How a command ends whose diagnostics are these: a wrong input is told from a wrong call, such as
/// a target that does not exist or a `--board` that cannot be read.
pub(crate) fn status(diagnostics: &[Diagnostic], on: &On) -> Status {
    let by_call =
        [&e0111_file_unreadable::INFO, &e0313_unknown_target::INFO, &e0505_unknown_host::INFO];
    let by_board = [&e0301_unknown_board::INFO, &e0302_table_unreadable::INFO];
    let misused = |one: &Diagnostic| {
        let info = one.code.info();
        by_call.contains(&info) || (on.board.is_some() && by_board.contains(&info))
    };
    if diagnostics.iter().any(misused) {
        Status::Misused
    } else if has_errors(diagnostics) {
        Status::Wrong
    } else {
        Status::Done
    }
}

/// Whether anything makes the input unusable.
pub(crate) fn has_errors(diagnostics: &[Diagnostic]) -> bool {
    diagnostics.iter().any(|one| one.severity == Severity::Error)
}

/// The first board's name: the place of what concerns the whole design.
pub(crate) fn place(design: &Design) -> Span {
    let board = design.boards.first();
    board.map_or_else(|| Span::new(design.file, 0..0), |board| board.name.span)
}
