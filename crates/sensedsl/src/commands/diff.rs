//! `sensedsl diff`: what changes on the bench from one wiring to another.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use anyhow::Result;
use sensedsl_diagnostics::render;
use sensedsl_model::FileUse;
use sensedsl_report::diff::{Change, Place, Wire, changes, wires};
use sensedsl_report::json::wired;
use sensedsl_session::Ask;
use serde_json::{Value, json};

use super::input;
use super::table::table;
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
            let list: Vec<Value> = changes.iter().map(Change::value).collect();
            let all = json!({ "version": 1, "changes": list });
            terminal.result(&render::json_text(&all))?;
        }
        TableFormat::Human if changes.is_empty() => terminal.result("nothing changes\n")?,
        TableFormat::Human => terminal.result(&human(&changes, new.len()))?,
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

pub(super) fn human(changes: &[Change], wires: usize) -> String {
    let places = changes.iter().flat_map(|change| [&change.from, &change.to]).flatten();
    let boards: BTreeSet<&str> = places.map(|place| place.board.as_str()).collect();
    let place = |place: &Option<Place>| match place {
        None => "-".to_owned(),
        Some(Place { pin, signal, .. }) if boards.len() == 1 => format!("{pin} ({signal})"),
        Some(Place { board, pin, signal }) => format!("{board} {pin} ({signal})"),
    };
    let rows: Vec<[String; 5]> = changes
        .iter()
        .map(|change| {
            let Change { wire, from, to } = change;
            let (device, role) = (wire.device.clone(), wire.role.clone());
            [change.name().to_owned(), device, role, place(from), place(to)]
        })
        .collect();
    let heads = ["Change", "Device", "Role", "From", "To"];
    let text = table(heads, &rows);
    format!("{text}\n{} of {wires} wires change\n", changes.len())
}
