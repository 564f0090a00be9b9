//! Views over rules.

use super::node::{AstNode, children, choice, nodes};
use super::values::{Name, Property, StringLiteral, name, names, string};
use crate::kind::{SyntaxKind, SyntaxNode};

nodes! {
    /// `prefer NAME = VALUE;`
    Prefer = Prefer;
    /// `avoid NAME = VALUE;`
    Avoid = Avoid;
    /// `reserve NAME, ...;`
    Reserve = Reserve;
    /// `release NAME, ...;`
    Release = Release;
    /// `allow CODE "REASON";`
    Allow = Allow;
}
choice!(
    /// A rule for the wiring or the checks.
    Rule {
        /// A preference.
        Prefer(Prefer),
        /// The opposite of a preference.
        Avoid(Avoid),
        /// Pins and peripherals that must stay free.
        Reserve(Reserve),
        /// Pins and peripherals that may be used although the board uses them.
        Release(Release),
        /// A diagnostic that is accepted.
        Allow(Allow),
    }
);

impl Prefer {
    /// The preferred property.
    #[must_use]
    pub fn property(&self) -> Option<Property> {
        children(&self.0).next()
    }
}

impl Avoid {
    /// The property to avoid.
    #[must_use]
    pub fn property(&self) -> Option<Property> {
        children(&self.0).next()
    }
}

impl Reserve {
    /// The names.
    pub fn names(&self) -> impl Iterator<Item = Name> + use<> {
        names(&self.0)
    }
}

impl Release {
    /// The names.
    pub fn names(&self) -> impl Iterator<Item = Name> + use<> {
        names(&self.0)
    }
}

impl Allow {
    /// The code of the diagnostic.
    #[must_use]
    pub fn code(&self) -> Option<Name> {
        name(&self.0)
    }
    /// The reason for accepting it.
    #[must_use]
    pub fn reason(&self) -> Option<StringLiteral> {
        string(&self.0)
    }
}
