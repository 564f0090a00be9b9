//! The identifiers on one board's link, and what each of them carries.

use alloc::string::String;
use alloc::vec::Vec;
use core::fmt::Write as _;

use crate::checksum::crc32_iso_hdlc;
use crate::scalar::ValueType;

/// Identifier of the link's hello, and of the stamp that a report may begin with.
pub const ID_HELLO: u8 = 0;
/// Identifier of the optional trailing checksum.
pub const ID_CHECKSUM: u8 = 255;
/// Identifier that a health frame begins with; the checksum, which has the same identifier, comes
/// last.
pub const ID_HEALTH: u8 = 255;

/// Bytes of the board's hello: its identifier and the schema hash.
pub(crate) const HELLO_BYTES: usize = 5;
/// Bytes of the host's request for a hello.
pub(crate) const HELLO_REQUEST_BYTES: usize = 1;
/// Bytes of the host's request for health.
pub(crate) const HEALTH_REQUEST_BYTES: usize = 2;
/// Bytes of a stamp: its identifier, the time and the counter.
pub const STAMP_BYTES: usize = 6;
/// Bytes of health before the devices, including its identifier.
pub(crate) const HEALTH_HEAD_BYTES: usize = 19;
/// Bytes of one device's health.
pub(crate) const HEALTH_DEVICE_BYTES: usize = 17;

/// The direction in which an item travels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Direction {
    /// From board to host: a sensor.
    Sensor,
    /// From host to board: an actuator.
    Actuator,
}

impl Direction {
    /// The keyword in the language.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Sensor => "sensor",
            Self::Actuator => "actuator",
        }
    }
}

/// The `checksum` property of a link.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Checksum {
    /// No checksum, as in the paper's frames.
    #[default]
    None,
    /// CRC-16/CCITT-FALSE after identifier 255.
    Crc16,
    /// CRC-32/ISO-HDLC after identifier 255.
    Crc32,
}

/// A value on a link.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Item {
    /// The identifier, 1 to 254, unique in a schema.
    pub id: u8,
    /// The device's name.
    pub name: String,
    /// The direction in which it travels.
    pub direction: Direction,
    /// The type of the value.
    pub value: ValueType,
}

/// All values of one board's link, in file order.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Schema {
    /// The checksum that frames end with.
    pub checksum: Checksum,
    /// Whether each report begins with the board's time stamp and a counter.
    pub stamp: bool,
    /// The items in file order, with unique identifiers.
    pub items: Vec<Item>,
}

impl Schema {
    /// The item with that identifier that travels in `direction`.
    #[must_use]
    pub fn item(&self, direction: Direction, id: u8) -> Option<&Item> {
        self.items.iter().find(|item| item.id == id && item.direction == direction)
    }

    /// The text whose CRC-32 is the schema hash: a line for the checksum, a line `stamp` if reports
    /// have one, then a line for each device.
    #[must_use]
    pub fn canonical_text(&self) -> String {
        let mut text = String::new();
        // Writing to a String cannot fail.
        let _ = writeln!(text, "checksum {}", self.checksum.name());
        if self.stamp {
            text.push_str("stamp\n");
        }
        for Item { id, name, direction, value } in &self.items {
            let _ = writeln!(text, "{id} {} {name} {value}", direction.name());
        }
        text
    }

    /// The hash by which host and board check that they have the same devices.
    #[must_use]
    pub fn hash(&self) -> u32 {
        crc32_iso_hdlc(self.canonical_text().as_bytes())
    }

    /// Bytes of the longest report in that direction, including its stamp but not the checksum; 0
    /// if nothing travels that way.
    fn report_bytes_max(&self, direction: Direction) -> usize {
        let items = self.items.iter().filter(|item| item.direction == direction);
        let values: usize = items.map(|item| 1 + item.value.size_bytes()).sum();
        let is_stamped = self.stamp && direction == Direction::Sensor && values > 0;
        values + if is_stamped { STAMP_BYTES } else { 0 }
    }

    /// Bytes of the longest payload except health in that direction, without a checksum; at least
    /// those of a hello, or of a request for health.
    #[must_use]
    pub fn short_bytes_max(&self, direction: Direction) -> usize {
        let asked = match direction {
            Direction::Sensor => HELLO_BYTES,
            Direction::Actuator => HEALTH_REQUEST_BYTES,
        };
        self.report_bytes_max(direction).max(asked)
    }

    /// Bytes of health, including all devices but not the checksum.
    pub(crate) fn health_bytes(&self) -> usize {
        HEALTH_HEAD_BYTES + HEALTH_DEVICE_BYTES * self.items.len()
    }

    /// Bytes of the longest valid payload in that direction.
    #[must_use]
    pub fn payload_bytes_max(&self, direction: Direction) -> usize {
        let health = match direction {
            Direction::Sensor => self.health_bytes(),
            Direction::Actuator => 0,
        };
        self.short_bytes_max(direction).max(health) + self.checksum.size_bytes()
    }

    /// Bytes of the longest valid frame in that direction, including `LEN`, `:` and `,`.
    #[must_use]
    pub fn frame_bytes_max(&self, direction: Direction) -> usize {
        let payload_bytes = self.payload_bytes_max(direction);
        let digits = payload_bytes.checked_ilog10().unwrap_or(0) as usize + 1;
        digits + 2 + payload_bytes
    }
}
