//! `sensedsl capacity`: what can still be added, and what blocks the next device.

use anyhow::Result;
use sensedsl_diagnostics::render;
use sensedsl_model::kind::KindName;
use sensedsl_report::capacity as report;
use sensedsl_session::Ask;
use sensedsl_wiring::{Cancel, capacity};

use super::deadline::Deadline;
use super::input;
use crate::cli::{CapacityArgs, TableFormat};
use crate::status::Status;
use crate::terminal::Terminal;

pub(crate) fn run(args: &CapacityArgs, terminal: &mut Terminal) -> Result<Status> {
    let deadline = Deadline::after(args.timeout);
    let over = || deadline.is_over();
    let cancel = Cancel::when(&over);
    let snapshot = input::load(&args.file, &args.on);
    let answer = snapshot.solve(&Ask { cancel, ..Ask::default() });
    let (design, wiring) = input::wired(&answer, &snapshot, &args.on, terminal)?;
    let found = capacity(design, wiring, args.rearrange, cancel);
    if !found.complete {
        let all = design.boards.len() * KindName::wired().count();
        let open = all - found.all.len();
        terminal.aside(&format!("stopped: {open} of {all} were not looked at"))?;
    }
    match args.format {
        TableFormat::Human => terminal.result(&report::human(design, &found))?,
        TableFormat::Json => {
            terminal.result(&render::json_text(&report::value(design, &found)))?;
        }
    }
    Ok(Status::Done)
}
