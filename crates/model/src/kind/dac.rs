//! `dac`: a voltage from a DAC output.

use super::spec::Properties;
use super::{KindSpec, Role, Sharing, Values};
use crate::fields::{Codes, Fields};
use sensedsl_wire::{Direction, ValueType};

/// The properties that all devices of this kind share.
pub const SPEC: KindSpec = KindSpec {
    name: "dac",
    article: "a",
    directions: &[Direction::Actuator],
    values: Values::OneNumber,
    properties: &["failsafe", "pin"],
    sharing: Sharing::Own,
    triggers_itself: false,
    wires: "one DAC output",
    example: "",
    colour: "#B8860B",
    letter: 'D',
};

/// The code for the reference voltage.
const CODE_MAX: f64 = 4_095.0;

/// A DAC output.
#[derive(Clone, Debug, PartialEq)]
pub struct Dac {
    /// The value taken when the host goes silent; none to keep the last one.
    pub failsafe: Option<f64>,
}

impl Properties for Dac {
    fn read(fields: &mut Fields<'_>, _: Direction, value: ValueType) -> Self {
        let is_whole = value.scalar.integer_range().is_some();
        let codes = Codes { range: Some((0.0, CODE_MAX)), is_whole, pulses_us: None };
        Self { failsafe: fields.code("failsafe", codes).map(|code| code.value) }
    }

    fn plain(_: u8) -> Self {
        Self { failsafe: None }
    }

    fn roles(&self, _: Direction) -> Vec<Role> {
        vec![Role::Out]
    }
}
