//! The verdict on a certificate.
//!
//! In: conditions that must hold. Out: what was proved, or why the certificate is refused. Every
//! part of the verifier ends in one of these, so they stand apart from all of them.

use crate::format::Objective;
use std::fmt;

/// The claim that a certificate was found to prove.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Verified {
    /// The wiring is valid and none is better.
    Best(Objective),
    /// There is no wiring.
    NoWiring,
}

impl fmt::Display for Verified {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Best(objective) => {
                write!(f, "the wiring is valid and none is better: {objective}")
            }
            Self::NoWiring => f.write_str("there is no wiring"),
        }
    }
}

/// Why a text is not a certificate of this format.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unusable(pub String);

/// Why a certificate does not prove what it claims.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Refuted(pub String);

impl fmt::Display for Unusable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl fmt::Display for Refuted {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for Unusable {}
impl std::error::Error for Refuted {}

/// Returns [`Refuted`] if a condition does not hold.
pub(crate) fn ensure(holds: bool, otherwise: impl FnOnce() -> String) -> Result<(), Refuted> {
    if holds { Ok(()) } else { Err(Refuted(otherwise())) }
}
