//! What every host application needs to know, whatever its language.
//!
//! In: one [`HostBoard`] a board, that is its wire schema and how its values are to be shown.
//! Out: a [`HostPlan`]: messages sorted by direction with their sizes, limits and texts decided.
//! Hosts turn it into views of their language; templates only print those.

use std::collections::BTreeMap;

use sensedsl_model::design::Presentation;
use sensedsl_wire::{Checksum, Direction, Item, Schema, ValueType};

/// One board as the hosts see it.
#[derive(Clone, Debug, PartialEq)]
pub struct HostBoard {
    /// The board's name in the file.
    pub name: String,
    /// Its link.
    pub schema: Schema,
    /// Baud rate of the link; of no effect over USB.
    pub baud: u32,
    /// After how long without a frame from the host actuators take their failsafe; none for never.
    pub silence_ms: Option<u32>,
    /// By wire identifier; absent for what is shown as it comes.
    pub presentations: BTreeMap<u8, Presentation>,
    /// From one value to the next, by wire identifier; absent where values come only when something
    /// happens.
    pub cycles_ms: BTreeMap<u8, u32>,
}

/// All boards of a design, ready to be printed in any language.
#[derive(Clone, Debug, PartialEq)]
pub struct HostPlan {
    /// The design's name: what its file is called.
    pub name: String,
    /// In file order.
    pub boards: Vec<BoardPlan>,
}

/// One board's link.
#[derive(Clone, Debug, PartialEq)]
pub struct BoardPlan {
    /// The board's name in the file.
    pub name: String,
    /// The schema hash.
    pub hash: u32,
    /// The text that the hash is made of.
    pub schema_text: String,
    /// What frames end with.
    pub checksum: Checksum,
    /// Whether each report begins with the board's time and a counter.
    pub has_stamp: bool,
    /// Baud rate of the link.
    pub baud: u32,
    /// After how long without a frame from the host actuators take their failsafe; none for never.
    pub silence_ms: Option<u32>,
    /// All devices in file order, which is that of their health.
    pub devices: Vec<DevicePlan>,
    /// Board to host.
    pub sensors: DirectionPlan,
    /// Host to board.
    pub actuators: DirectionPlan,
}

/// A device as health has it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DevicePlan {
    /// Its name in the file.
    pub name: String,
    /// Wire identifier.
    pub id: u8,
    /// Which way its value travels.
    pub direction: Direction,
}

/// What travels one way.
#[derive(Clone, Debug, PartialEq)]
pub struct DirectionPlan {
    /// In file order.
    pub messages: Vec<MessagePlan>,
    /// Longest valid payload.
    pub payload_bytes_max: usize,
    /// The same but health, and without a checksum.
    pub short_bytes_max: usize,
}

/// One sensor's or actuator's value.
#[derive(Clone, Debug, PartialEq)]
pub struct MessagePlan {
    /// The device's name in the file.
    pub name: String,
    /// Wire identifier.
    pub id: u8,
    /// Which way it travels.
    pub direction: Direction,
    /// What it carries.
    pub value: ValueType,
    /// A text for people.
    pub label: Option<String>,
    /// The unit of the scaled value.
    pub quantity: Option<String>,
    /// Set when a scaled value is to be shown beside the raw one.
    pub scaling: Option<Scaling>,
    /// What the scaled value is expected to keep to.
    pub limits: Limits,
    /// From one value to the next; none where values come only when something happens.
    pub cycle_ms: Option<u32>,
}

/// Least and greatest value of a message, finite where there is one.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Limits {
    /// Least.
    pub min: Option<f64>,
    /// Greatest.
    pub max: Option<f64>,
}

/// How a raw value becomes the shown one: `scale * raw + offset`, and through the curve where there is
/// one, linear between its points, its ends held beyond them.
#[derive(Clone, Debug, PartialEq)]
pub struct Scaling {
    /// Factor, finite.
    pub scale: f64,
    /// Summand, finite.
    pub offset: f64,
    /// Points, finite, the first numbers ascending; empty for none.
    pub curve: Vec<(f64, f64)>,
}

impl Default for Scaling {
    /// The raw value itself.
    fn default() -> Self {
        Self { scale: 1.0, offset: 0.0, curve: Vec::new() }
    }
}

impl HostPlan {
    /// Decides everything that is the same in each language. `name` is what people call the design.
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

    /// Sensors, then actuators.
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
    /// A quantity alone says that the raw value is in it already.
    fn of(shown: &Presentation) -> Option<Self> {
        let Presentation { quantity, scale, offset, curve, .. } = shown;
        let asked = scale.is_some() || offset.is_some() || quantity.is_some() || !curve.is_empty();
        let (scale, offset) = (scale.unwrap_or(1.0), offset.unwrap_or(0.0));
        let finite = |(x, y): &(f64, f64)| x.is_finite() && y.is_finite();
        let is_finite = finite(&(scale, offset)) && curve.iter().all(finite);
        (asked && is_finite).then(|| Self { scale, offset, curve: curve.clone() })
    }
}
