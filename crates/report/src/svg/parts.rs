//! What is said in the box of a part: its rows in, lines of text out.

use crate::rows::Row;
use crate::sheet::{BoardSheet, Line, PartSheet};

/// The longest name of a module's contact that is shown.
const CONTACT_MAX: usize = 14;

/// A part of a board, ready to be drawn.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Part {
    pub(super) name: String,
    /// What is beside the name.
    pub(super) note: String,
    /// The values of a chip, each with its identifier.
    pub(super) values: Vec<String>,
    pub(super) wires: Vec<WireLine>,
    /// Supply, resistors: what else has to be connected.
    pub(super) remarks: Vec<String>,
    /// What its contacts for supply and ground are connected to.
    pub(super) supply: Vec<String>,
}

/// A wire of a part.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct WireLine {
    pub(super) kind: String,
    pub(super) pin: String,
    /// What is printed at the part's end, or the role.
    pub(super) end: String,
    /// What the board is labelled with at the other end.
    pub(super) label: Option<String>,
    /// The signal, which is said where there is room.
    pub(super) signal: String,
    /// What else is on the pin.
    pub(super) shared: String,
}

/// The parts of one board, whose rows and sheet are given.
pub(super) fn parts(
    rows: &[&Row],
    sheet: &BoardSheet<'_>,
    resistors_of: impl Fn(&str) -> Option<String>,
) -> Vec<Part> {
    let groups = rows.chunk_by(|one, next| one.device == next.device);
    let part = |group: &[&Row]| {
        let first = group.first()?;
        let own = sheet.parts.iter().find(|own| own.name == first.device);
        Some(part(first, group, own, resistors_of(&first.device).as_deref()))
    };
    groups.filter_map(part).collect()
}

fn part(first: &Row, rows: &[&Row], own: Option<&PartSheet>, resistors: Option<&str>) -> Part {
    let values = first.values.iter().zip(&first.ids).map(|(value, id)| format!("{id} {value}"));
    Part {
        name: first.device.clone(),
        note: if first.values.is_empty() { first.ids() } else { String::new() },
        values: values.collect(),
        wires: rows.iter().map(|row| wire(row, own)).collect(),
        remarks: resistors.map(halves).unwrap_or_default(),
        supply: own.map(supply).unwrap_or_default(),
    }
}

fn wire(row: &Row, own: Option<&PartSheet>) -> WireLine {
    let line = own.and_then(|own| own.lines.iter().find(|line| line.wire == row.role));
    let contact = line.map(|line| short(&line.at_part));
    let letters = |text: &str| text.to_lowercase().replace(|c: char| !c.is_alphanumeric(), "");
    let end = match contact.filter(|contact| contact.len() <= CONTACT_MAX) {
        Some(contact) if letters(contact) == letters(&row.role) => contact.to_owned(),
        Some(contact) => format!("{contact} ({})", row.role),
        None => row.role.clone(),
    };
    WireLine {
        kind: row.kind.clone(),
        pin: row.pin.clone(),
        end,
        label: row.label.clone(),
        signal: row.signal.clone(),
        shared: row.shared.clone(),
    }
}

impl WireLine {
    /// Both ends of the wire.
    pub(super) fn text(&self) -> String {
        match &self.label {
            Some(label) => format!("{} {label} {}", self.end, self.pin),
            None => format!("{} {}", self.end, self.pin),
        }
    }
}

/// A divider in two lines: one is too long for a box.
fn halves(resistors: &str) -> Vec<String> {
    match resistors.rsplit_once(", ") {
        Some((upper, lower)) => vec![format!("{upper},"), lower.to_owned()],
        None => vec![resistors.to_owned()],
    }
}

/// The name of a contact without what is said of it in parentheses.
fn short(contact: &str) -> &str {
    contact.split(" (").next().unwrap_or(contact)
}

/// The lines about supply and ground, as the sheet gives them out.
fn supply(part: &PartSheet) -> Vec<String> {
    let line = |line: &Line| {
        let end = line.end.as_ref().filter(|_| line.pin.is_empty())?;
        let to = match &end.contact {
            Some(contact) => format!("{} at {contact}", end.net),
            None => line.to.clone(),
        };
        Some(format!("{}: {to}", short(&line.at_part)))
    };
    part.lines.iter().filter_map(line).collect()
}
