//! The values that one board sends and receives: a constant table that a generator prints.

use crate::checksum::Checksum;
use crate::scalar::Scalar;

/// Identifier of the link's hello, and of the stamp that a report may begin with.
pub(crate) const ID_HELLO: u8 = 0;
/// Identifier of health, the first byte of its payload.
pub(crate) const ID_HEALTH: u8 = 255;
/// Identifier of the checksum, which comes last.
pub(crate) const ID_CHECKSUM: u8 = 255;
/// The byte after the 0 of a request for health.
pub(crate) const HEALTH_REQUEST: u8 = 1;

pub(crate) const HELLO_BYTES: usize = 5;
pub(crate) const HEALTH_REQUEST_BYTES: usize = 2;
pub(crate) const STAMP_BYTES: usize = 6;
pub(crate) const HEALTH_HEAD_BYTES: usize = 19;
pub(crate) const HEALTH_DEVICE_BYTES: usize = 17;

/// A schema has at most one item for each identifier 1 to 254.
pub const ITEMS_MAX: usize = 254;
/// The size of the longest possible frame: its length has at most four digits.
pub const FRAME_BYTES_LIMIT: usize = 4 + 1 + 9999 + 1;

/// The direction in which an item or a frame travels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// From a sensor: board to host.
    ToHost,
    /// To an actuator: host to board.
    ToBoard,
}

/// A value on the link.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Item {
    /// The identifier, 1 to 254.
    pub id: u8,
    /// The type of each element.
    pub scalar: Scalar,
    /// The number of elements; 1 for a scalar.
    pub count: u16,
    /// The direction in which it travels.
    pub direction: Direction,
}

impl Item {
    /// A value of a sensor.
    #[must_use]
    pub const fn sensor(id: u8, scalar: Scalar, count: u16) -> Self {
        Self { id, scalar, count, direction: Direction::ToHost }
    }

    /// A value that the host sets.
    #[must_use]
    pub const fn actuator(id: u8, scalar: Scalar, count: u16) -> Self {
        Self { id, scalar, count, direction: Direction::ToBoard }
    }

    /// The size of the value without its identifier.
    #[must_use]
    #[inline]
    pub const fn bytes(&self) -> usize {
        self.scalar.bytes() * self.count as usize
    }
}

/// All values of a board in the order of the user's file, and the properties of its link. An item's
/// index here is its name in the code.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Schema {
    /// The items, at most 254, with unique identifiers in each direction.
    pub items: &'static [Item],
    /// The hash that the hello carries.
    pub hash: u32,
    /// Whether reports begin with the board's time and a counter.
    pub stamp: bool,
    /// The checksum at the end of payloads.
    pub checksum: Checksum,
}

impl Schema {
    /// The item with this identifier in a direction, with its index.
    #[must_use]
    pub fn find(&self, direction: Direction, id: u8) -> Option<(usize, &'static Item)> {
        let mut all = self.items.iter().enumerate();
        all.find(|(_, item)| item.id == id && item.direction == direction)
    }

    /// The size of all values: the memory of a [`crate::Store`].
    #[must_use]
    pub const fn values_bytes(&self) -> usize {
        let mut bytes = 0;
        let mut rest = self.items;
        while let [item, others @ ..] = rest {
            bytes += item.bytes();
            rest = others;
        }
        bytes
    }

    /// The place of an item's value in this memory.
    pub(crate) fn place(&self, index: usize) -> Option<(usize, &'static Item)> {
        let mut at = 0;
        for (here, item) in self.items.iter().enumerate() {
            if here == index {
                return Some((at, item));
            }
            at += item.bytes();
        }
        None
    }

    /// The size of the largest value.
    #[must_use]
    pub const fn value_bytes_max(&self) -> usize {
        let mut bytes = 0;
        let mut rest = self.items;
        while let [item, others @ ..] = rest {
            if item.bytes() > bytes {
                bytes = item.bytes();
            }
            rest = others;
        }
        bytes
    }

    /// The size of health, including all devices but not the checksum.
    #[must_use]
    pub const fn health_bytes(&self) -> usize {
        HEALTH_HEAD_BYTES + HEALTH_DEVICE_BYTES * self.items.len()
    }

    /// The size of the longest payload of values, including its stamp but not the checksum.
    pub(crate) const fn report_bytes_max(&self, direction: Direction) -> usize {
        let mut bytes = 0;
        let mut rest = self.items;
        while let [item, others @ ..] = rest {
            if item.direction as u8 == direction as u8 {
                bytes += 1 + item.bytes();
            }
            rest = others;
        }
        bytes + if self.stamps(direction) && bytes > 0 { STAMP_BYTES } else { 0 }
    }

    /// Whether payloads of values begin with a stamp in this direction.
    pub(crate) const fn stamps(&self, direction: Direction) -> bool {
        self.stamp && matches!(direction, Direction::ToHost)
    }

    /// The size of the longest payload except health, without a checksum.
    pub(crate) const fn short_bytes_max(&self, direction: Direction) -> usize {
        let asked = match direction {
            Direction::ToHost => HELLO_BYTES,
            Direction::ToBoard => HEALTH_REQUEST_BYTES,
        };
        let values = self.report_bytes_max(direction);
        if values > asked { values } else { asked }
    }

    pub(crate) const fn checksum_bytes(&self) -> usize {
        self.checksum.bytes()
    }

    /// The size of the longest payload in a direction, with its checksum.
    #[must_use]
    pub const fn payload_bytes_max(&self, direction: Direction) -> usize {
        let short = self.short_bytes_max(direction);
        let health = match direction {
            Direction::ToHost => self.health_bytes(),
            Direction::ToBoard => 0,
        };
        (if health > short { health } else { short }) + self.checksum_bytes()
    }

    /// The size of the longest frame in a direction: the buffer for encoding, and the memory of a
    /// [`crate::Decoder`].
    #[must_use]
    pub const fn frame_bytes(&self, direction: Direction) -> usize {
        let payload_bytes = self.payload_bytes_max(direction);
        head_bytes(payload_bytes) + payload_bytes + 1
    }

    /// The size of the memory of a [`crate::Reporter`]: a frame each way.
    #[must_use]
    pub const fn reporter_bytes(&self) -> usize {
        self.frame_bytes(Direction::ToHost) + self.frame_bytes(Direction::ToBoard)
    }
}

/// The size of the length field of a payload and its colon.
pub(crate) const fn head_bytes(payload_bytes: usize) -> usize {
    let mut bytes = 2;
    let mut rest = payload_bytes;
    while rest >= 10 {
        bytes += 1;
        rest /= 10;
    }
    bytes
}
