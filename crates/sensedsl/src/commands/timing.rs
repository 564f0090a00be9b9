//! `sensedsl explain timing`: the work of the hardware in a second, part by part.

use anyhow::{Context as _, Result, bail};
use sensedsl_diagnostics::render;
use sensedsl_report::timing as report;
use sensedsl_session::Ask;
use sensedsl_timing::timing;
use sensedsl_wiring::Cancel;

use super::deadline::Deadline;
use super::input;
use crate::cli::{ExplainArgs, TableFormat};
use crate::status::Status;
use crate::terminal::Terminal;

pub(crate) fn run(args: &ExplainArgs, terminal: &Terminal) -> Result<Status> {
    let file = args.file.as_deref().context("`explain timing` needs a file")?;
    if args.device.is_some() {
        bail!("`explain timing` is about the whole file: it takes no device");
    }
    let deadline = Deadline::after(args.timeout);
    let over = || deadline.is_over();
    let snapshot = input::load(file, &args.on);
    let answer = snapshot.solve(&Ask { cancel: Cancel::when(&over), ..Ask::default() });
    let (design, wiring) = input::wired(&answer, &snapshot, &args.on, terminal)?;
    terminal.diagnostics(&answer.diagnostics, snapshot.sources())?;
    if wiring.bound.is_some() {
        terminal.aside("stopped: this is the best wiring so far, and there may be a better one")?;
    }
    // A timing that cannot be kept is shown all the same: the table tells where the time goes.
    let timing = timing(design, wiring);
    match args.format {
        TableFormat::Human => terminal.result(&report::human(design, &timing))?,
        TableFormat::Json => {
            terminal.result(&render::json_text(&report::value(design, &timing)))?;
        }
    }
    Ok(input::status(&answer.diagnostics, &args.on))
}
