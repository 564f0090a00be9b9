//! `digital`: a level on a GPIO, in or out.

use super::role::Role;
use super::spec::{KindSpec, Properties, Serves, Sharing, Values};
use crate::fields::Fields;
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
    has_cycle: true,
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

impl Properties for Digital {
    fn read(fields: &mut Fields<'_>, direction: Direction, _: ValueType) -> Self {
        let pulls = [("none", Pull::None), ("up", Pull::Up), ("down", Pull::Down)];
        let pull = fields.word("pull", &pulls).map(|word| word.value).unwrap_or_default();
        let edges = [("rising", Edge::Rising), ("falling", Edge::Falling), ("both", Edge::Both)];
        let edge = fields.word("edge", &edges);
        let active = fields.word("active", &[("high", false), ("low", true)]);
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
