//! `digital`: a level on a GPIO, in or out.

use super::role::Role;
use super::spec::{KindSpec, Properties, Serves, Sharing, Values};
use crate::fields::Fields;
use crate::meaning::{Meaning, Takes, first};
use sensedsl_wire::{Direction, ScalarType, ValueType};

/// The properties that all devices of this kind share.
pub const SPEC: KindSpec = KindSpec {
    name: "digital",
    article: "a",
    directions: &[Direction::Sensor, Direction::Actuator],
    values: Values::WholeNumber,
    properties: &["pull", "edge", "active", "debounce", "initial", "pin"],
    sharing: Sharing::Own,
    triggers_itself: false,
    codes: None,
    natural: ScalarType::Bool,
    inputs_have: &["pull", "edge", "debounce"],
    of_part: &[],
    serves: Serves::AnyPin,
    wires: "one GPIO; as a sensor with `edge` also the interrupt line of its number",
    example: "",
    colour: "#405160",
    colour_on_dark: "#DCE3EB",
    letter: 'G',
};

/// What its properties mean, besides those that fix wires.
pub(crate) const MEANINGS: &[Meaning] = &[
    Meaning::new(
        ("pull", Takes::Words(|| first(&PULLS))),
        "`none`",
        "The resistor inside the MCU: to the supply or to ground.",
        "pull = up;",
    ),
    Meaning::new(
        ("edge", Takes::Words(|| first(&EDGES))),
        "none",
        "Changes raise an interrupt: a `bool` is told at once, a whole number is the count of these edges \
         since the start.",
        "edge = both;",
    )
    .only(Direction::Sensor),
    Meaning::new(
        ("active", Takes::Words(|| first(&ACTIVE))),
        "`high`",
        "The level that means 1.",
        "active = low;",
    ),
    Meaning::new(
        ("debounce", Takes::Time(0, 10_000_000)),
        "0",
        "A change counts when it has lasted that long.",
        "debounce = 20 ms;",
    ),
    Meaning::new(
        ("initial", Takes::Truth),
        "`false`",
        "The output is on from the start.",
        "initial = true;",
    )
    .only(Direction::Actuator),
];

/// The resistor inside the MCU.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Pull {
    /// No resistor.
    #[default]
    None,
    /// A resistor to the supply.
    Up,
    /// A resistor to ground.
    Down,
}

/// The changes that raise an interrupt.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Edge {
    /// From low to high.
    Rising,
    /// From high to low.
    Falling,
    /// Every change.
    Both,
}

/// A GPIO.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Digital {
    /// The resistor inside the MCU.
    pub pull: Pull,
    /// The change that raises an interrupt; with one, the device takes the interrupt line with its
    /// pin's number.
    pub edge: Option<Edge>,
    /// True if low means "on".
    pub active_low: bool,
    /// How long a change must last to count.
    pub debounce_us: u32,
    /// True if an actuator is on from the start.
    pub initial: bool,
}

/// The words after `pull`.
const PULLS: [(&str, Pull); 3] = [("none", Pull::None), ("up", Pull::Up), ("down", Pull::Down)];
/// The words after `edge`.
const EDGES: [(&str, Edge); 3] =
    [("rising", Edge::Rising), ("falling", Edge::Falling), ("both", Edge::Both)];
/// The words after `active`, and whether low means "on".
const ACTIVE: [(&str, bool); 2] = [("high", false), ("low", true)];

impl Properties for Digital {
    fn read(fields: &mut Fields<'_>, direction: Direction, _: ValueType) -> Self {
        let pull = fields.word("pull", &PULLS).map(|word| word.value).unwrap_or_default();
        let edge = fields.word("edge", &EDGES);
        let active = fields.word("active", &ACTIVE);
        let debounce = fields.time_us("debounce", 0..=10_000_000);
        let initial = fields.boolean("initial");
        match direction {
            Direction::Sensor => {
                if let Some(initial) = initial {
                    fields.needs_direction(initial.span, "initial", Direction::Actuator);
                }
            }
            Direction::Actuator => {
                if let Some(edge) = edge {
                    fields.needs_direction(edge.span, "edge", Direction::Sensor);
                }
            }
        }
        Self {
            pull,
            edge: edge.map(|word| word.value),
            active_low: active.is_some_and(|word| word.value),
            debounce_us: debounce.map_or(0, |time| time.value),
            initial: initial.is_some_and(|flag| flag.value),
        }
    }

    fn plain(_: u8) -> Self {
        Self::default()
    }

    fn roles(&self, direction: Direction) -> Vec<Role> {
        match direction {
            Direction::Sensor => vec![Role::In],
            Direction::Actuator => vec![Role::Out],
        }
    }
}
