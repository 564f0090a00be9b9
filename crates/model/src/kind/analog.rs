//! `analog`: a voltage on an ADC input.

use crate::fields::Fields;

/// The properties of this kind.
pub const PROPERTIES: &[&str] = &["samples", "sampling", "pin"];

/// Samples per value where the file says nothing: what the car's firmware took.
const SAMPLES_DEFAULT: u16 = 32;

/// An analog input.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Analog {
    /// The value is the mean of that many conversions.
    pub samples: u16,
    /// Sampling time in ADC clock cycles; none for the target's default.
    pub sampling_cycles: Option<u16>,
    /// Where it is given.
    pub sampling_span: Option<sensedsl_diagnostics::Span>,
}

pub(crate) fn read(fields: &mut Fields<'_>) -> Analog {
    let samples = fields.integer("samples", 1..=1024).and_then(|n| u16::try_from(n.value).ok());
    let cycles = fields.integer("sampling", 1..=1024);
    Analog {
        samples: samples.unwrap_or(SAMPLES_DEFAULT),
        sampling_cycles: cycles.and_then(|n| u16::try_from(n.value).ok()),
        sampling_span: cycles.map(|n| n.span),
    }
}

impl Default for Analog {
    fn default() -> Self {
        Self { samples: SAMPLES_DEFAULT, sampling_cycles: None, sampling_span: None }
    }
}
