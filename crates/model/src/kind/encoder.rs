//! `encoder`: a quadrature encoder, counted by a timer.

use crate::fields::Fields;

/// The properties of this kind.
pub const PROPERTIES: &[&str] = &["counts", "a", "b"];

/// A quadrature encoder.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Encoder {
    /// Counts per turn, for the host; none where it is not given.
    pub counts: Option<u32>,
}

pub(crate) fn read(fields: &mut Fields<'_>) -> Encoder {
    let counts = fields.integer("counts", 1..=10_000_000);
    Encoder { counts: counts.and_then(|n| u32::try_from(n.value).ok()) }
}
