//! `analog`: a voltage on an ADC input.

use super::role::Role;
use super::spec::{KindSpec, Properties, Serves, Sharing, Values};
use crate::fields::Fields;
use crate::meaning::{Meaning, Takes};
use sensedsl_board::signal::Function;
use sensedsl_wire::{Direction, ScalarType, ValueType};

/// The code of a converter at its reference voltage.
pub(crate) const CONVERTED_MAX: f64 = 4_095.0;

/// The properties that all devices of this kind share.
pub const SPEC: KindSpec = KindSpec {
    name: "analog",
    article: "an",
    directions: &[Direction::Sensor],
    values: Values::OneNumber,
    properties: &["samples", "sampling", "pin"],
    sharing: Sharing::Own,
    triggers_itself: false,
    codes: Some((0.0, CONVERTED_MAX)),
    natural: ScalarType::Uint16,
    inputs_have: &[],
    of_part: &[],
    serves: Serves::Signal(serves),
    wires: "one ADC input",
    example: "",
    colour: "#A56301",
    colour_on_dark: "#FFCA77",
    letter: 'A',
};

/// What its properties mean, besides those that fix wires.
pub(crate) const MEANINGS: &[Meaning] = &[
    Meaning::new(
        ("samples", Takes::Whole(1, 1_024)),
        "32",
        "The value is the mean of that many conversions.",
        "samples = 64;",
    ),
    Meaning::new(
        ("sampling", Takes::Whole(1, 1_024)),
        "the target's (84 on STM32F4)",
        "Sampling time in cycles of the converter; it takes the next longer one that it has.",
        "sampling = 480;",
    ),
];

/// Samples per value if the file gives none: the number in the car's firmware.
const SAMPLES_DEFAULT: u16 = 32;

/// An analog input.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Analog {
    /// The number of conversions whose mean is the value.
    pub samples: u16,
    /// Sampling time in ADC clock cycles; none for the target's default.
    pub sampling_cycles: Option<u16>,
    /// Where the sampling time is given.
    pub sampling_span: Option<sensedsl_diagnostics::Span>,
}

fn serves(_: Role, function: &Function) -> bool {
    matches!(function, Function::Adc { .. })
}

impl Properties for Analog {
    fn read(fields: &mut Fields<'_>, _: Direction, _: ValueType) -> Self {
        let samples = fields.integer("samples", 1..=1024).and_then(|n| u16::try_from(n.value).ok());
        let cycles = fields.integer("sampling", 1..=1024);
        Self {
            samples: samples.unwrap_or(SAMPLES_DEFAULT),
            sampling_cycles: cycles.and_then(|n| u16::try_from(n.value).ok()),
            sampling_span: cycles.map(|n| n.span),
        }
    }

    fn plain(_: u8) -> Self {
        Self::default()
    }

    fn roles(&self, _: Direction) -> Vec<Role> {
        vec![Role::In]
    }
}

impl Default for Analog {
    fn default() -> Self {
        Self { samples: SAMPLES_DEFAULT, sampling_cycles: None, sampling_span: None }
    }
}
