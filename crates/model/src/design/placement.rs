//! Where the file wants wires to be: what must hold, and what is wished for.

use sensedsl_diagnostics::Span;

use super::pin_ref::PinRef;
use crate::kind::Role;
use crate::spanned::Spanned;

/// The fixed parts of a device's wiring.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Placement {
    /// Fixed pins, by role.
    pub pins: Vec<(Role, Spanned<PinRef>)>,
    /// The fixed peripheral instance, in upper case (`ADC1`).
    pub unit: Option<Spanned<String>>,
    /// The side that the pins must be on.
    pub side: Option<Spanned<String>>,
    /// The header that the pins must be on.
    pub header: Option<Spanned<String>>,
    /// What the elements of an array must have in common.
    pub together: Vec<Spanned<Together>>,
    /// Where the file states that the elements of an array are consecutive on a header.
    pub sequence: Option<Span>,
}

/// Something that the elements of an array can have in common.
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
    /// All variants.
    pub const ALL: [Self; 3] = [Self::Unit, Self::Header, Self::Side];

    /// The word in the language.
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
pub struct Preference {
    /// True for `prefer`, false for `avoid`.
    pub prefer: bool,
    /// The thing preferred or avoided.
    pub what: PreferenceSubject,
    /// The place of the rule.
    pub span: Span,
}

/// The thing that a soft rule is about.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum PreferenceSubject {
    /// A pin, of one role or of any.
    Pin(Option<Role>, PinRef),
    /// A peripheral instance.
    Unit(String),
    /// A side of the board.
    Side(String),
    /// A header of the board.
    Header(String),
    /// Something that the elements of an array have in common.
    Together(Together),
    /// Consecutive elements of an array on a header.
    Sequence,
}
