//! `digital`: a level on a GPIO, in or out.

use sensedsl_wire::Direction;

use crate::fields::Fields;

/// The properties of this kind.
pub const PROPERTIES: &[&str] = &["pull", "edge", "active", "debounce", "initial", "pin"];

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

pub(crate) fn read(fields: &mut Fields<'_>, direction: Direction) -> Digital {
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
    Digital {
        pull,
        edge: edge.map(|word| word.value),
        active_low: active.is_some_and(|word| word.value),
        debounce_us: debounce.map_or(0, |time| time.value),
        initial: initial.is_some_and(|flag| flag.value),
    }
}
