//! The board table: the wide CSV form of a pin table in, pins with their usages out, and back.
//!
//! The format is described in `docs/board-tables.md`.

use std::fmt;
use std::ops::Range;

use crate::cells::{bare, guarded, inner, says_nothing};
use crate::finding::Finding;
use crate::pin::PinName;
use crate::remap::Blocks;
use crate::signal::Signal;

/// A table and what is to be said about it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Loaded {
    /// What was understood.
    pub board: Table,
    /// Mistakes, in the order of the text.
    pub findings: Vec<Finding>,
}

/// Reads a table. Never fails: what cannot be read is left out and found.
#[must_use]
pub fn load(text: &str) -> Loaded {
    crate::load::load(text)
}

/// The pins of one board or MCU.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Table {
    /// The MCU, from a leading line `# mcu = …`.
    pub mcu: Option<String>,
    /// All leading lines `# key = value`, that of the MCU included.
    pub properties: Vec<Property>,
    /// The columns that are read, in order.
    pub columns: Vec<Column>,
    /// The pins in natural order.
    pub pins: Vec<Pin>,
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
    /// The header as it is spelled.
    pub header: String,
    /// What its cells are.
    pub role: Role,
    /// The bytes of the header.
    pub range: Range<usize>,
}

/// What the cells of a column are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// The pin's name.
    Pin,
    /// Where on the package.
    Position,
    /// At which edge of the board.
    Side,
    /// At which connector.
    Header,
    /// What on the board is connected to the pin.
    Onboard,
    /// What is printed beside the pin.
    Label,
    /// The voltages the pin bears.
    Voltage,
    /// Anything.
    Note,
    /// Alternate-function numbers of the row's usages.
    Alternate,
    /// Usages: every other column.
    Usages,
}

impl Role {
    /// The roles a header can name; all but [`Role::Usages`].
    pub const NAMED: [(&'static str, Self); 9] = [
        ("Pin", Self::Pin),
        ("Position", Self::Position),
        ("Side", Self::Side),
        ("Header", Self::Header),
        ("Onboard", Self::Onboard),
        ("Label", Self::Label),
        ("Voltage", Self::Voltage),
        ("Note", Self::Note),
        ("AF", Self::Alternate),
    ];

    /// The role a header names.
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
    /// The usages, in the order of the row, each signal once.
    pub usages: Vec<Usage>,
    /// Where on the package.
    pub position: Option<String>,
    /// At which edge of the board.
    pub side: Option<String>,
    /// At which connector.
    pub header: Option<String>,
    /// What is printed beside it.
    pub label: Option<String>,
    /// The voltages it bears.
    pub voltage: Option<String>,
    /// A remark.
    pub note: Option<String>,
    /// What on the board is connected to it.
    pub onboard: Option<Onboard>,
    /// The line in the text, from 1.
    pub row: usize,
    /// The bytes of the pin cell.
    pub range: Range<usize>,
}

impl Pin {
    /// The opportunity cost of taking the pin: its number of usages over all columns.
    #[must_use]
    pub fn cost(&self) -> u32 {
        u32::try_from(self.usages.len()).unwrap_or(u32::MAX)
    }

    /// The usage of a signal, by its canonical name.
    #[must_use]
    pub fn usage(&self, signal: &Signal) -> Option<&Usage> {
        self.usages.iter().find(|usage| usage.signal == *signal)
    }
}

/// One thing a pin can be used for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Usage {
    /// As the table spells it, without remap blocks and alternate-function number: `ADC12-IN8`.
    pub spelled: String,
    /// What it means.
    pub signal: Signal,
    /// The number of the alternate function, where the table gives it.
    pub alternate: Option<u8>,
    /// The remap blocks of its peripheral in which it is on this pin; none where it always is.
    pub blocks: Option<Blocks>,
    /// The header of the column it stands in.
    pub column: String,
    /// The bytes of the usage.
    pub range: Range<usize>,
}

/// A part of the board that is connected to a pin.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Onboard {
    /// The part: `CS43L22`.
    pub part: String,
    /// What that means for other uses.
    pub how: Occupation,
}

/// What a `release` rule calls an on-board part: its name with `_` for whatever is neither letter nor digit.
/// `CAN transceiver` is released as `CAN_transceiver`, in any case of letters.
#[must_use]
pub fn release_name(part: &str) -> String {
    part.chars().map(|letter| if letter.is_alphanumeric() { letter } else { '_' }).collect()
}

/// What an on-board part leaves of its pin.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Occupation {
    /// Nothing: the pin is not offered.
    Taken,
    /// It hangs on a bus that other devices of the same kind may join.
    Bus,
    /// The pin can be used by who knows what is connected.
    Care,
}

impl Occupation {
    /// The words behind the colon of an `Onboard` cell; none means [`Occupation::Taken`].
    pub const WORDS: [(&'static str, Self); 3] =
        [("taken", Self::Taken), ("bus", Self::Bus), ("care", Self::Care)];
}

impl fmt::Display for Onboard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.how {
            // The word is left out where the part alone says the same.
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

impl Table {
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

    /// The canonical wide CSV: pins in natural order, alternate functions at their usages. It
    /// loads to an equal table, places apart.
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
            push_row(&mut csv, columns.iter().map(|column| cell(pin, column)));
        }
        csv
    }
}

/// The content of one cell.
fn cell(pin: &Pin, column: &Column) -> String {
    // A dash would be read as nothing.
    let plain =
        |text: String| if says_nothing(&inner(&text, false)) { String::new() } else { text };
    let text = |text: &Option<String>| text.clone().map(plain).unwrap_or_default();
    match column.role {
        Role::Pin => pin.spelled.clone(),
        Role::Position => text(&pin.position),
        Role::Side => text(&pin.side),
        Role::Header => text(&pin.header),
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
                    format!("{}{blocks}{number}", usage.spelled)
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
        // What reading would take off is not written: a soft hyphen of a label, blanks around it.
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
