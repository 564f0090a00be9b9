//! `sensedsl boards`: what is built in.

use anyhow::{Result, bail};
use sensedsl_board::catalog;
use sensedsl_parts::Completion;

use crate::Status;
use crate::cli::BoardsArgs;
use crate::terminal::Terminal;

pub(crate) fn run(args: &BoardsArgs, terminal: &mut Terminal) -> Result<Status> {
    let Some(name) = &args.name else {
        let search = args.search.as_deref().unwrap_or_default().to_lowercase();
        let found = |board: &&catalog::Entry| {
            let names = board.aliases.iter().chain([&board.name, &board.mcu, &board.description]);
            names.map(|name| name.to_lowercase()).any(|name| name.contains(&search))
        };
        let boards = || catalog::all().iter().filter(found);
        let width = boards().map(|board| board.name.len()).max().unwrap_or_default();
        let lines = boards().map(|board| {
            format!("{:width$}  {:14}  {}\n", board.name, board.mcu, board.description)
        });
        terminal.result(&lines.collect::<String>())?;
        return Ok(Status::Done);
    };
    let Some(board) = catalog::find(name) else {
        let meant = catalog::nearest_name(name);
        let meant = meant.map_or(String::new(), |meant| format!("; did you mean {meant}?"));
        bail!("there is no built-in board {name}{meant} (`sensedsl boards` lists them)");
    };
    let mut table = board.table();
    let printed = match sensedsl_parts::complete(&mut table) {
        Completion::Part { .. } => table.to_csv(),
        Completion::Own | Completion::Unknown => board.csv().to_owned(),
    };
    terminal.result(&printed)?;
    Ok(Status::Done)
}
