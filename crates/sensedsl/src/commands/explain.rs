//! `sensedsl explain`: the long text of a diagnostic, why a device is on its pin, or how long everything takes.

use anyhow::{Context as _, Result, anyhow, bail};
use sensedsl_diagnostics::codes::ALL;
use sensedsl_diagnostics::{Code, CodeInfo, nearest, render};
use sensedsl_model::design::{ConnectionIndex, Design};
use sensedsl_report::why;
use sensedsl_session::Ask;
use sensedsl_wiring::{Cancel, Wiring};

use super::deadline::Deadline;
use super::input;
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
    let alternatives = &found.all;
    if !found.complete {
        terminal.aside("stopped: there may be more pins that were not looked at")?;
    }
    match args.format {
        TableFormat::Human => {
            let count = alternatives.len();
            let rest = format!("\n`--all` lists all {count} places, one a line.\n");
            let text = if args.all {
                why::all(design, wiring, alternatives)
            } else {
                why::summary(design, wiring, alternatives, &rest)
            };
            terminal.result(&text)?;
        }
        TableFormat::Json => {
            terminal.result(&render::json_text(&why::value(name, &found)))?;
        }
    }
    Ok(Status::Done)
}

/// The connections of the device or chip with that name.
fn connections(design: &Design, name: &str) -> Result<Vec<ConnectionIndex>> {
    why::connections(design, name).map_err(|why| anyhow!(why))
}
