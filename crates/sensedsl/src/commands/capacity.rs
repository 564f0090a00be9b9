//! `sensedsl capacity`: what can still be added, and what blocks the next device.

use anyhow::Result;
use sensedsl_diagnostics::render;
use sensedsl_model::design::Design;
use sensedsl_model::kind::KindName;
use sensedsl_session::Ask;
use sensedsl_wiring::{Cancel, Capacity, capacity};
use serde_json::{Value, json};

use super::deadline::Deadline;
use super::input;
use super::table::table;
use crate::cli::{CapacityArgs, TableFormat};
use crate::status::Status;
use crate::terminal::Terminal;

/// The number of blockers named in one line.
const NAMED_MAX: usize = 8;

pub(crate) fn run(args: &CapacityArgs, terminal: &mut Terminal) -> Result<Status> {
    let deadline = Deadline::after(args.timeout);
    let over = || deadline.is_over();
    let cancel = Cancel::when(&over);
    let snapshot = input::load(&args.file, &args.on);
    let answer = snapshot.solve(&Ask { cancel, ..Ask::default() });
    let (design, wiring) = input::wired(&answer, &snapshot, &args.on, terminal)?;
    let found = capacity(design, wiring, args.rearrange, cancel);
    let capacities = found.all;
    if !found.complete {
        let all = design.boards.len() * KindName::ALL.len();
        let open = all - capacities.len();
        terminal.aside(&format!("stopped: {open} of {all} were not looked at"))?;
    }
    match args.format {
        TableFormat::Human => terminal.result(&human(design, &capacities))?,
        TableFormat::Json => {
            let list: Vec<Value> = capacities.iter().map(|one| value(design, one)).collect();
            let all = json!({ "version": 1, "complete": found.complete, "capacity": list });
            terminal.result(&render::json_text(&all))?;
        }
    }
    Ok(Status::Done)
}

fn board_name<'a>(design: &'a Design, one: &Capacity) -> &'a str {
    design.board(one.board).map_or("", |board| board.name.value.as_str())
}

fn value(design: &Design, one: &Capacity) -> Value {
    json!({
        "board": board_name(design, one),
        "kind": one.kind.name(),
        "more": one.more,
        "blocked_by": one.blocked_by,
    })
}

fn human(design: &Design, capacities: &[Capacity]) -> String {
    let rows: Vec<[String; 4]> = capacities
        .iter()
        .map(|one| {
            let mut blockers: Vec<&str> =
                one.blocked_by.iter().take(NAMED_MAX).map(String::as_str).collect();
            if one.blocked_by.len() > NAMED_MAX {
                blockers.push("…");
            }
            [
                board_name(design, one).to_owned(),
                one.kind.name().to_owned(),
                one.more.to_string(),
                blockers.join(" "),
            ]
        })
        .collect();
    table(["Board", "Kind", ">More", "Next one lacks"], &rows)
}
