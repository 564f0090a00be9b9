//! What the file says of where wires are to be: what must be, and what is wished for.

use sensedsl_diagnostics::Span;

use super::Spanned;
use crate::kind::Role;
use crate::pins::PinRef;

/// What the user fixed of a device's wiring.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Placement {
    /// Fixed pins by role.
    pub pins: Vec<(Role, Spanned<PinRef>)>,
    /// Fixed peripheral instance, upper case (`ADC1`).
    pub unit: Option<Spanned<String>>,
    /// Only pins on that side.
    pub side: Option<Spanned<String>>,
    /// Only pins on that header.
    pub header: Option<Spanned<String>>,
    /// What the elements of an array have in common.
    pub together: Vec<Spanned<Together>>,
    /// The elements of an array come one after the other along a header.
    pub sequence: Option<Span>,
}

/// What the elements of an array can have in common.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Together {
    /// The peripheral instance.
    Unit,
    /// The header.
    Header,
    /// The side.
    Side,
}

impl Together {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Unit, Self::Header, Self::Side];

    /// The word of the language.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Unit => "unit",
            Self::Header => "header",
            Self::Side => "side",
        }
    }
}

/// A soft rule: `prefer` or `avoid`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Wish {
    /// True for `prefer`, false for `avoid`.
    pub prefer: bool,
    /// Of what.
    pub what: WishFor,
    /// Where the rule stands.
    pub span: Span,
}

/// What a soft rule speaks of.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum WishFor {
    /// A pin, of one role or of any.
    Pin(Option<Role>, PinRef),
    /// A peripheral instance.
    Unit(String),
    /// A side of the board.
    Side(String),
    /// A header of the board.
    Header(String),
    /// The elements of an array have something in common.
    Together(Together),
    /// The elements of an array come one after the other along a header.
    Sequence,
}
