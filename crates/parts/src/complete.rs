//! Usages for a table that lists none: a board table in, the same table with the usages of its
//! MCU's pins out.

use sensedsl_board::pin::PinName;
use sensedsl_board::place::Place;
use sensedsl_board::remap::Blocks;
use sensedsl_board::signal::Signal;
use sensedsl_board::table::{Column, Property, ROUTED, Role, Table, Usage};

use crate::find::{Found, find};
use crate::sheet::{column_of, columns};

/// The result of completing a table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Completion {
    /// It lists usages itself, and is left as it is.
    Own,
    /// It lists none, and its MCU is not a known part.
    Unknown,
    /// It has the usages of its MCU.
    Part {
        /// The part.
        found: Box<Found>,
        /// Pins of the table that the part does not have.
        strangers: Vec<PinName>,
    },
}

/// Gives a table without a column of usages the usages of its MCU. A usage points to the cell of
/// its pin. Pins that share a contact of the package get its position, unless the table has
/// positions of its own, so that they exclude each other.
#[must_use]
pub fn complete(table: &mut Table) -> Completion {
    if table.columns.iter().any(|column| column.role == Role::Usages) {
        return Completion::Own;
    }
    let Some(found) = table.mcu.as_deref().and_then(find) else { return Completion::Unknown };
    // The printed table states which MCU the usages belong to.
    if table.property("mcu").is_none() {
        let value = table.mcu.clone().unwrap_or_default();
        table.properties.push(Property { key: "mcu".to_owned(), value, range: 0..0 });
    }
    let places = !table.columns.iter().any(|column| column.role == Role::Position);
    let shared = if places { found.sheet.shared() } else { Vec::new() };
    let mut strangers = Vec::new();
    for pin in &mut table.pins {
        let Some((position, usages)) = found.sheet.pin(&pin.name) else {
            strangers.push(pin.name.clone());
            continue;
        };
        if let Some(position) = position.filter(|position| shared.contains(position)) {
            let position = Some(position.to_owned());
            pin.places.insert(0, Place { position, ..Place::default() });
        }
        for column in columns() {
            let of_column = usages.iter().filter(|(signal, _)| column_of(signal) == column);
            pin.usages.extend(of_column.map(|(usage, alternate)| {
                let own = usage.strip_prefix(ROUTED);
                let (spelled, blocks) = Blocks::split(own.unwrap_or(usage));
                Usage {
                    is_routed: own.is_some(),
                    spelled: spelled.to_owned(),
                    signal: Signal::parse(spelled).0,
                    alternate: *alternate,
                    blocks,
                    column: column.to_owned(),
                    range: pin.range.clone(),
                }
            }));
        }
    }
    let added = columns().map(|header| (header, Role::Usages));
    let place = (!shared.is_empty()).then_some(("Position", Role::Position));
    let new = place.into_iter().chain(added);
    let column =
        |(header, role): (&str, Role)| Column { header: header.to_owned(), role, range: 0..0 };
    table.columns.extend(new.map(column));
    Completion::Part { found: Box::new(found), strangers }
}
