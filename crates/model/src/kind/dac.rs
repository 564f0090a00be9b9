//! `dac`: a voltage from a DAC output.

use sensedsl_board::signal::Function;

use super::analog::CONVERTED_MAX;
use super::role::Role;
use super::spec::{KindSpec, Properties, Serves, Sharing, Values};
use crate::fields::{Codes, Fields};
use crate::meaning::{Meaning, Takes};
use sensedsl_wire::{Direction, ScalarType, ValueType};

/// The properties that all devices of this kind share.
pub const SPEC: KindSpec = KindSpec {
    name: "dac",
    article: "a",
    directions: &[Direction::Actuator],
    values: Values::OneNumber,
    properties: &["failsafe", "pin"],
    sharing: Sharing::Own,
    triggers_itself: false,
    codes: Some((0.0, CONVERTED_MAX)),
    natural: ScalarType::Uint16,
    inputs_have: &[],
    of_part: &[],
    serves: Serves::Signal(serves),
    wires: "one DAC output",
    example: "",
    colour: "#653C00",
    colour_on_dark: "#DF8E1B",
    letter: 'D',
};

/// What its properties mean, besides those that fix wires.
pub(crate) const MEANINGS: &[Meaning] = &[Meaning::new(
    ("failsafe", Takes::Shown),
    "keep the last",
    "What the output becomes when the host falls silent. It begins with it at the start.",
    "failsafe = 0;",
)];

/// A DAC output.
#[derive(Clone, Debug, PartialEq)]
pub struct Dac {
    /// The value taken when the host goes silent; none to keep the last one.
    pub failsafe: Option<f64>,
}

fn serves(_: Role, function: &Function) -> bool {
    matches!(function, Function::Dac { .. })
}

impl Properties for Dac {
    fn read(fields: &mut Fields<'_>, _: Direction, value: ValueType) -> Self {
        let is_whole = value.scalar.integer_range().is_some();
        let codes = Codes { range: Some((0.0, CONVERTED_MAX)), is_whole, pulses_us: None };
        Self { failsafe: fields.code("failsafe", codes).map(|code| code.value) }
    }

    fn plain(_: u8) -> Self {
        Self { failsafe: None }
    }

    fn roles(&self, _: Direction) -> Vec<Role> {
        vec![Role::Out]
    }
}
