//! `sensedsl diff`: what changes on the bench from one wiring to another.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use anyhow::Result;
use sensedsl_diagnostics::render;
use sensedsl_model::What;
use sensedsl_report::json::wired;
use sensedsl_session::Ask;
use serde_json::{Value, json};

use super::input;
use super::table::table;
use crate::Status;
use crate::cli::{DiffArgs, On, TableFormat};
use crate::files::read_text;
use crate::terminal::Terminal;

/// A wire of a device, by name and role.
type Wire = (String, String);
/// Where it is: board, pin and signal.
type Place = (String, String, String);

pub(crate) fn run(args: &DiffArgs, terminal: &mut Terminal) -> Result<Status> {
    let (Some(old), Some(new)) =
        (wires(&args.old, &args.on, terminal)?, wires(&args.new, &args.on, terminal)?)
    else {
        return Ok(Status::Wrong);
    };
    let all: BTreeSet<&Wire> = old.keys().chain(new.keys()).collect();
    let changes: Vec<(&Wire, Option<&Place>, Option<&Place>)> = all
        .into_iter()
        .map(|wire| (wire, old.get(wire), new.get(wire)))
        .filter(|(_, before, after)| before != after)
        .collect();
    match args.format {
        TableFormat::Json => {
            let list: Vec<Value> = changes.iter().map(|change| value(*change)).collect();
            let all = json!({ "version": 1, "changes": list });
            terminal.result(&render::json_text(&all))?;
        }
        TableFormat::Human if changes.is_empty() => terminal.result("nothing changes\n")?,
        TableFormat::Human => terminal.result(&human(&changes, new.len()))?,
    }
    Ok(Status::Done)
}

fn change_name(before: Option<&Place>, after: Option<&Place>) -> &'static str {
    match (before, after) {
        (None, _) => "added",
        (Some(_), None) => "removed",
        (Some((board, pin, _)), Some((new_board, new_pin, _)))
            if board == new_board && pin == new_pin =>
        {
            "reconfigured"
        }
        (Some(_), Some(_)) => "moved",
    }
}

fn place_value(place: Option<&Place>) -> Value {
    place.map_or(
        Value::Null,
        |(board, pin, signal)| json!({ "board": board, "pin": pin, "signal": signal }),
    )
}

fn value(((device, role), before, after): (&Wire, Option<&Place>, Option<&Place>)) -> Value {
    json!({
        "change": change_name(before, after),
        "device": device,
        "role": role,
        "from": place_value(before),
        "to": place_value(after),
    })
}

fn human(changes: &[(&Wire, Option<&Place>, Option<&Place>)], wires: usize) -> String {
    let places = changes.iter().flat_map(|(_, before, after)| [*before, *after]).flatten();
    let boards: BTreeSet<&str> = places.map(|(board, ..)| board.as_str()).collect();
    let place = |place: Option<&Place>| match place {
        None => "-".to_owned(),
        Some((_, pin, signal)) if boards.len() == 1 => format!("{pin} ({signal})"),
        Some((board, pin, signal)) => format!("{board} {pin} ({signal})"),
    };
    let rows: Vec<[String; 5]> = changes
        .iter()
        .map(|((device, role), before, after)| {
            [
                change_name(*before, *after).to_owned(),
                device.clone(),
                role.clone(),
                place(*before),
                place(*after),
            ]
        })
        .collect();
    let heads =
        [("Change", false), ("Device", false), ("Role", false), ("From", false), ("To", false)];
    let text = table(heads, &rows);
    format!("{text}\n{} of {wires} wires change\n", changes.len())
}

/// The wires of an answer; none, and said why, when there is no wiring.
fn wires(path: &Path, on: &On, terminal: &Terminal) -> Result<Option<BTreeMap<Wire, Place>>> {
    let text = read_text(path, What::Sense)?;
    if text.trim_start().starts_with('{') {
        let wires = of_json(&input::answer_in(path, &text)?);
        let missing = || input::not_an_answer(path, "boards, devices or wires are missing");
        return Ok(Some(wires.ok_or_else(missing)?));
    }
    let snapshot = input::of_text(path, text, on);
    let answer = snapshot.solve(&Ask::default());
    let (design, wiring) = input::wired(&answer, &snapshot, on, terminal)?;
    Ok(of_json(&wired(design, wiring)))
}

fn of_json(value: &Value) -> Option<BTreeMap<Wire, Place>> {
    let mut wires = BTreeMap::new();
    let text = |value: &Value, key: &str| Some(value.get(key)?.as_str()?.to_owned());
    for board in value.get("boards")?.as_array()? {
        let board_name = text(board, "name")?;
        for device in board.get("devices")?.as_array()? {
            let name = text(device, "name")?;
            for wire in device.get("wires")?.as_array()? {
                let place = (board_name.clone(), text(wire, "pin")?, text(wire, "signal")?);
                wires.insert((name.clone(), text(wire, "role")?), place);
            }
        }
    }
    Some(wires)
}
