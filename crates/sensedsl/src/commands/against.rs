//! `sensedsl parts FILE --against PART`: what moves, what is gained and what is lost on another part or board.

use std::collections::BTreeMap;
use std::path::Path;

use anyhow::{Result, bail};
use sensedsl_diagnostics::render;
use sensedsl_model::FileUse;
use sensedsl_model::kind::KindName;
use sensedsl_report::diff::{Change, Place, Wire, changes, wires};
use sensedsl_report::json::wired;
use sensedsl_session::Ask;
use sensedsl_wiring::{Cancel, capacity};
use serde_json::{Value, json};

use super::facts::{Facts, units};
use super::input;
use crate::cli::{On, PartsArgs, TableFormat};
use crate::files::read_text;
use crate::status::Status;
use crate::terminal::Terminal;
use sensedsl_report::columns::table;

/// The file's devices on a part or board.
struct Side {
    name: String,
    system: String,
    facts: Facts,
    cost: u32,
    wires: BTreeMap<Wire, Place>,
    /// How many more devices of a kind there is room for, if the wires stay where they are.
    more: Vec<(KindName, usize)>,
}

pub(super) fn run(
    args: &PartsArgs,
    file: &Path,
    other: &str,
    terminal: &mut Terminal,
) -> Result<Status> {
    let on = |board: Option<&str>| On {
        board: board.map(str::to_owned),
        target: args.target.clone(),
        reach: args.reach.clone(),
    };
    // Read once: it may be the standard input.
    let text = read_text(file, FileUse::Sense)?;
    let here = side((file, &text), &on(None), terminal)?;
    let there = side((file, &text), &on(Some(other)), terminal)?;
    let changes = changes(&here.wires, &there.wires);
    match args.format {
        TableFormat::Human => terminal.result(&human([&here, &there], &changes))?,
        TableFormat::Json => {
            let list: Vec<Value> = changes.iter().map(Change::value).collect();
            let sides = [here, there].map(|side| side.value());
            let all = json!({ "version": 1, "parts": sides, "changes": list });
            terminal.result(&render::json_text(&all))?;
        }
    }
    Ok(Status::Done)
}

fn side((file, text): (&Path, &str), on: &On, terminal: &Terminal) -> Result<Side> {
    let snapshot = input::of_text(file, text.to_owned(), on);
    let answer = snapshot.solve(&Ask::default());
    let (design, wiring) = input::wired(&answer, &snapshot, on, terminal)?;
    let [board] = design.boards.as_slice() else {
        bail!("--against is for files with one board; this one has {}", design.boards.len());
    };
    let mcu = board.mcu.clone().unwrap_or_default();
    let built_in = board.facts.as_ref().filter(|_| board.built_in);
    let room = capacity(design, wiring, false, Cancel::NEVER);
    let answer = wired(design, wiring);
    let Some(wires) = wires(&answer) else { bail!("the answer has no wires; please report this") };
    Ok(Side {
        name: built_in.map_or_else(|| mcu.clone(), |facts| facts.name.clone()),
        system: board.profile().map_or("none", |profile| profile.name.as_str()).to_owned(),
        facts: Facts::of_mcu(&mcu),
        cost: wiring.cost,
        wires,
        more: room.all.iter().map(|one| (one.kind, one.more)).collect(),
    })
}

impl Side {
    fn value(&self) -> Value {
        let more: serde_json::Map<String, Value> =
            self.more.iter().map(|(kind, more)| (kind.name().to_owned(), json!(more))).collect();
        let own = [
            ("target", json!(self.system)),
            ("cost", json!(self.cost)),
            ("more", Value::Object(more)),
        ];
        self.facts.json(&self.name, own)
    }

    fn more(&self, kind: KindName) -> usize {
        self.more.iter().find(|(one, _)| *one == kind).map_or(0, |(_, more)| *more)
    }
}

fn human([here, there]: [&Side; 2], changes: &[Change]) -> String {
    let row = |what: &str, here: String, there: String| [what.to_owned(), here, there];
    let cells = [here.facts.cells(), there.facts.cells()];
    let [one, other] = cells;
    let names = ["Package", "Core", "Flash", "RAM"];
    let facts = names.into_iter().zip(one.into_iter().zip(other));
    let mut rows: Vec<[String; 3]> =
        facts.map(|(what, (here, there))| row(what, here, there)).collect();
    rows.push(row("Target", here.system.clone(), there.system.clone()));
    rows.push(row("Cost", here.cost.to_string(), there.cost.to_string()));
    let kinds = KindName::wired().map(|kind| (kind, here.more(kind), there.more(kind)));
    let room = kinds.filter(|(_, here, there)| here != there);
    rows.extend(room.map(|(kind, here, there)| {
        row(&format!("Room for {}", kind.name()), here.to_string(), there.to_string())
    }));
    let heads = ["", &*format!(">{}", here.name), &*format!(">{}", there.name)];
    let moved = match changes {
        [] => "no wire moves\n".to_owned(),
        some => sensedsl_report::diff::human(some, there.wires.len()),
    };
    format!(
        "{}\n{}; room: how many more devices fit while these wires stay, where it differs\n\n{moved}",
        table(heads, &rows),
        units([&here.facts, &there.facts].into_iter())
    )
}
