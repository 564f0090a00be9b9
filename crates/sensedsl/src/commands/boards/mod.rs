//! `sensedsl boards`: the built-in boards.

mod features;

use anyhow::{Context as _, Result, bail};
use sensedsl_board::catalog;
use sensedsl_generate::listing;
use sensedsl_report::svg;
use sensedsl_session::printed_board;

use self::features::Features;
use crate::cli::{BoardFormat, BoardsArgs};
use crate::status::Status;
use crate::terminal::Terminal;
use sensedsl_report::columns::{INDENT, table};

pub(crate) fn run(args: &BoardsArgs, terminal: &mut Terminal) -> Result<Status> {
    let Some(name) = &args.name else {
        return list(args.search.as_deref().unwrap_or_default(), terminal);
    };
    let Some(board) = catalog::find(name) else {
        let meant = catalog::nearest_name(name);
        let meant = meant.map_or(String::new(), |meant| format!("; did you mean {meant}?"));
        bail!("there is no built-in board {name}{meant} (`sensedsl boards` lists them)");
    };
    match args.format {
        BoardFormat::Csv => terminal.result(&printed_board(board))?,
        BoardFormat::Svg => {
            let picture = svg::of_built_in(board);
            let undrawn = || format!("{} cannot be drawn; please report this", board.name);
            terminal.result(&picture.with_context(undrawn)?)?;
        }
    }
    Ok(Status::Done)
}

/// Prints the boards that have all words of `search`: names, parts, peripherals, voltages.
/// Scripts read one board from each line, name first; heads and count are for people.
fn list(search: &str, terminal: &Terminal) -> Result<Status> {
    let search = search.to_lowercase();
    let found = |board: &catalog::Entry, row: &listing::Row| {
        search.trim().is_empty() || Features::of(board, row).has_all(&search)
    };
    let rows = listing::rows().filter(|(board, row)| found(board, row));
    let rows: Vec<listing::Row> = rows.map(|(_, row)| row).collect();
    let listing = table(listing::HEADS, &rows);
    let mut lines = listing.lines().map(|line| line.strip_prefix(INDENT).unwrap_or(line));
    terminal.aside(lines.next().unwrap_or_default())?;
    terminal.result(&lines.map(|line| format!("{line}\n")).collect::<String>())?;
    let count = match rows.len() {
        1 => "1 board".to_owned(),
        some => format!("{some} boards"),
    };
    terminal.aside(&format!("{count}; `sensedsl boards NAME` prints the pins of one"))?;
    Ok(Status::Done)
}
