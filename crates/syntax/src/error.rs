//! The mistakes that a text can contain, as data: a kind with what a message needs, and a place.
//!
//! This crate words no messages. A consumer turns each kind into a coded diagnostic. The `Display`
//! forms here are noun phrases for such messages ("a sensor name", "the end of the file").

use rowan::TextRange;
use sensedsl_limits::DIAGNOSTICS_MAX;
use std::fmt;

/// A mistake in the text, with its place.
///
/// An empty range marks where something is missing: directly after the token before it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SyntaxError {
    /// The mistake.
    pub kind: SyntaxErrorKind,
    /// Its place.
    pub range: TextRange,
}

/// A mistake, with the data that a message needs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum SyntaxErrorKind {
    /// A character that begins no token; the range covers a whole run of such characters.
    UnexpectedCharacter {
        /// The first character of the run.
        character: char,
    },
    /// A `:` between two numbers, where a range has `..`.
    RangeWithColon,
    /// A `/*` without its `*/`.
    UnterminatedComment,
    /// A string that does not end on its line.
    UnterminatedString,
    /// A `\` in a string followed by something that is not an escape.
    UnknownEscape {
        /// The escape as written, with its `\`.
        escape: String,
    },
    /// A pin after the name of a device, in place of its type: `sensor Front on PA0`.
    PinInHead {
        /// The head that was probably meant: `sensor Front returns uint16`.
        head: String,
        /// The word in the place of a pin.
        pin: String,
    },
    /// A digit that is invalid in the number's base: `0b102`.
    InvalidDigit {
        /// The digit.
        digit: char,
        /// The base, 2 or 16.
        base: u32,
    },
    /// A number without the digits that must follow: `0x`, `1.`, `.5`.
    MissingDigits {
        /// The number as written.
        number: String,
    },
    /// An integer above 2^64 - 1 or a float that is not finite.
    NumberTooLarge {
        /// The number as written.
        number: String,
    },
    /// A name with non-ASCII letters, which no generated language accepts.
    NonAsciiName {
        /// The name.
        name: String,
    },
    /// A name written with hyphens: `STM32F407G-DISC1`.
    HyphenInName {
        /// The name as written.
        name: String,
        /// The name with underscores instead.
        suggestion: String,
        /// Whether it is a value, where a minus sign may be meant.
        in_value: bool,
    },
    /// A word in the place of an item that no item of this block begins with.
    UnknownItem {
        /// The word.
        found: String,
        /// The keyword that was probably meant.
        suggestion: Option<&'static str>,
        /// The block around it.
        block: Block,
    },
    /// An item that is not allowed in this block, such as a board in a board.
    NotAllowedHere {
        /// The item.
        item: Item,
        /// The block around it.
        block: Block,
    },
    /// Something other than what the grammar expects here.
    Expected {
        /// What the grammar expects.
        expected: Expected,
        /// What was found.
        found: Found,
    },
    /// A token where an item should begin or after a complete statement.
    StrayToken {
        /// The token.
        found: Found,
        /// The block around it.
        block: Block,
    },
    /// A `}` that closes nothing.
    StrayCloseBrace,
    /// A statement without its `;`. The range is directly after its last token.
    MissingSemicolon,
    /// A property without `=`: `id 17;`.
    MissingEquals {
        /// The name of the property.
        property: String,
    },
    /// `=` between the sides of a comparison.
    SingleEquals,
    /// `==` after the name of a property.
    DoubledEquals,
    /// A property without a value: `id = ;`.
    MissingValue {
        /// The name of the property.
        property: String,
    },
    /// A block that is never closed.
    MissingCloseBrace {
        /// The block.
        block: Block,
        /// Its `{`.
        open: TextRange,
    },
    /// A `(` that is never closed.
    MissingCloseParen {
        /// The `(`.
        open: TextRange,
    },
    /// A list or an array length that is never closed.
    MissingCloseBracket {
        /// Its `[`.
        open: TextRange,
    },
    /// Two values of a list, or two names of a rule, without `,` between them.
    MissingComma,
    /// A `,` without a value or name after it.
    TrailingComma,
    /// A number followed by a word that is not a unit.
    UnknownUnit {
        /// The word.
        found: String,
        /// The unit that was probably meant.
        suggestion: Option<&'static str>,
    },
    /// A list in `(` and `)` that belongs in `[` and `]`: `(1, 2)`.
    ParenthesesAroundList,
    /// A type of several words: `unsigned int`.
    TypeOfWords {
        /// The words, with one space between them.
        name: String,
    },
    /// A unit that does not follow a number: `N ms`.
    UnitAlone {
        /// The unit.
        unit: String,
    },
    /// Blocks, lists or expressions nested more deeply than the limit.
    NestingTooDeep {
        /// The deepest allowed nesting.
        limit: usize,
    },
    /// More tokens than are read; nothing after the range was read.
    TooManyTokens {
        /// The number of tokens that are read.
        limit: usize,
    },
    /// More mistakes than are reported.
    More {
        /// The number of mistakes reported.
        listed: usize,
        /// The number of mistakes not reported.
        more: usize,
    },
}

/// The mistakes found: the first ones are kept, the others counted.
#[derive(Debug, Default)]
pub(crate) struct Errors {
    pub(crate) list: Vec<SyntaxError>,
    pub(crate) more: usize,
}

impl Errors {
    pub(crate) fn push(&mut self, kind: SyntaxErrorKind, range: TextRange) {
        if self.list.len() < DIAGNOSTICS_MAX {
            self.list.push(SyntaxError { kind, range });
        } else {
            self.more += 1;
        }
    }
}

/// What the grammar expects at a place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Expected {
    /// The name of the item declared here.
    NameOf(Item),
    /// The name of a property.
    PropertyName,
    /// The name of a pin or of another resource, in `reserve` and `release`.
    ResourceName,
    /// A keyword.
    Keyword(&'static str),
    /// A data type.
    Type,
    /// The kind of device that a driver is for.
    Kind,
    /// A board name or the path of a board table, after `on`.
    BoardSource,
    /// The path of a file, after `use`.
    FilePath,
    /// The reason in words, after `allow CODE`.
    Reason,
    /// The code of a diagnostic, after `allow`.
    Code,
    /// The number of elements of an array, or the name of a constant.
    ArrayLength,
    /// A value in a list, or after a sign or an operator.
    Value,
    /// The end of a value.
    EndOfValue,
    /// The value after `..`.
    RangeEnd,
    /// A time, after `at`, `every`, `within` and the like.
    Time,
    /// The kind of a fault.
    Fault,
    /// Something that is true or false.
    Condition,
    /// A `)`.
    CloseParen,
    /// A `{`.
    OpenBrace,
    /// A `;`.
    Semicolon,
}

/// What was found at a place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Found {
    /// A token, as written.
    Token(String),
    /// The end of the file.
    EndOfFile,
}

/// Makes a type whose values are words of the grammar.
macro_rules! words {
    ($(#[$doc:meta])* $name:ident { $($value:ident = $word:literal,)+ }) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        #[expect(missing_docs, reason = "each is named after the grammar")]
        pub enum $name {
            $($value,)+
        }

        impl $name {
            /// The word with its article.
            #[must_use]
            pub fn with_article(self) -> String {
                format!("{} {self}", if self == Self::Actuator { "an" } else { "a" })
            }
        }

        impl fmt::Display for $name {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str(match self {
                    $(Self::$value => $word,)+
                })
            }
        }
    };
}

words!(
    /// An item of a file or of a block.
    Item {
        Use = "use",
        Const = "constant",
        Board = "board",
        Driver = "driver",
        Chip = "chip",
        Connection = "connection",
        Reading = "reading",
        Command = "command",
        Sensor = "sensor",
        Actuator = "actuator",
        Link = "link",
        Controller = "controller",
        Test = "test",
        Step = "step of a test",
        Rule = "rule",
        Property = "property",
    }
);
words!(
    /// A file or a block, which holds items.
    Block {
        File = "file",
        Board = "board",
        Sensor = "sensor",
        Actuator = "actuator",
        Chip = "chip",
        Connection = "connection",
        Driver = "driver",
        Reading = "reading",
        Command = "command",
        Link = "link",
        Controller = "controller",
        Test = "test",
    }
);

impl fmt::Display for Expected {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NameOf(item) => write!(f, "{} name", item.with_article()),
            Self::PropertyName => f.write_str("a property name"),
            Self::ResourceName => f.write_str("the name of a pin or a peripheral"),
            Self::Keyword(keyword) => write!(f, "`{keyword}`"),
            Self::Type => f.write_str("a data type"),
            Self::Kind => f.write_str("a kind of device"),
            Self::BoardSource => f.write_str("a board name or the path of a board table in quotes"),
            Self::FilePath => f.write_str("the path of a file in quotes"),
            Self::Reason => f.write_str("a reason in quotes"),
            Self::Code => f.write_str("the code of a diagnostic"),
            Self::ArrayLength => f.write_str("the number of elements or the name of a constant"),
            Self::Value => f.write_str("a value"),
            Self::EndOfValue => f.write_str("the end of the value"),
            Self::RangeEnd => f.write_str("the end of the range"),
            Self::Time => f.write_str("a time, such as `5 ms`"),
            Self::Fault => f.write_str("a fault, such as `no_answer`"),
            Self::Condition => f.write_str("a condition, such as `Front < 20 cm`"),
            Self::CloseParen => f.write_str("`)`"),
            Self::OpenBrace => f.write_str("`{`"),
            Self::Semicolon => f.write_str("`;`"),
        }
    }
}

impl fmt::Display for Found {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Token(text) => write!(f, "`{text}`"),
            Self::EndOfFile => f.write_str("the end of the file"),
        }
    }
}
