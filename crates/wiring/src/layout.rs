//! Where the pins of a problem are on connectors, for the search for a neat wiring.
//!
//! In: the boards' tables and forms, and who asks for wires. Out: contacts as numbers.

use std::collections::BTreeMap;

use sensedsl_board::place::Place;
use sensedsl_board::table::Pin;
use sensedsl_model::design::{Board, BoardIndex, Design};
use sensedsl_solve::neat::{Contact, Layout};
use sensedsl_solve::problem::PinId;

use crate::assignment::Wire;
use crate::formulate::Requester;

/// A side of a connector: the board, the connector, and the edge of the board that it is at.
type Side = (BoardIndex, String, Option<String>);

/// Where everything is. A link is a part of its own: its wires lead to one plug.
pub(crate) fn layout(
    design: &Design,
    askers: &[Requester],
    pins: &[(BoardIndex, usize)],
) -> Layout {
    let part = |asker: &Requester| match asker {
        Requester::Connection(index) => design.connection(*index).map_or(0, |one| one.part.0),
        Requester::Link(board) => design.parts.len() + board.0,
    };
    let parts = askers.iter().map(|asker| u32::try_from(part(asker)).unwrap_or(u32::MAX));
    let mut sides: BTreeMap<Side, u32> = BTreeMap::new();
    let contacts = pins.iter().map(|(index, pin)| {
        let Some(board) = design.board(*index) else { return Vec::new() };
        let Some(pin) = board.table.pins.get(*pin) else { return Vec::new() };
        let contacts = contacts(board, pin).map(|(_, header, place, index_there)| {
            let next = u32::try_from(sides.len()).unwrap_or(u32::MAX);
            let side = (*index, header.to_ascii_lowercase(), place.side.clone());
            Contact { side: *sides.entry(side).or_insert(next), index: index_there }
        });
        contacts.collect()
    });
    Layout { parts: parts.collect(), contacts: contacts.collect() }
}

/// The places of a pin on connectors, each with its number among all places of the pin, its
/// connector, and how far along that it is.
fn contacts<'a>(
    board: &'a Board,
    pin: &'a Pin,
) -> impl Iterator<Item = (usize, &'a str, &'a Place, u32)> {
    let form = board.table.form();
    pin.places.iter().enumerate().filter_map(move |(number, place)| {
        let header = place.header.as_deref()?;
        let connector = form.and_then(|form| form.connector(header));
        let contact = place.position.as_deref().and_then(last_number);
        let along = contact.map(|contact| {
            let drawn = connector.and_then(|connector| connector.along(contact));
            drawn.unwrap_or(contact)
        });
        Some((number, header, place, along.unwrap_or_default()))
    })
}

/// The number at the end of a contact's name: 7 for `A7`.
fn last_number(name: &str) -> Option<u32> {
    let start = name.rfind(|letter: char| !letter.is_ascii_digit()).map_or(0, |at| at + 1);
    name.get(start..)?.parse().ok()
}

/// Says for the wires of a part at which of its places each is.
pub(crate) fn name_places(
    board: &Board,
    used: &BTreeMap<PinId, usize>,
    pin: impl Fn(usize) -> Option<PinId>,
    wires: &mut [Wire],
) {
    for wire in wires {
        let contact = pin(wire.pin).and_then(|pin| used.get(&pin));
        let row = board.table.pins.get(wire.pin);
        let place = contact.zip(row).and_then(|(at, row)| contacts(board, row).nth(*at));
        wire.place = place.map(|(number, ..)| number);
    }
}
