//! `sensedsl diff`: what changes on the bench from one wiring to another.

use std::collections::BTreeMap;
use std::path::Path;

use anyhow::Result;
use sensedsl_diagnostics::render;
use sensedsl_model::FileUse;
use sensedsl_report::diff as report;
use sensedsl_report::diff::{Place, Wire, changes, wires};
use sensedsl_report::json::wired;
use sensedsl_session::Ask;

use super::input;
use crate::cli::{DiffArgs, On, TableFormat};
use crate::files::read_text;
use crate::status::Status;
use crate::terminal::Terminal;

pub(crate) fn run(args: &DiffArgs, terminal: &mut Terminal) -> Result<Status> {
    // Errors in either file are reported before the command gives up.
    let old = wires_of(&args.old, &args.on, terminal);
    let new = wires_of(&args.new, &args.on, terminal);
    let (old, new) = (old?, new?);
    let changes = changes(&old, &new);
    match args.format {
        TableFormat::Json => {
            terminal.result(&render::json_text(&report::value(&changes)))?;
        }
        TableFormat::Human => terminal.result(&report::human(&changes, new.len()))?,
    }
    Ok(Status::Done)
}

/// The wires of an answer, or of a file that is solved.
fn wires_of(path: &Path, on: &On, terminal: &Terminal) -> Result<BTreeMap<Wire, Place>> {
    let text = read_text(path, FileUse::Sense)?;
    let answer = if text.trim_start().starts_with('{') {
        input::answer_in(path, &text)?
    } else {
        let snapshot = input::of_text(path, text, on);
        let answer = snapshot.solve(&Ask::default());
        let (design, wiring) = input::wired(&answer, &snapshot, on, terminal)?;
        wired(design, wiring)
    };
    let missing = || input::not_an_answer(path, "boards, devices or wires are missing");
    Ok(wires(&answer).ok_or_else(missing)?)
}
