//! The board table: the wide CSV form of a pin table in, pins with their usages out, and vice
//! versa.
//!
//! The format is described in `docs/board-tables.md`.

use std::fmt;
use std::ops::Range;

use crate::cells::{bare, guarded, inner, says_nothing};
use crate::finding::Finding;
use crate::form::{self, Form};
use crate::landmark::{self, Landmark, LandmarkKind};
use crate::pin::{PinName, natural};
use crate::place::{Contact, Place};
use crate::remap::Blocks;
use crate::signal::Signal;

/// A table, with the findings in it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Loaded {
    /// The part that was understood.
    pub board: Table,
    /// Mistakes, in the order of the text.
    pub findings: Vec<Finding>,
}

/// Reads a table. Never fails: anything that cannot be read is left out and reported as a finding.
#[must_use]
pub fn load(text: &str) -> Loaded {
    crate::load::load(text)
}

/// The pins of one board or MCU.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Table {
    /// The MCU, from a leading line `# mcu = …`.
    pub mcu: Option<String>,
    /// All leading lines `# key = value`, including the MCU's.
    pub properties: Vec<Property>,
    /// The columns that are read, in order.
    pub columns: Vec<Column>,
    /// The pins in natural order.
    pub pins: Vec<Pin>,
    /// The contacts of connectors that carry no pin, in the order of the rows.
    pub contacts: Vec<Contact>,
}

/// A line `# key = value`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Property {
    /// The key in lower case.
    pub key: String,
    /// The value.
    pub value: String,
    /// The bytes of the value.
    pub range: Range<usize>,
}

/// A column of the table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Column {
    /// The header as spelled.
    pub header: String,
    /// The role of its cells.
    pub role: Role,
    /// The bytes of the header.
    pub range: Range<usize>,
}

/// The role of a column's cells.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// The pin's name.
    Pin,
    /// The position on the package.
    Position,
    /// The edge of the board.
    Side,
    /// The connector.
    Header,
    /// Contacts of connectors: `CN7.28 CN8.1=A0`.
    Places,
    /// The part of the board that is connected to the pin.
    Onboard,
    /// The text printed next to the pin.
    Label,
    /// The voltages that the pin tolerates.
    Voltage,
    /// A remark.
    Note,
    /// Alternate-function numbers of the row's usages.
    Alternate,
    /// Usages, which are in all other columns.
    Usages,
}

impl Role {
    /// The roles that a header can name; all except [`Role::Usages`].
    pub const NAMED: [(&'static str, Self); 10] = [
        ("Pin", Self::Pin),
        ("Position", Self::Position),
        ("Side", Self::Side),
        ("Header", Self::Header),
        ("Places", Self::Places),
        ("Onboard", Self::Onboard),
        ("Label", Self::Label),
        ("Voltage", Self::Voltage),
        ("Note", Self::Note),
        ("AF", Self::Alternate),
    ];

    /// The role that a header names.
    #[must_use]
    pub fn of(header: &str) -> Self {
        Self::NAMED
            .iter()
            .find(|(name, _)| name.eq_ignore_ascii_case(header))
            .map_or(Self::Usages, |(_, role)| *role)
    }
}

/// A row of the table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Pin {
    /// The canonical name.
    pub name: PinName,
    /// The name as the table spells it.
    pub spelled: String,
    /// The usages in the order of the row, with each signal once.
    pub usages: Vec<Usage>,
    /// Where it is found, in the order of the table: what its columns `Header`, `Position` and `Side` say, then its
    /// column `Places`.
    pub places: Vec<Place>,
    /// The text printed next to the pin, wherever its places have none of their own.
    pub label: Option<String>,
    /// The voltages that the pin tolerates.
    pub voltage: Option<String>,
    /// A remark.
    pub note: Option<String>,
    /// The part of the board that is connected to it.
    pub onboard: Option<Onboard>,
    /// The line in the text, from 1.
    pub row: usize,
    /// The bytes of the pin cell.
    pub range: Range<usize>,
}

impl Pin {
    /// A pin of which only the name is known.
    #[must_use]
    pub fn new(name: PinName, spelled: String) -> Self {
        Self {
            name,
            spelled,
            usages: Vec::new(),
            places: Vec::new(),
            label: None,
            voltage: None,
            note: None,
            onboard: None,
            row: 0,
            range: 0..0,
        }
    }

    /// The text of a column that describes the pin; none for other columns.
    pub fn text_mut(&mut self, role: Role) -> Option<&mut Option<String>> {
        match role {
            Role::Position => self.first_place().map(|place| &mut place.position),
            Role::Side => self.first_place().map(|place| &mut place.side),
            Role::Header => self.first_place().map(|place| &mut place.header),
            Role::Label => Some(&mut self.label),
            Role::Voltage => Some(&mut self.voltage),
            Role::Note => Some(&mut self.note),
            Role::Pin | Role::Places | Role::Onboard | Role::Alternate | Role::Usages => None,
        }
    }

    /// The place that the columns `Header`, `Position` and `Side` describe, with nothing in it at first.
    fn first_place(&mut self) -> Option<&mut Place> {
        if self.places.is_empty() {
            self.places.push(Place::default());
        }
        self.places.first_mut()
    }

    /// Its position on the package, if the table has that.
    #[must_use]
    pub fn package_position(&self) -> Option<&str> {
        let own = self.places.iter().find(|place| place.header.is_none())?;
        own.position.as_deref()
    }

    /// The connectors that it is at, each once.
    #[must_use]
    pub fn headers(&self) -> Vec<&str> {
        distinct(self.places.iter().filter_map(|place| place.header.as_deref()))
    }

    /// The edges of the board that it is at, each once.
    #[must_use]
    pub fn sides(&self) -> Vec<&str> {
        distinct(self.places.iter().filter_map(|place| place.side.as_deref()))
    }

    /// What is printed beside it, each text once.
    #[must_use]
    pub fn labels(&self) -> Vec<&str> {
        let own = self.places.iter().filter_map(|place| place.label.as_deref());
        distinct(self.label.as_deref().into_iter().chain(own))
    }

    /// Its contact at a connector: the first in natural order if there are several.
    #[must_use]
    pub fn position_at(&self, header: &str) -> Option<&str> {
        let there = self.places.iter().filter(|place| place.is_at_header(header));
        there.filter_map(|place| place.position.as_deref()).min_by(|a, b| natural(a, b))
    }

    /// The opportunity cost of taking the pin, which is its number of usages over all columns. What the MCU can
    /// route to any pin is not lost with this one: of all that, an input and an output count.
    #[must_use]
    pub fn cost(&self) -> u32 {
        let own = self.usages.iter().filter(|usage| !usage.is_routed).count();
        let routed = || self.usages.iter().filter(|usage| usage.is_routed);
        let is_input = routed().any(|usage| usage.signal.function().is_input());
        let is_output = routed().any(|usage| usage.signal.function().is_output());
        u32::try_from(own).map_or(u32::MAX, |own| own + u32::from(is_input) + u32::from(is_output))
    }

    /// The usage of a signal, by its canonical name.
    #[must_use]
    pub fn usage(&self, signal: &Signal) -> Option<&Usage> {
        self.usages.iter().find(|usage| usage.signal == *signal)
    }
}

/// What stands before a usage that the MCU can route to any pin.
pub const ROUTED: char = '*';

/// A use that a pin can have.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Usage {
    /// The table's spelling, without remap blocks and alternate-function number: `ADC12-IN8`.
    pub spelled: String,
    /// The signal that it means.
    pub signal: Signal,
    /// The number of the alternate function, if the table gives it.
    pub alternate: Option<u8>,
    /// The remap blocks of its peripheral that put it on this pin; none if it is always on this
    /// pin.
    pub blocks: Option<Blocks>,
    /// Whether the MCU can route it to any pin, so that it is not this pin's own: the table marks it with
    /// [`ROUTED`].
    pub is_routed: bool,
    /// The header of the column that it is in.
    pub column: String,
    /// The bytes of the usage.
    pub range: Range<usize>,
}

/// A part of the board that is connected to a pin.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Onboard {
    /// The part: `CS43L22`.
    pub part: String,
    /// What the part leaves for other uses.
    pub how: Occupation,
}

/// The name of an on-board part in a `release` rule: its own name, with `_` for each character that
/// is not a letter or digit. `CAN transceiver` is released as `CAN_transceiver`, in upper or lower
/// case.
#[must_use]
pub fn release_name(part: &str) -> String {
    part.chars().map(|letter| if letter.is_alphanumeric() { letter } else { '_' }).collect()
}

/// What an on-board part leaves for other uses of its pin.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Occupation {
    /// Nothing; the pin is not offered.
    Taken,
    /// The pin is part of a bus that other devices of the same kind may join.
    Bus,
    /// The pin can be used by people who know what is connected to it.
    Care,
}

impl Occupation {
    /// The words after the colon of an `Onboard` cell; no word means [`Occupation::Taken`].
    pub const WORDS: [(&'static str, Self); 3] =
        [("taken", Self::Taken), ("bus", Self::Bus), ("care", Self::Care)];
}

impl fmt::Display for Onboard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.how {
            // The word is left out if the name alone means the same.
            Occupation::Taken if matches!(self.part.as_str(), "" | "-") => {
                write!(f, "{}:taken", self.part)
            }
            Occupation::Taken if self.part.contains(':') => write!(f, "{}:taken", self.part),
            Occupation::Taken => f.write_str(&self.part),
            Occupation::Bus => write!(f, "{}:bus", self.part),
            Occupation::Care => write!(f, "{}:care", self.part),
        }
    }
}

/// Texts in their order, each once; letters of any case are alike.
fn distinct<'t>(texts: impl Iterator<Item = &'t str>) -> Vec<&'t str> {
    let mut known: Vec<&str> = Vec::new();
    for text in texts {
        if !known.iter().any(|one| one.eq_ignore_ascii_case(text)) {
            known.push(text);
        }
    }
    known
}

impl Table {
    /// The shape of the board, from the line `# form = …`.
    #[must_use]
    pub fn form(&self) -> Option<&'static Form> {
        self.property("form").and_then(form::find)
    }

    /// The buttons and LEDs: those of its lines `# buttons = …` and `# leds = …`, and those of its
    /// form that have other names. None if it has no form, because nothing says where they would be.
    #[must_use]
    pub fn landmarks(&self) -> Vec<Landmark> {
        let Some(form) = self.form() else { return Vec::new() };
        let own = |kind: LandmarkKind| {
            self.property(kind.property()).and_then(|list| landmark::parse(kind, list).ok())
        };
        let mut all: Vec<Landmark> =
            LandmarkKind::ALL.into_iter().filter_map(own).flatten().collect();
        let own = all.len();
        for shared in &form.landmark {
            let mut known = all.iter().take(own);
            if !known.any(|one| one.kind == shared.kind && one.name == shared.name) {
                all.push(shared.clone());
            }
        }
        all
    }

    /// What the contacts without a pin carry, each signal with the words of all its contacts.
    fn contact_rows(&self) -> Vec<(&str, Vec<String>)> {
        let mut rows: Vec<(&str, Vec<String>)> = Vec::new();
        for contact in &self.contacts {
            match rows.iter_mut().find(|(signal, _)| *signal == contact.signal) {
                Some((_, places)) => places.extend(contact.place.word()),
                None => rows.push((&contact.signal, contact.place.word().into_iter().collect())),
            }
        }
        rows
    }

    /// Whether it says of any pin where it is.
    #[must_use]
    pub fn has_places(&self) -> bool {
        self.pins.iter().any(|pin| pin.places.iter().any(|place| place.header.is_some()))
    }

    /// Whether the table says of all pins at which connectors they are, and the pin is at none.
    #[must_use]
    pub fn is_off_connectors(&self, pin: &Pin) -> bool {
        let lists_places = self.columns.iter().any(|column| column.role == Role::Places);
        lists_places && pin.headers().is_empty()
    }

    /// The row of a pin.
    #[must_use]
    pub fn pin(&self, name: &PinName) -> Option<&Pin> {
        let at = self.pins.binary_search_by(|pin| pin.name.cmp(name)).ok()?;
        self.pins.get(at)
    }

    /// The value of a line `# key = value`.
    #[must_use]
    pub fn property(&self, key: &str) -> Option<&str> {
        let property = self.properties.iter().find(|p| p.key.eq_ignore_ascii_case(key))?;
        Some(&property.value)
    }

    /// The canonical wide CSV: pins in natural order, alternate functions with their usages. It
    /// loads as an equal table, apart from the places.
    #[must_use]
    pub fn to_csv(&self) -> String {
        let mut csv = String::new();
        for property in &self.properties {
            let value = inner(&property.value, false);
            csv.push_str(&format!("# {} = {}\n", property.key, bare(&value)));
        }
        let columns: Vec<&Column> =
            self.columns.iter().filter(|column| column.role != Role::Alternate).collect();
        push_row(&mut csv, columns.iter().map(|column| column.header.clone()));
        for pin in &self.pins {
            let (described, others) =
                described(pin, |role| columns.iter().any(|one| one.role == role));
            let cell = |column: &&Column| cell(pin, column, described, others);
            push_row(&mut csv, columns.iter().map(cell));
        }
        for (signal, places) in self.contact_rows() {
            let cell = |column: &&Column| {
                if column.role == Role::Label {
                    signal.to_owned()
                } else if column.role == Role::Places {
                    places.join(" ")
                } else {
                    String::new()
                }
            };
            push_row(&mut csv, columns.iter().map(cell));
        }
        csv
    }
}

/// The place for the columns `Header`, `Position` and `Side`, and those for the column `Places`.
fn described(pin: &Pin, has: impl Fn(Role) -> bool) -> (Option<&Place>, &[Place]) {
    let fits = |place: &Place| {
        let is_plain = place.label.is_none() && !place.is_inferred;
        let whole = (place.header.is_none() || has(Role::Header))
            && (place.position.is_none() || has(Role::Position));
        is_plain && whole && (place.word().is_none() || !has(Role::Places) || has(Role::Header))
    };
    match pin.places.split_first() {
        Some((first, others)) if fits(first) => (Some(first), others),
        _ => (None, &pin.places),
    }
}

/// The content of one cell.
fn cell(pin: &Pin, column: &Column, described: Option<&Place>, others: &[Place]) -> String {
    // A dash would be read as an empty cell.
    let plain =
        |text: String| if says_nothing(&inner(&text, false)) { String::new() } else { text };
    let text = |text: &Option<String>| text.clone().map(plain).unwrap_or_default();
    match column.role {
        Role::Pin => pin.spelled.clone(),
        Role::Position => described.map_or(String::new(), |place| text(&place.position)),
        Role::Side => described.map_or(String::new(), |place| text(&place.side)),
        Role::Header => described.map_or(String::new(), |place| text(&place.header)),
        Role::Places => others.iter().filter_map(Place::word).collect::<Vec<_>>().join(" "),
        Role::Label => text(&pin.label),
        Role::Voltage => text(&pin.voltage),
        Role::Note => text(&pin.note),
        Role::Onboard => text(&pin.onboard.as_ref().map(Onboard::to_string)),
        Role::Alternate => String::new(),
        Role::Usages => {
            let usages = pin.usages.iter().filter(|usage| usage.column == column.header);
            let usages: Vec<String> = usages
                .map(|usage| {
                    let blocks = usage.blocks.map_or(String::new(), |blocks| format!("#{blocks}"));
                    let number =
                        usage.alternate.map_or(String::new(), |number| format!("@{number}"));
                    let mark = if usage.is_routed { ROUTED.to_string() } else { String::new() };
                    format!("{mark}{}{blocks}{number}", usage.spelled)
                })
                .collect();
            if usages.is_empty() { "-".to_owned() } else { usages.join(" ") }
        }
    }
}

fn push_row(csv: &mut String, cells: impl Iterator<Item = String>) {
    for (index, cell) in cells.enumerate() {
        if index > 0 {
            csv.push(',');
        }
        // Characters that reading would remove are not written: a soft hyphen in a label,
        // surrounding blanks.
        let cell = guarded(inner(&cell, false));
        // A leading `#` would read as a comment, a leading quote as a quoted cell.
        if cell.contains([',', '"', '\n', '\r', ';', '\t']) || cell.starts_with('#') {
            csv.push_str(&format!("\"{}\"", cell.replace('"', "\"\"")));
        } else {
            csv.push_str(&cell);
        }
    }
    csv.push('\n');
}
