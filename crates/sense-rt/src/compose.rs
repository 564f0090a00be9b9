//! A message that is sent to a serial device: a value with what surrounds it.

use crate::bytes::{Writer, split};
use crate::coding::Coding;
use crate::message::MessageChecksum;
use crate::schema::Item;

/// A message: start, value, checksum, end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Compose {
    /// The first bytes.
    pub start: &'static [u8],
    /// The last bytes.
    pub end: &'static [u8],
    /// The coding of the value.
    pub value: Coding,
    /// The checksum after the value.
    pub checksum: MessageChecksum,
    /// The first byte that the checksum covers, counted from the first of `start`; not for NMEA.
    pub checksum_from: u8,
}

impl Compose {
    /// Only the value, in one byte.
    pub const NEW: Self = Self {
        start: &[],
        end: &[],
        value: Coding::NEW,
        checksum: MessageChecksum::None,
        checksum_from: 0,
    };

    /// Bytes of a message with the value of an item.
    #[must_use]
    pub const fn bytes(&self, item: &Item) -> usize {
        let around = self.start.len() + self.end.len() + self.checksum.bytes();
        around + self.value.wire_bytes(item.count)
    }

    /// Writes the message with the value of an item. Returns its size in bytes, or 0 if it does not
    /// fit into `message` ([`Self::bytes`] is always enough) or the value does not fit into its
    /// words.
    #[must_use]
    pub fn write(&self, item: &Item, value: &[u8], message: &mut [u8]) -> usize {
        if message.len() < self.bytes(item) {
            return 0;
        }
        let (_, room) = split(message, self.start.len());
        let value_bytes = self.value.encode(item, value, room);
        if value_bytes == 0 {
            return 0;
        }
        Writer::new(message).put(self.start);
        let (summed, rest) = split(message, self.start.len() + value_bytes);
        let mut out = Writer::new(rest);
        let (sum, sum_bytes) = self.checksum.of(summed, self.start.len(), self.checksum_from);
        out.put(sum.get(..sum_bytes).unwrap_or_default());
        out.put(self.end);
        summed.len() + out.size
    }
}
