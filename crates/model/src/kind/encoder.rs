//! `encoder`: a quadrature encoder, counted by a timer.

use super::role::Role;
use super::spec::{KindSpec, Properties, Serves, Sharing, Values};
use crate::fields::Fields;
use crate::meaning::{Meaning, Takes};
use sensedsl_board::signal::Function;
use sensedsl_wire::{Direction, ScalarType, ValueType};

/// The properties that all devices of this kind share.
pub const SPEC: KindSpec = KindSpec {
    name: "encoder",
    article: "an",
    directions: &[Direction::Sensor],
    values: Values::OneNumber,
    properties: &["counts", "a", "b"],
    sharing: Sharing::Own,
    triggers_itself: true,
    codes: None,
    natural: ScalarType::Int32,
    inputs_have: &[],
    of_part: &[],
    serves: Serves::Signal(serves),
    wires: "CH1 and CH2 of one timer, which is taken. With Embassy on RP2 a state machine at any two pins",
    example: "",
    colour: "#337F5C",
    colour_on_dark: "#72CE9C",
    letter: 'E',
};

/// What its properties mean, besides those that fix wires.
pub(crate) const MEANINGS: &[Meaning] = &[Meaning::new(
    ("counts", Takes::Whole(1, 10_000_000)),
    "none",
    "Counts per turn.",
    "counts = 1400;",
)];

/// A quadrature encoder.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Encoder {
    /// Counts per turn, for the host; none if not given.
    pub counts: Option<u32>,
}

fn serves(_: Role, function: &Function) -> bool {
    let is_input = matches!(function, Function::Timer { line, .. } if line.is_input());
    is_input || matches!(function, Function::Pio { .. })
}

impl Properties for Encoder {
    fn read(fields: &mut Fields<'_>, _: Direction, _: ValueType) -> Self {
        let counts = fields.integer("counts", 1..=10_000_000);
        Self { counts: counts.and_then(|n| u32::try_from(n.value).ok()) }
    }

    fn plain(_: u8) -> Self {
        Self { counts: None }
    }

    fn roles(&self, _: Direction) -> Vec<Role> {
        vec![Role::A, Role::B]
    }
}
