//! A message that is sent to a serial device: a value with what surrounds it.

use crate::bytes::{Writer, split};
use crate::coding::Coding;
use crate::convert::load_magnitude;
use crate::message::{FieldFormat, MessageChecksum};
use crate::schema::Item;

/// A number in a text: a sign, twenty digits, a point, and what separates it from the next.
const TEXT_BYTES: usize = 23;

/// A message: start, value, what is behind it, checksum, end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Compose {
    /// The first bytes.
    pub start: &'static [u8],
    /// The bytes between the value and the checksum.
    pub behind: &'static [u8],
    /// The last bytes.
    pub end: &'static [u8],
    /// The format of the number: bytes, or a decimal or hexadecimal text.
    pub format: FieldFormat,
    /// Bytes: the coding of the value.
    pub value: Coding,
    /// Text: the separator between elements; 0 for none.
    pub separator: u8,
    /// Decimal: the number is the value divided by `10^decimals`, 0 to 18.
    pub decimals: u8,
    /// The checksum.
    pub checksum: MessageChecksum,
    /// The first byte that the checksum covers, counted from the first of `start`; not for NMEA.
    pub checksum_from: u8,
}

impl Compose {
    /// Only the value, in one byte.
    pub const NEW: Self = Self {
        start: &[],
        behind: &[],
        end: &[],
        format: FieldFormat::Binary,
        value: Coding::NEW,
        separator: 0,
        decimals: 0,
        checksum: MessageChecksum::None,
        checksum_from: 0,
    };

    const fn is_text(&self) -> bool {
        !matches!(self.format, FieldFormat::Binary)
    }

    /// The most bytes of a message with the value of an item; one without text has as many.
    #[must_use]
    pub const fn bytes(&self, item: &Item) -> usize {
        let ends = self.start.len() + self.behind.len() + self.end.len();
        let value = if self.is_text() {
            TEXT_BYTES * item.count as usize
        } else {
            self.value.wire_bytes(item.count)
        };
        ends + self.checksum.bytes() + value
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
        let value_bytes = if self.is_text() {
            self.write_text(item, value, room)
        } else {
            self.value.encode(item, value, room)
        };
        if value_bytes == 0 {
            return 0;
        }
        let (_, room) = split(room, value_bytes);
        Writer::new(room).put(self.behind);
        Writer::new(message).put(self.start);
        let (summed, rest) = split(message, self.start.len() + value_bytes + self.behind.len());
        let mut out = Writer::new(rest);
        let (sum, sum_bytes) = self.checksum.of(summed, self.start.len(), self.checksum_from);
        out.put(sum.get(..sum_bytes).unwrap_or_default());
        out.put(self.end);
        summed.len() + out.size
    }

    fn write_text(&self, item: &Item, value: &[u8], room: &mut [u8]) -> usize {
        let mut out = Writer::new(room);
        for index in 0..usize::from(item.count) {
            if index > 0 && self.separator != 0 {
                out.put(&[self.separator]);
            }
            let place = index.wrapping_mul(item.scalar.bytes());
            let (magnitude, is_negative) =
                load_magnitude(item.scalar, value.get(place..).unwrap_or_default());
            if is_negative {
                out.put(b"-");
            }
            self.put_number(magnitude, &mut out);
        }
        out.size
    }

    /// The digits of a number, the highest first, with a point before the last `decimals`.
    fn put_number(&self, number: u64, out: &mut Writer<'_>) {
        let (base, decimals) = match self.format {
            FieldFormat::Hex => (16, 0),
            FieldFormat::Decimal | FieldFormat::Degrees | FieldFormat::Binary => {
                (10, usize::from(self.decimals))
            }
        };
        let mut digits = [b'0'; 20];
        let (mut rest, mut count) = (number, 0);
        for place in &mut digits {
            if rest == 0 && count > decimals {
                break;
            }
            let digit = (rest % base) as u8;
            *place = if digit < 10 { b'0' + digit } else { b'A' + digit - 10 };
            rest /= base;
            count += 1;
        }
        for (index, digit) in digits.iter().enumerate().take(count).rev() {
            out.put(&[*digit]);
            if index == decimals && decimals > 0 {
                out.put(b".");
            }
        }
    }
}
