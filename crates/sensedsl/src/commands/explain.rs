//! `sensedsl explain`: the long text of a diagnostic, why a device is on its pin, or how long everything takes.

use anyhow::{Context as _, Result, bail};
use sensedsl_diagnostics::codes::ALL;
use sensedsl_diagnostics::{Code, CodeInfo, nearest, render};
use sensedsl_model::design::{ConnectionIndex, Design};
use sensedsl_session::Ask;
use sensedsl_wiring::{Alternative, Cancel, Wiring};
use serde_json::{Value, json};

use super::deadline::Deadline;
use super::input;
use super::why;
use crate::cli::{ExplainArgs, TableFormat};
use crate::status::Status;
use crate::terminal::Terminal;

pub(crate) fn run(args: &ExplainArgs, terminal: &mut Terminal) -> Result<Status> {
    match args.subject.as_deref() {
        Some("wiring") => wiring(args, terminal),
        Some("timing") => super::timing::run(args, terminal),
        Some(name) if args.file.is_none() => code(name, terminal),
        Some(name) => bail!("`explain {name}` takes no file; did you mean `explain wiring`?"),
        None => {
            let lines = ALL.iter().map(|code| format!("{code}  {}\n", code.info().title));
            terminal.result(&lines.collect::<String>())?;
            Ok(Status::Done)
        }
    }
}

fn code(name: &str, terminal: &Terminal) -> Result<Status> {
    let Some(code) = Code::find(name) else {
        let meant = nearest(name, ALL.iter().map(|code| code.name()));
        let meant = meant.map_or(String::new(), |meant| format!("; did you mean {meant}?"));
        bail!("there is no diagnostic {name}{meant} (`sensedsl explain` lists them)");
    };
    let CodeInfo { code, title, explanation } = code.info();
    terminal.result(&format!("{code}: {title}\n\n{explanation}\n"))?;
    Ok(Status::Done)
}

fn wiring(args: &ExplainArgs, terminal: &Terminal) -> Result<Status> {
    let file =
        args.file.as_deref().context("`explain wiring` needs a file and a device or a chip")?;
    let name =
        args.device.as_deref().context("`explain wiring` needs the name of a device or a chip")?;
    let deadline = Deadline::after(args.timeout);
    let over = || deadline.is_over();
    let cancel = Cancel::when(&over);
    let snapshot = input::load(file, &args.on);
    // A misspelled name is reported before anything is solved.
    snapshot.design().map(|design| connections(design, name)).transpose()?;
    let answer = snapshot.solve(&Ask { cancel, rise: args.neat, ..Ask::default() });
    let (design, wiring) = input::wired(&answer, &snapshot, &args.on, terminal)?;
    let found = Wiring::within(design, None, cancel).why(wiring, &connections(design, name)?);
    let alternatives = found.all;
    if !found.complete {
        terminal.aside("stopped: there may be more pins that were not looked at")?;
    }
    match args.format {
        TableFormat::Human => {
            let print = if args.all { why::all } else { why::summary };
            terminal.result(&print(design, wiring, &alternatives))?;
        }
        TableFormat::Json => {
            let list: Vec<Value> = alternatives.iter().map(value).collect();
            let all = json!({
                "version": 1,
                "device": name,
                "complete": found.complete,
                "alternatives": list,
            });
            terminal.result(&render::json_text(&all))?;
        }
    }
    Ok(Status::Done)
}

/// The connections of the device or chip with that name.
fn connections(design: &Design, name: &str) -> Result<Vec<ConnectionIndex>> {
    if let Some(device) = design.devices.iter().find(|one| one.name.value == name) {
        return Ok(device.connections.clone());
    }
    if let Some(part) = design.parts.iter().position(|one| one.name.value == name) {
        let all = design.connections.iter().enumerate();
        let own = all.filter(|(_, one)| one.part.0 == part);
        return Ok(own.map(|(index, _)| ConnectionIndex(index)).collect());
    }
    let devices = design.devices.iter().map(|device| device.name.value.as_str());
    let names = devices.chain(design.parts.iter().map(|part| part.name.value.as_str()));
    let meant = nearest(name, names);
    let meant = meant.map_or(String::new(), |meant| format!("; did you mean {meant}?"));
    bail!("the file has no device or chip {name}{meant}")
}

fn value(one: &Alternative) -> Value {
    json!({
        "role": one.wire,
        "board": one.board,
        "pin": one.pin,
        "signal": one.signal,
        "usages": one.usages,
        "chosen": one.chosen,
        "violated": one.best.map(|best| best.violated),
        "shared": one.best.map(|best| best.shared),
        "shared_with": one.shared_with,
        "cost": one.best.map(|best| best.cost),
    })
}
