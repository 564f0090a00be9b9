//! `dac`: a voltage from a DAC output.

use crate::fields::Fields;

/// The properties of this kind.
pub const PROPERTIES: &[&str] = &["failsafe", "pin"];

/// A DAC output.
#[derive(Clone, Debug, PartialEq)]
pub struct Dac {
    /// The value taken when the host falls silent; none to keep the last one.
    pub failsafe: Option<f64>,
}

pub(crate) fn read(fields: &mut Fields<'_>) -> Dac {
    Dac { failsafe: fields.number("failsafe").map(|number| number.value) }
}
