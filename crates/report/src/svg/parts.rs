//! What is said in the box of a part: its rows in, lines of text out.

use std::sync::OnceLock;

use sensedsl_model::facts::{self, PartFacts};

use crate::contact::of_wire;
use crate::drivers;
use crate::rows::Row;

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
    /// The names of the module's contacts for supply and ground, and what they need.
    pub(super) supply: Vec<Supply>,
}

/// A wire of a part.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct WireLine {
    pub(super) kind: String,
    pub(super) pin: String,
    pub(super) text: String,
    /// What else is on the pin.
    pub(super) shared: String,
}

/// A contact of a module for supply or ground.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Supply {
    /// As the module prints it.
    pub(super) contact: String,
    /// The signals of the board that it can be connected to, the best first.
    pub(super) signals: &'static [&'static str],
    /// What it needs, in words.
    pub(super) need: String,
}

/// The parts of one board, whose rows are given. `driver_of` gives the driver of a part.
pub(super) fn parts(
    rows: &[&Row],
    driver_of: impl Fn(&str) -> Option<String>,
    resistors_of: impl Fn(&str) -> Option<String>,
) -> Vec<Part> {
    let groups = rows.chunk_by(|one, next| one.device == next.device);
    let part = |group: &[&Row]| {
        let first = group.first()?;
        let facts = driver_of(&first.device).and_then(|name| facts_of(&name));
        Some(part(first, group, facts, resistors_of(&first.device)))
    };
    groups.filter_map(part).collect()
}

fn part(first: &Row, rows: &[&Row], facts: Option<&PartFacts>, resistors: Option<String>) -> Part {
    let values = first.values.iter().zip(&first.ids).map(|(value, id)| format!("{id} {value}"));
    Part {
        name: first.device.clone(),
        note: if first.values.is_empty() { first.ids() } else { String::new() },
        values: values.collect(),
        wires: rows.iter().map(|row| wire(row, facts)).collect(),
        remarks: resistors.into_iter().collect(),
        supply: facts.map(supply).unwrap_or_default(),
    }
}

fn wire(row: &Row, facts: Option<&PartFacts>) -> WireLine {
    let contact = facts.and_then(|facts| of_wire(facts, &row.role)).map(short);
    let letters = |text: &str| text.to_lowercase().replace(|c: char| !c.is_alphanumeric(), "");
    let end = match contact.filter(|contact| contact.len() <= CONTACT_MAX) {
        Some(contact) if letters(contact) == letters(&row.role) => contact.to_owned(),
        Some(contact) => format!("{contact} ({})", row.role),
        None => row.role.clone(),
    };
    WireLine {
        kind: row.kind.clone(),
        pin: row.pin.clone(),
        text: format!("{end} {} ({})", row.pin, row.signal),
        shared: row.shared.clone(),
    }
}

/// The name of a contact without what is said of it in parentheses.
fn short(contact: &str) -> &str {
    contact.split(" (").next().unwrap_or(contact)
}

/// The contacts of a part's usual module for supply and ground.
fn supply(facts: &PartFacts) -> Vec<Supply> {
    const GROUND: &[&str] = &["GND", "0V", "-", "VSS"];
    const SUPPLY: &[&str] = &["VCC", "VDD", "VIN", "5V", "+5V", "3V3", "3.3V", "3.3V-5V", "+"];
    let called = |names: &[&str]| {
        let is_called = |entry: &&String| names.iter().any(|name| entry.eq_ignore_ascii_case(name));
        facts.connector.iter().find(is_called)
    };
    let one = |contact: &String, signals, need: &str| Supply {
        contact: short(contact).to_owned(),
        signals,
        need: need.to_owned(),
    };
    let need = drivers::supply(facts).unwrap_or_default();
    let signals: &'static [&'static str] = match facts.supply_mv {
        Some((least, most)) if (least..=most).contains(&3_300) => &["3V3", "3V", "VDD"],
        Some((least, most)) if (least..=most).contains(&5_000) => &["5V", "VBUS"],
        Some(_) | None => &[],
    };
    let plus = called(SUPPLY).filter(|_| !need.is_empty());
    let ground = called(GROUND).map(|contact| one(contact, &["GND"], "ground"));
    plus.map(|contact| one(contact, signals, &need)).into_iter().chain(ground).collect()
}

/// What the library knows about a driver of its own.
fn facts_of(name: &str) -> Option<&'static PartFacts> {
    static LIBRARY: OnceLock<Vec<PartFacts>> = OnceLock::new();
    LIBRARY.get_or_init(facts::all).iter().find(|part| part.name == name)
}
