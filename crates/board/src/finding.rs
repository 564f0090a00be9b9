//! What is wrong or doubtful in a board table, as data; its code, severity and words are given by
//! the caller.

use std::ops::Range;

use crate::pin::PinName;

/// A mistake and its place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Finding {
    /// What is wrong.
    pub kind: FindingKind,
    /// The bytes of the text it is about.
    pub range: Range<usize>,
    /// The line those bytes start in, from 1.
    pub row: usize,
    /// The header of the column it stands in.
    pub column: Option<String>,
}

/// One kind of mistake each.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum FindingKind {
    /// No header line, or no pin below it.
    EmptyTable,
    /// No column is called `Pin`.
    NoPinColumn {
        /// The column that was probably meant.
        nearest: Option<String>,
    },
    /// A header stands twice; the second column is not read.
    DuplicateColumn {
        /// The header.
        header: String,
        /// The first column's header cell.
        first: Range<usize>,
    },
    /// A column has cells and no header; it is not read.
    UnnamedColumn,
    /// A row has more or fewer cells than there are columns.
    RaggedRow {
        /// Number of columns.
        expected: usize,
        /// Number of cells.
        found: usize,
    },
    /// A quoted cell does not end, or goes on behind its closing quote.
    BadQuote,
    /// A row lists usages and names no pin; it is not read.
    MissingPin,
    /// A pin cell that names no pin; the row is not read.
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
    /// A usage stands twice in a row; it is read, and counts, once.
    DuplicateUsage {
        /// As the table spells it.
        spelled: String,
        /// The first one.
        first: Range<usize>,
    },
    /// A usage looks like a signal of a known peripheral and is none.
    MalformedSignal {
        /// The usage.
        spelled: String,
        /// The known spelling that was probably meant.
        nearest: Option<String>,
    },
    /// An alternate function that is no number from 0 to 15, or remap blocks that are none from 0
    /// to 7.
    BadAlternate {
        /// As the table spells it.
        spelled: String,
    },
    /// An `AF` cell names a signal that the row does not list.
    UnknownAlternate {
        /// The signal.
        signal: String,
        /// The row's signal that was probably meant.
        nearest: Option<String>,
    },
    /// An `AF` cell of bare numbers that are not one for each usage.
    AlternateCount {
        /// Usages of the row that have an alternate function.
        expected: usize,
        /// Numbers in the cell.
        found: usize,
    },
    /// `TIM3_CH1@2` and the row's `AF` cell disagree; the usage wins.
    AlternateConflict {
        /// As the table spells it.
        spelled: String,
        /// The number at the usage.
        usage: u8,
        /// The number in the `AF` cell.
        cell: u8,
    },
    /// The word behind the colon of an `Onboard` cell is none of `taken`, `bus`, `care`.
    BadOccupation {
        /// The word.
        spelled: String,
        /// The word that was probably meant.
        nearest: Option<String>,
    },
    /// `# mcu = …` names nothing that looks like an MCU.
    UnknownMcu {
        /// The name.
        spelled: String,
        /// The known one that was probably meant.
        nearest: Option<String>,
    },
    /// A `# key = value` line repeats a key; the first one counts.
    DuplicateProperty {
        /// The key.
        key: String,
    },
    /// A no-break space or another character that cannot be seen; it is read as a space or left
    /// out.
    InvisibleCharacter {
        /// Which one.
        character: char,
    },
    /// More of something than a table has; what stands behind is not read.
    TooLarge {
        /// Of what.
        what: &'static str,
        /// How much is read.
        most: usize,
    },
    /// More mistakes than are listed.
    More {
        /// How many are listed.
        listed: usize,
        /// How many are not.
        more: usize,
    },
}
