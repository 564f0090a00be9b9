//! What built-in boards have, for lists of them.

use sensedsl_board::catalog;
use sensedsl_board::profile::Transport;
use sensedsl_board::table::{Occupation, Pin, Table};

/// Whether no part of the board has the pin, and it is at a connector if it is known which are.
#[must_use]
pub fn is_free(table: &Table, pin: &Pin) -> bool {
    let is_left = pin.onboard.as_ref().is_none_or(|part| part.how != Occupation::Taken);
    is_left && !table.is_off_connectors(pin)
}

/// The number of pins that are free.
#[must_use]
pub fn free(table: &Table) -> usize {
    table.pins.iter().filter(|pin| is_free(table, pin)).count()
}

/// The units that a board can talk to a host with: `USB`, `UART2`.
#[must_use]
pub fn links(board: &catalog::Entry) -> Vec<String> {
    let facts = board.board().ok();
    let links = facts.iter().flat_map(|facts| &facts.link).map(|link| match link.transport {
        Transport::Uart => link.unit.to_string(),
        Transport::Usb => "USB".to_owned(),
    });
    links.collect()
}

/// The package of a board's MCU, if the part is known.
#[must_use]
pub fn package(board: &catalog::Entry) -> Option<&'static str> {
    sensedsl_parts::find(board.mcu)?.package()
}
