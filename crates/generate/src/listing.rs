//! The list of built-in boards as people read it: a row of cells for each board.
//!
//! A row comes of the board's table, its facts, its part and the profiles of its MCU. To read all of them takes a list
//! too long, so the rows are in `listing.csv`, which is embedded. [`row`] works one out; a test holds the file to it.

use std::iter::zip;

use sensedsl_board::table::Table;
use sensedsl_board::{catalog, mcu};
use sensedsl_session::boards;

use crate::target;

/// What the columns are; `>` before a name means that its cells stand on the right.
pub const HEADS: [&str; 8] =
    ["Board", "Family", "MCU", "Package", ">Pins", ">Free", "Link", "Firmware"];

/// The cells of a board.
pub type Row = [String; HEADS.len()];

/// All built-in boards, in natural order of their names, with their rows.
pub fn rows() -> impl Iterator<Item = (&'static catalog::Entry, Row)> {
    zip(catalog::all(), include_str!("listing.csv").lines()).map(|(board, line)| {
        let mut cells = line.split(',').map(str::to_owned);
        (board, std::array::from_fn(|_| cells.next().unwrap_or_default()))
    })
}

/// What [`rows`] has of a board whose table this is.
#[must_use]
pub fn row(board: &catalog::Entry, table: &Table) -> Row {
    let links = boards::links(board);
    let systems = target::systems_of(board);
    let systems: Vec<&str> =
        systems.iter().filter_map(|name| Some(name.rsplit_once('-')?.0)).collect();
    let or_dash = |text: &str| if text.is_empty() { "-" } else { text }.to_owned();
    [
        board.name.to_owned(),
        mcu::family(board.mcu).to_owned(),
        board.mcu.to_owned(),
        or_dash(boards::package(board).unwrap_or_default()),
        table.pins.len().to_string(),
        boards::free(table).to_string(),
        or_dash(&links.join(" ")),
        or_dash(&systems.join(" ")),
    ]
}
