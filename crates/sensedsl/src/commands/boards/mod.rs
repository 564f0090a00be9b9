//! `sensedsl boards`: the built-in boards.

mod features;

use anyhow::{Context as _, Result, bail};
use sensedsl_board::profile::{self, Target, Transport};
use sensedsl_board::table::{Occupation, Pin, Table};
use sensedsl_board::{catalog, mcu};
use sensedsl_generate::target;
use sensedsl_model::design::BoardIndex;
use sensedsl_model::{NoFiles, Request, resolve};
use sensedsl_report::svg;
use sensedsl_session::printed_board;

use self::features::Features;
use super::table::{INDENT, table};
use crate::cli::{BoardFormat, BoardsArgs};
use crate::status::Status;
use crate::terminal::Terminal;

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
        BoardFormat::Svg => terminal.result(&picture(board)?)?,
    }
    Ok(Status::Done)
}

/// The picture of a board that nothing is wired to.
fn picture(board: &catalog::Entry) -> Result<String> {
    let text = format!("board Board on {} {{}}\n", board.name.replace('-', "_"));
    let request = Request { path: "board.sense", text: &text, board: None, target: None };
    let design = resolve(&request, &NoFiles).design;
    let picture = design.and_then(|design| svg::of_board(&design, BoardIndex(0)));
    picture.with_context(|| format!("{} cannot be drawn; please report this", board.name))
}

/// Prints the boards that have all words of `search`: names, parts, peripherals, voltages.
/// Scripts read one board from each line, name first; heads and count are for people.
fn list(search: &str, terminal: &Terminal) -> Result<Status> {
    let search = search.to_lowercase();
    let found = |board: &catalog::Entry, row: &[String; 8]| {
        search.trim().is_empty() || Features::of(board, row).has_all(&search)
    };
    let rows = catalog::all().iter().map(|board| (board, row(board)));
    let rows: Vec<[String; 8]> =
        rows.filter(|(board, row)| found(board, row)).map(|(_, row)| row).collect();
    let heads = ["Board", "Family", "MCU", "Package", ">Pins", ">Free", "Link", "Firmware"];
    let listing = table(heads, &rows);
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

fn row(board: &catalog::Entry) -> [String; 8] {
    let table = board.table();
    let free = table.pins.iter().filter(|pin| is_free(&table, pin)).count();
    let package = sensedsl_parts::find(board.mcu).and_then(|found| found.package());
    let facts = board.board().ok();
    let links = facts.iter().flat_map(|facts| &facts.link).map(|link| match link.transport {
        Transport::Uart => link.unit.as_str(),
        Transport::Usb => "USB",
    });
    let links: Vec<&str> = links.collect();
    let systems = firmware(board);
    let systems: Vec<&str> =
        systems.iter().filter_map(|name| Some(name.rsplit_once('-')?.0)).collect();
    let or_dash = |text: &str| if text.is_empty() { "-" } else { text }.to_owned();
    [
        board.name.to_owned(),
        mcu::family(board.mcu).to_owned(),
        board.mcu.to_owned(),
        or_dash(package.unwrap_or_default()),
        table.pins.len().to_string(),
        free.to_string(),
        or_dash(&links.join(" ")),
        or_dash(&systems.join(" ")),
    ]
}

/// Whether no part of the board has the pin, and it is at a connector if it is known which are.
fn is_free(table: &Table, pin: &Pin) -> bool {
    let is_left = pin.onboard.as_ref().is_none_or(|part| part.how != Occupation::Taken);
    is_left && !table.is_off_connectors(pin)
}

/// The systems for which there is firmware, with their versions, the usual one first.
pub(crate) fn firmware(board: &catalog::Entry) -> Vec<&'static str> {
    let facts = board.board().ok();
    let names = profile::names();
    let mut systems: Vec<&'static str> =
        names.iter().filter_map(|name| profile::full_name(name)).collect();
    systems.dedup();
    systems.retain(|name| match profile::find(name, board.mcu) {
        Ok(Target::Profile(profile)) => target::serving(Some(&profile), facts.as_ref()).is_ok(),
        Ok(Target::None) | Err(_) => false,
    });
    systems
}
