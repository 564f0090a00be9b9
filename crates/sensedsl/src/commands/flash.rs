//! `sensedsl flash`: builds the firmware of one board and writes it there, with the first tool that finds
//! the board, or by copying a file to the board's drive.

use std::fs::File;
use std::io::Write as _;
use std::path::Path;
use std::process::{Command, Stdio};

use anyhow::{Context as _, Result};
use sensedsl_diagnostics::codes::{e0519_which_board, e0522_not_flashed};
use sensedsl_diagnostics::{Diagnostic, visible};

use super::build::{After, Job, built};
use crate::cli::FlashArgs;
use crate::files::shown;
use crate::firmware::arduino;
use crate::firmware::drive::Drive;
use crate::firmware::probe::{self, Way};
use crate::firmware::{Build, ending, raw};
use crate::status::Status;
use crate::terminal::Terminal;

pub(crate) fn run(args: &FlashArgs, terminal: &Terminal) -> Result<Status> {
    let mut ground = |job: &mut Job<'_>| -> Result<(), Box<Diagnostic>> {
        let [program] = job.programs.as_slice() else {
            let names: Vec<&str> = job.programs.iter().map(|one| one.board.as_str()).collect();
            return Err(e0519_which_board::several(job.at, &names).into());
        };
        if let Build::Sketch(sketch) = &program.build {
            let port = args.port.as_deref();
            let words = arduino::upload(sketch, &program.folder, port, job.at)?;
            job.after = Some(After::Run(words));
            return Ok(());
        }
        let way = match &args.drive {
            Some(drive) => Way::Drive(probe::drive_at(drive, program, job.at)?),
            None => probe::choose(args.with, program, job.at)?,
        };
        let (elf, raw) = (job.elf(program), job.raw(program));
        let (after, takes_raw) = match way {
            Way::Tool(tool) => {
                let command = probe::command(tool, program, (&elf, &raw), job.at)?;
                (After::Run(command), tool.takes_raw())
            }
            Way::Drive(drive) => {
                let uf2 = job.uf2(program);
                let takes_raw = uf2.is_none();
                (After::Copy { file: uf2.unwrap_or(raw), drive }, takes_raw)
            }
        };
        // Make writes both files.
        let makes_raw = takes_raw && matches!(program.build, Build::Cargo(_));
        (job.after, job.makes_raw) = (Some(after), makes_raw);
        Ok(())
    };
    built(&args.place, terminal, &mut ground, &mut |job| flash(job, terminal))
}

/// Writes the program.
fn flash(job: &Job<'_>, terminal: &Terminal) -> Result<Status> {
    if let Some(program) = job.programs.first().filter(|_| job.makes_raw) {
        let (elf, raw) = (job.elf(program), job.raw(program));
        let bytes = std::fs::read(&elf).with_context(|| shown(&elf))?;
        let bytes = raw::of_elf(&bytes).with_context(|| shown(&elf))?;
        std::fs::write(&raw, bytes).with_context(|| shown(&raw))?;
    }
    let board = job.programs.first().map_or("the board", |program| program.board.as_str());
    let failed = match &job.after {
        None => return Ok(Status::Done),
        Some(After::Run(words)) => run_tool(words, terminal)?
            .map(|(tool, how)| e0522_not_flashed::not_flashed(job.at, board, &tool, &how)),
        Some(After::Copy { file, drive }) => copy(file, drive, terminal)?
            .map(|how| e0522_not_flashed::not_copied(job.at, board, &shown(drive), &how)),
    };
    if let Some(why) = failed {
        return job.refuse(why, Status::Misused, terminal);
    }
    terminal.note(&format!("flashed {}\n", visible(board)))?;
    Ok(Status::Done)
}

/// Runs the command that writes the program; the result has what failed, and how it ended.
fn run_tool(words: &[String], terminal: &Terminal) -> Result<Option<(String, String)>> {
    let Some((tool, arguments)) = words.split_first() else { return Ok(None) };
    terminal.note(&format!("{}\n", visible(&words.join(" "))))?;
    let mut command = Command::new(tool);
    command.args(arguments).stdin(Stdio::null());
    let status = command.status().with_context(|| format!("cannot run {tool}"))?;
    Ok((!status.success()).then(|| (tool.clone(), ending(status))))
}

/// Copies a file to a drive; the result says why the drive did not take it.
fn copy(file: &Path, drive: &Path, terminal: &Terminal) -> Result<Option<String>> {
    let bytes = std::fs::read(file).with_context(|| shown(file))?;
    let Some(name) = file.file_name() else { return Ok(None) };
    terminal.note(&format!("copy {} to {}\n", visible(&shown(file)), visible(&shown(drive))))?;
    // The drive only looks like one: no other name, no second step.
    let written = File::create(drive.join(name)).and_then(|mut to| {
        to.write_all(&bytes)?;
        // A board that has all of its program starts it, and its drive is gone.
        let synced = to.sync_all();
        if Drive::at(drive).is_some() { synced } else { Ok(()) }
    });
    Ok(written.err().map(|error| error.to_string()))
}
