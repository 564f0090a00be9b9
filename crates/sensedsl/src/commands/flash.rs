//! `sensedsl flash`: builds the firmware of one board and writes it there, with the first tool that finds
//! the board.

use std::process::{Command, Stdio};

use anyhow::{Context as _, Result};
use sensedsl_diagnostics::codes::{e0519_which_board, e0522_not_flashed};
use sensedsl_diagnostics::{Diagnostic, visible};

use super::build::{Job, built};
use crate::cli::FlashArgs;
use crate::firmware::{Build, ending, probe, raw};
use crate::status::Status;
use crate::terminal::Terminal;

pub(crate) fn run(args: &FlashArgs, terminal: &Terminal) -> Result<Status> {
    let mut ground = |job: &mut Job<'_>| -> Result<(), Box<Diagnostic>> {
        let [program] = job.programs.as_slice() else {
            let names: Vec<&str> = job.programs.iter().map(|one| one.board.as_str()).collect();
            return Err(e0519_which_board::several(job.at, &names).into());
        };
        let tool = probe::choose(args.with, job.at)?;
        let (elf, raw) = (job.elf(program), job.raw(program));
        job.after = probe::command(tool, program, (&elf, &raw), job.at)?;
        // Make writes both files.
        job.makes_raw = tool.takes_raw() && matches!(program.build, Build::Cargo(_));
        Ok(())
    };
    built(&args.place, terminal, &mut ground, &mut |job| flash(job, terminal))
}

/// Runs the command that writes the program.
fn flash(job: &Job<'_>, terminal: &Terminal) -> Result<Status> {
    if let Some(program) = job.programs.first().filter(|_| job.makes_raw) {
        let (elf, raw) = (job.elf(program), job.raw(program));
        let bytes = std::fs::read(&elf).with_context(|| elf.display().to_string())?;
        let bytes = raw::of_elf(&bytes).with_context(|| elf.display().to_string())?;
        std::fs::write(&raw, bytes).with_context(|| raw.display().to_string())?;
    }
    let shown = job.after.join(" ");
    let Some((tool, arguments)) = job.after.split_first() else { return Ok(Status::Done) };
    terminal.note(&format!("{}\n", visible(&shown)))?;
    let mut command = Command::new(tool);
    command.args(arguments).stdin(Stdio::null());
    let status = command.status().with_context(|| format!("cannot run {tool}"))?;
    let board = job.programs.first().map_or("the board", |program| program.board.as_str());
    if !status.success() {
        let why = e0522_not_flashed::not_flashed(job.at, board, tool, &ending(status));
        return job.refuse(why, Status::Misused, terminal);
    }
    terminal.note(&format!("flashed {}\n", visible(board)))?;
    Ok(Status::Done)
}
