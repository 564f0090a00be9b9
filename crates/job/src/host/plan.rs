//! The facts that every host application needs, whatever its language.
//!
//! In: one [`HostBoard`] for each board, which is its wire schema and how its values are shown. Out: a [`HostPlan`]:
//! messages sorted by direction, with their sizes, limits and texts decided. Hosts turn it into views in their
//! language; templates only print those.

use std::collections::BTreeMap;

use sensedsl_model::design::Presentation;
use sensedsl_wire::{Checksum, Direction, Item, Schema, ValueType};

/// One board as the hosts see it.
#[derive(Clone, Debug, PartialEq)]
pub struct HostBoard {
    /// The board's name in the file.
    pub name: String,
    /// The schema of its link.
    pub schema: Schema,
    /// The baud rate of the link; without effect over USB.
    pub baud: u32,
    /// The time without a frame from the host after which actuators take their failsafe value; `None` for never.
    pub silence_ms: Option<u32>,
    /// How values are shown, by wire identifier; absent for values that are shown as they come.
    pub presentations: BTreeMap<u8, Presentation>,
    /// The time from one value to the next, by wire identifier; absent for values that come only when something
    /// happens.
    pub cycles_ms: BTreeMap<u8, u32>,
}

/// All boards of a design, ready to be printed in any language.
#[derive(Clone, Debug, PartialEq)]
pub struct HostPlan {
    /// The design's name, taken from the name of its file.
    pub name: String,
    /// The boards, in file order.
    pub boards: Vec<BoardPlan>,
}

/// One board's link.
#[derive(Clone, Debug, PartialEq)]
pub struct BoardPlan {
    /// The board's name in the file.
    pub name: String,
    /// The schema hash.
    pub hash: u32,
    /// The text that the hash is computed from.
    pub schema_text: String,
    /// The checksum at the end of payloads.
    pub checksum: Checksum,
    /// Whether each report begins with the board's time and a counter.
    pub has_stamp: bool,
    /// The baud rate of the link.
    pub baud: u32,
    /// The time without a frame from the host after which actuators take their failsafe value; `None` for never.
    pub silence_ms: Option<u32>,
    /// All devices in file order, which is also their order in health.
    pub devices: Vec<DevicePlan>,
    /// Board to host.
    pub sensors: DirectionPlan,
    /// Host to board.
    pub actuators: DirectionPlan,
}

/// A device as listed in health.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DevicePlan {
    /// The name in the file.
    pub name: String,
    /// The wire identifier.
    pub id: u8,
    /// The direction in which its value travels.
    pub direction: Direction,
}

/// The messages of one direction.
#[derive(Clone, Debug, PartialEq)]
pub struct DirectionPlan {
    /// The messages, in file order.
    pub messages: Vec<MessagePlan>,
    /// The longest valid payload.
    pub payload_bytes_max: usize,
    /// The longest valid payload except health, without a checksum.
    pub short_bytes_max: usize,
}

/// The value of a sensor or an actuator.
#[derive(Clone, Debug, PartialEq)]
pub struct MessagePlan {
    /// The device's name in the file.
    pub name: String,
    /// The wire identifier.
    pub id: u8,
    /// The direction in which the value travels.
    pub direction: Direction,
    /// The type of the value.
    pub value: ValueType,
    /// The label for people.
    pub label: Option<String>,
    /// The unit of the scaled value.
    pub quantity: Option<String>,
    /// The scaling; set if a scaled value is shown besides the raw one.
    pub scaling: Option<Scaling>,
    /// The expected limits of the scaled value.
    pub limits: Limits,
    /// The time from one value to the next; `None` for values that come only when something happens.
    pub cycle_ms: Option<u32>,
}

/// The least and the greatest value of a message, finite if given.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Limits {
    /// The least value.
    pub min: Option<f64>,
    /// The greatest value.
    pub max: Option<f64>,
}

/// How a raw value becomes the shown one: `scale * raw + offset`, then the curve if there is one, linear between its
/// points and constant beyond its ends.
#[derive(Clone, Debug, PartialEq)]
pub struct Scaling {
    /// The factor, finite.
    pub scale: f64,
    /// The offset, finite.
    pub offset: f64,
    /// The points, finite, in ascending order of their first numbers; empty for no curve.
    pub curve: Vec<(f64, f64)>,
}

impl Default for Scaling {
    /// The raw value itself.
    fn default() -> Self {
        Self { scale: 1.0, offset: 0.0, curve: Vec::new() }
    }
}

impl HostPlan {
    /// Decides everything that is the same in each language. `name` is the name of the design for people.
    #[must_use]
    pub fn new(name: &str, boards: &[HostBoard]) -> Self {
        Self { name: name.to_owned(), boards: boards.iter().map(BoardPlan::new).collect() }
    }
}

impl BoardPlan {
    fn new(board: &HostBoard) -> Self {
        Self {
            name: board.name.clone(),
            hash: board.schema.hash(),
            schema_text: board.schema.canonical_text(),
            checksum: board.schema.checksum,
            has_stamp: board.schema.stamp,
            baud: board.baud,
            silence_ms: board.silence_ms,
            devices: board.schema.items.iter().map(DevicePlan::new).collect(),
            sensors: DirectionPlan::new(board, Direction::Sensor),
            actuators: DirectionPlan::new(board, Direction::Actuator),
        }
    }

    /// The messages of the sensors, then those of the actuators.
    pub fn messages(&self) -> impl Iterator<Item = &MessagePlan> {
        self.sensors.messages.iter().chain(&self.actuators.messages)
    }
}

impl DevicePlan {
    fn new(item: &Item) -> Self {
        Self { name: item.name.clone(), id: item.id, direction: item.direction }
    }
}

impl DirectionPlan {
    fn new(board: &HostBoard, direction: Direction) -> Self {
        let is_sensor = direction == Direction::Sensor;
        let items = board.schema.items.iter().filter(|item| item.direction == direction);
        let messages = items.map(|item| {
            let shown = board.presentations.get(&item.id).cloned().unwrap_or_default();
            MessagePlan {
                name: item.name.clone(),
                id: item.id,
                direction,
                value: item.value,
                scaling: Scaling::of(&shown),
                limits: Limits {
                    min: shown.min.filter(|min| min.is_finite()),
                    max: shown.max.filter(|max| max.is_finite()),
                },
                cycle_ms: board.cycles_ms.get(&item.id).copied().filter(|_| is_sensor),
                label: shown.label,
                quantity: shown.quantity,
            }
        });
        Self {
            messages: messages.collect(),
            payload_bytes_max: board.schema.payload_bytes_max(direction),
            short_bytes_max: board.schema.short_bytes_max(direction),
        }
    }
}

impl Scaling {
    /// A quantity alone means that the raw value is already in it.
    fn of(shown: &Presentation) -> Option<Self> {
        let Presentation { quantity, scale, offset, curve, .. } = shown;
        let asked = scale.is_some() || offset.is_some() || quantity.is_some() || !curve.is_empty();
        let (scale, offset) = (scale.unwrap_or(1.0), offset.unwrap_or(0.0));
        let finite = |(x, y): &(f64, f64)| x.is_finite() && y.is_finite();
        let is_finite = finite(&(scale, offset)) && curve.iter().all(finite);
        (asked && is_finite).then(|| Self { scale, offset, curve: curve.clone() })
    }
}
