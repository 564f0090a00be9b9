//! `digital`: a level on a GPIO, in or out.

use super::spec::Properties;
use super::{KindSpec, Role, Sharing, Values};
use crate::fields::Fields;
use sensedsl_wire::{Direction, ValueType};

/// What is the same for all devices of this kind.
pub const SPEC: KindSpec = KindSpec {
    name: "digital",
    article: "a",
    directions: &[Direction::Sensor, Direction::Actuator],
    values: Values::WholeNumber,
    properties: &["pull", "edge", "active", "debounce", "initial", "pin"],
    sharing: Sharing::Own,
    triggers_itself: false,
    wires: "one GPIO; as a sensor with `edge` also the interrupt line of its number",
    example: "",
    colour: "#999999",
    letter: 'G',
};

/// The resistor inside the MCU.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Pull {
    /// None.
    #[default]
    None,
    /// To the supply.
    Up,
    /// To ground.
    Down,
}

/// Changes that raise an interrupt.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Edge {
    /// Low to high.
    Rising,
    /// High to low.
    Falling,
    /// Each change.
    Both,
}

/// A GPIO.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Digital {
    /// The resistor inside the MCU.
    pub pull: Pull,
    /// With it the device takes the interrupt line of its pin's number.
    pub edge: Option<Edge>,
    /// The level that means "on" is low.
    pub active_low: bool,
    /// A change counts when it has lasted that long.
    pub debounce_us: u32,
    /// An actuator is on from the start.
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
