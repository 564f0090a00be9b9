//! `dac`: a voltage from a DAC output.

use super::spec::Properties;
use super::{KindSpec, Role, Sharing, Values};
use crate::fields::Fields;
use sensedsl_wire::{Direction, ValueType};

/// What is the same for all devices of this kind.
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

/// A DAC output.
#[derive(Clone, Debug, PartialEq)]
pub struct Dac {
    /// The value taken when the host falls silent; none to keep the last one.
    pub failsafe: Option<f64>,
}

impl Properties for Dac {
    fn read(fields: &mut Fields<'_>, _: Direction, _: ValueType) -> Self {
        Self { failsafe: fields.number("failsafe").map(|number| number.value) }
    }

    fn plain(_: u8) -> Self {
        Self { failsafe: None }
    }

    fn roles(&self, _: Direction) -> Vec<Role> {
        vec![Role::Out]
    }
}
