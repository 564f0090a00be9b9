//! Mistakes and doubtful entries in a board table, as data; the caller assigns code, severity and
//! words.

use std::ops::Range;

use crate::landmark::LandmarkKind;
use crate::pin::PinName;

/// A mistake and its place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Finding {
    /// The mistake.
    pub kind: FindingKind,
    /// The bytes of the text that it is about.
    pub range: Range<usize>,
    /// The line that those bytes start in, from 1.
    pub row: usize,
    /// The header of the column that it is in.
    pub column: Option<String>,
}

/// The kinds of mistakes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum FindingKind {
    /// No header line, or no pin below it.
    EmptyTable,
    /// No column has the header `Pin`.
    NoPinColumn {
        /// The column that was probably meant.
        nearest: Option<String>,
    },
    /// A header is there twice; the second column is not read.
    DuplicateColumn {
        /// The header.
        header: String,
        /// The first column's header cell.
        first: Range<usize>,
    },
    /// A column has cells but no header; it is not read.
    UnnamedColumn,
    /// A row has more or fewer cells than there are columns.
    RaggedRow {
        /// Number of columns.
        expected: usize,
        /// Number of cells.
        found: usize,
    },
    /// A quoted cell does not end, or continues after its closing quote.
    BadQuote,
    /// A row lists usages but names no pin; it is not read.
    MissingPin,
    /// A pin cell does not contain a pin name; the row is not read.
    BadPinName {
        /// The cell.
        spelled: String,
    },
    /// A pin has two rows; the second is not read.
    DuplicatePin {
        /// The pin.
        pin: PinName,
        /// The first row's pin cell.
        first: Range<usize>,
    },
    /// A word of the column `Places` that is no place; it is not read.
    BadPlace {
        /// The word.
        spelled: String,
    },
    /// The board's form has the connector, but not this contact.
    NoContact {
        /// Connector and contact.
        contact: String,
        /// The form.
        form: String,
    },
    /// A contact is there twice without carrying the same; the second is read all the same.
    ContactTwice {
        /// Connector and contact.
        contact: String,
        /// What the first one carries.
        first: String,
    },
    /// The table's line `# form = …` names no form.
    UnknownForm {
        /// The name.
        spelled: String,
        /// The name that was probably meant.
        nearest: Option<String>,
    },
    /// An entry of a table's line `# buttons = …` or `# leds = …` is not a name with two numbers; the
    /// line is not read.
    BadLandmark {
        /// What the line lists.
        kind: LandmarkKind,
        /// The entry.
        spelled: String,
    },
    /// A usage is in a row twice; it is read, and counts, once.
    DuplicateUsage {
        /// The usage as the table spells it.
        spelled: String,
        /// The first occurrence.
        first: Range<usize>,
    },
    /// A usage looks like a signal of a known peripheral, but is not one.
    MalformedSignal {
        /// The usage.
        spelled: String,
        /// The known spelling that was probably meant.
        nearest: Option<String>,
    },
    /// An alternate function that is not a number from 0 to 15, or a remap block that is not one
    /// from 0 to 15.
    BadAlternate {
        /// The cell's text.
        spelled: String,
    },
    /// An `AF` cell names a signal that the row does not list.
    UnknownAlternate {
        /// The signal.
        signal: String,
        /// The row's signal that was probably meant.
        nearest: Option<String>,
    },
    /// An `AF` cell has bare numbers, but not one for each usage.
    AlternateCount {
        /// Usages of the row that have an alternate function.
        expected: usize,
        /// Numbers in the cell.
        found: usize,
    },
    /// `TIM3_CH1@2` and the row's `AF` cell disagree; the usage wins.
    AlternateConflict {
        /// The usage as the table spells it.
        spelled: String,
        /// The number at the usage.
        usage: u8,
        /// The number in the `AF` cell.
        cell: u8,
    },
    /// The word after the colon of an `Onboard` cell is not `taken`, `bus` or `care`.
    BadOccupation {
        /// The word.
        spelled: String,
        /// The word that was probably meant.
        nearest: Option<String>,
    },
    /// `# mcu = …` does not name anything that looks like an MCU.
    UnknownMcu {
        /// The name.
        spelled: String,
        /// The known MCU that was probably meant.
        nearest: Option<String>,
    },
    /// A `# key = value` line repeats a key; the first one counts.
    DuplicateProperty {
        /// The key.
        key: String,
    },
    /// A no-break space or another invisible character; it is read as a space or dropped.
    InvisibleCharacter {
        /// The character.
        character: char,
    },
    /// More of something than a table may have; what follows is not read.
    TooLarge {
        /// The name of the limit that was exceeded.
        what: &'static str,
        /// The value of that limit.
        most: usize,
    },
    /// More mistakes than are reported.
    More {
        /// The number of mistakes reported.
        listed: usize,
        /// The number of mistakes not reported.
        more: usize,
    },
}
