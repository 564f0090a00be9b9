//! `code`: a value that code on the board makes, or a parameter that the host gives it.

use super::role::Role;
use super::spec::{KindSpec, Properties, Serves, Sharing, Values};
use crate::fields::{Codes, Fields};
use crate::meaning::{Meaning, Takes};
use sensedsl_wire::{Direction, ScalarType, ValueType};

/// The properties that all devices of this kind share.
pub const SPEC: KindSpec = KindSpec {
    name: "code",
    article: "a",
    directions: &[Direction::Sensor, Direction::Actuator],
    values: Values::Any,
    properties: &["default", "store"],
    sharing: Sharing::Own,
    triggers_itself: true,
    codes: None,
    natural: ScalarType::Float32,
    inputs_have: &[],
    of_part: &[],
    serves: Serves::Signal(|_, _| false),
    wires: "none",
    example: "",
    colour: "#240000",
    colour_on_dark: "#783C6C",
    letter: 'X',
};

/// What its properties mean.
pub(crate) const MEANINGS: &[Meaning] = &[
    Meaning::new(
        ("default", Takes::Shown),
        "0",
        "What the value is at the start, until code or the host sets it; of an array, what each element is.",
        "default = 0.8;",
    ),
    Meaning::new(
        ("store", Takes::Truth),
        "`false`",
        "Whether a parameter keeps what the host has set when the board is reset, though not without its supply.",
        "store = true;",
    ),
];

/// A value of code on the board: no wire carries it.
#[derive(Clone, Debug, PartialEq)]
pub struct Code {
    /// The code of the value at the start.
    pub default: f64,
    /// Whether a parameter survives a reset.
    pub is_stored: bool,
}

impl Properties for Code {
    fn read(fields: &mut Fields<'_>, direction: Direction, value: ValueType) -> Self {
        let range = value.scalar.integer_range();
        let range = range.map(|(least, most)| (least as f64, most as f64));
        let codes = Codes { range, is_whole: range.is_some(), pulses_us: None };
        let default = fields.code("default", codes).map_or(0.0, |code| code.value);
        let store = fields.boolean("store");
        if let (Some(store), Direction::Sensor) = (&store, direction)
            && store.value
        {
            let what =
                "what code makes is not kept: a parameter, which the host sets, is an `actuator`";
            fields.contradiction(store.span, "store", what);
        }
        Self { default, is_stored: store.is_some_and(|store| store.value) }
    }

    fn plain(_: u8) -> Self {
        Self { default: 0.0, is_stored: false }
    }

    fn roles(&self, _: Direction) -> Vec<Role> {
        Vec::new()
    }
}
