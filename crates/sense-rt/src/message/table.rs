//! The format of messages and their fields.

use crate::bytes::at;
use crate::checksum::{crc8, crc16_of, sum8, sum16, xor8};
use crate::coding::Coding;
use crate::outcome::Outcome;
use crate::parse::{field, parse_decimal, parse_degrees, parse_hex};
use crate::scalar::Scalar;
use crate::schema::{Item, Schema};

const DVB_S2_POLYNOMIAL: u8 = 0xD5;
const LD06_POLYNOMIAL: u8 = 0x4D;
const IBUS_START: u16 = 0xFFFF;
const UMTS_POLYNOMIAL: u16 = 0x8005;
const XMODEM_POLYNOMIAL: u16 = 0x1021;

/// The checksum after the body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MessageChecksum {
    /// No checksum.
    None,
    /// 1 byte: the low byte of the sum.
    Sum8,
    /// 1 byte: exclusive or.
    Xor8,
    /// 2 bytes, low byte first: 0xFFFF minus the sum of the bytes.
    Ibus,
    /// 1 byte: CRC-8 with polynomial 0xD5 and start value 0.
    Crc8DvbS2,
    /// 1 byte: CRC-8 with polynomial 0x4D and start value 0.
    Crc8Ld06,
    /// 2 bytes, high byte first: the low 16 bits of the sum.
    Sum16,
    /// 3 bytes: `*` and two hex digits, the exclusive or of the bytes between `start` and `*`.
    Nmea,
    /// 1 byte: the low seven bits of the sum.
    Sum7,
    /// 1 byte: the low byte of the sum, inverted.
    NotSum8,
    /// 1 byte: what makes the low byte of the sum 0.
    NegSum8,
    /// 2 bytes, high byte first: what makes the low two bytes of the sum 0.
    NegSum16,
    /// 2 bytes, low byte first: CRC-16 with polynomial 0x8005 and start value 0.
    Crc16Umts,
    /// 2 bytes, high byte first: CRC-16 with polynomial 0x1021 and start value 0.
    Crc16Xmodem,
    /// No bytes after the body: its first two are 0xA and the low half, 0x5 and the high half of the
    /// exclusive or of all others. For messages without `start` and of known length.
    Slamtec,
}

impl MessageChecksum {
    /// Its size in bytes.
    #[must_use]
    pub const fn bytes(self) -> usize {
        match self {
            Self::None | Self::Slamtec => 0,
            Self::Sum8
            | Self::Sum7
            | Self::NotSum8
            | Self::NegSum8
            | Self::Xor8
            | Self::Crc8DvbS2
            | Self::Crc8Ld06 => 1,
            Self::Ibus | Self::Sum16 | Self::NegSum16 | Self::Crc16Umts | Self::Crc16Xmodem => 2,
            Self::Nmea => 3,
        }
    }

    /// The checksum of the bytes before it, and its size.
    pub(crate) fn of(self, before: &[u8], start_bytes: usize, from: u8) -> ([u8; 3], usize) {
        let from = if self == Self::Nmea { start_bytes } else { usize::from(from) };
        let summed = before.get(from..).unwrap_or_default();
        let two = |[first, second]: [u8; 2]| [first, second, 0];
        let bytes = match self {
            Self::None | Self::Slamtec => [0; 3],
            Self::Sum7 => [sum8(summed) & 0x7F, 0, 0],
            Self::NotSum8 => [!sum8(summed), 0, 0],
            Self::NegSum8 => [sum8(summed).wrapping_neg(), 0, 0],
            Self::NegSum16 => two(sum16(summed).wrapping_neg().to_be_bytes()),
            Self::Crc16Umts => two(crc16_of(UMTS_POLYNOMIAL, summed).to_le_bytes()),
            Self::Crc16Xmodem => two(crc16_of(XMODEM_POLYNOMIAL, summed).to_be_bytes()),
            Self::Sum8 => [sum8(summed), 0, 0],
            Self::Xor8 => [xor8(summed), 0, 0],
            Self::Crc8DvbS2 => [crc8(DVB_S2_POLYNOMIAL, 0, summed), 0, 0],
            Self::Crc8Ld06 => [crc8(LD06_POLYNOMIAL, 0, summed), 0, 0],
            Self::Sum16 => two(sum16(summed).to_be_bytes()),
            Self::Ibus => two(IBUS_START.wrapping_sub(sum16(summed)).to_le_bytes()),
            Self::Nmea => {
                let sum = xor8(summed);
                [b'*', hex_digit(sum >> 4), hex_digit(sum & 15)]
            }
        };
        (bytes, self.bytes())
    }

    /// Whether the bytes from `place` on begin with the checksum of those before.
    fn is_right(self, bytes: &[u8], place: usize, start_bytes: usize, from: u8) -> bool {
        let before = bytes.get(..place).unwrap_or_default();
        if self == Self::Slamtec {
            return sums_slamtec(before);
        }
        let (sum, size) = self.of(before, start_bytes, from);
        (0..size).all(|index| {
            let (wanted, found) = (at(&sum, index), at(bytes, place + index));
            // Hexadecimal digits may be in lower case.
            found == wanted || self == Self::Nmea && found.to_ascii_uppercase() == wanted
        })
    }
}

/// Whether the halves in the first two bytes are those of the exclusive or of all others.
fn sums_slamtec(message: &[u8]) -> bool {
    match message {
        [first, second, rest @ ..] => xor8(rest) == (first & 0xF) | (second << 4),
        _ => false,
    }
}

const fn hex_digit(number: u8) -> u8 {
    if number < 10 { b'0' + number } else { b'A' + number - 10 }
}

/// The format of a number in a message.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FieldFormat {
    /// Bytes, as given by `byte` and `value`.
    Binary,
    /// Text: sign, digits, point, digits.
    Decimal,
    /// Text: `[d]ddmm.mmmm`, and N, S, E or W in the next field; in 1e-7 degrees.
    Degrees,
    /// Text: hexadecimal digits.
    Hex,
}

/// A value in a message. An array in text takes one field per element (two for degrees), one after
/// the other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MessageField {
    /// Index of the item in the schema.
    pub item: u16,
    /// The format of the number.
    pub format: FieldFormat,
    /// Binary: the offset of the value from the first byte after `start`.
    pub byte: u16,
    /// Binary: the coding of the value.
    pub value: Coding,
    /// Text: only in a sentence whose first field ends with this (`RMC`: any talker); `None`: in
    /// any message.
    pub sentence: Option<&'static [u8]>,
    /// Text: the separator between fields; 0: the whole message is field 0.
    pub separator: u8,
    /// Text: the index of the field, from 0; with a sentence, 0 is the first field after its type.
    pub index: u8,
    /// Decimal: the value is the number times `10^decimals`, 0 to 18; integers are rounded.
    pub decimals: u8,
}

impl MessageField {
    /// The first byte of a message.
    pub const NEW: Self = Self {
        item: 0,
        format: FieldFormat::Binary,
        byte: 0,
        value: Coding::NEW,
        sentence: None,
        separator: 0,
        index: 0,
        decimals: 0,
    };

    /// Whether the body is of a kind that contains this value.
    pub(super) fn is_of(&self, body: &[u8]) -> bool {
        let Some(sentence) = self.sentence.filter(|_| self.format != FieldFormat::Binary) else {
            return true;
        };
        field(body, self.separator, 0).is_some_and(|first| first.ends_with(sentence))
    }

    /// The value in a body, which may also be the data of a CAN frame; `None` if the body does not
    /// contain it.
    #[must_use]
    pub fn read(&self, item: &Item, body: &[u8], value: &mut [u8]) -> Option<Outcome> {
        if self.format != FieldFormat::Binary {
            return self.is_of(body).then(|| self.read_text(item, body, value));
        }
        let bytes = body.get(usize::from(self.byte)..)?;
        let is_whole = self.value.wire_bytes(item.count) <= bytes.len();
        is_whole.then(|| self.value.decode(item, bytes, value))
    }

    /// One invalid element makes the whole value invalid, an empty one makes it `Nothing`.
    fn read_text(&self, item: &Item, body: &[u8], value: &mut [u8]) -> Outcome {
        let stride = if self.format == FieldFormat::Degrees { 2 } else { 1 };
        let first = usize::from(self.index) + usize::from(self.sentence.is_some());
        let mut outcome = Outcome::Fresh;
        for index in 0..usize::from(item.count) {
            let place = index.wrapping_mul(item.scalar.bytes());
            let element = value.get_mut(place..).unwrap_or_default();
            let one = self.read_element(item.scalar, body, first + index * stride, element);
            if one == Outcome::Invalid || (one == Outcome::Nothing && outcome != Outcome::Invalid) {
                outcome = one;
            }
        }
        outcome
    }

    fn read_element(
        &self,
        scalar: Scalar,
        body: &[u8],
        place: usize,
        element: &mut [u8],
    ) -> Outcome {
        let Some(text) = field(body, self.separator, place) else { return Outcome::Nothing };
        match self.format {
            FieldFormat::Degrees => {
                let hemisphere = field(body, self.separator, place + 1).unwrap_or_default();
                parse_degrees(text, hemisphere, scalar, element)
            }
            FieldFormat::Hex => parse_hex(text, scalar, element),
            FieldFormat::Decimal | FieldFormat::Binary => {
                parse_decimal(text, self.decimals, scalar, element)
            }
        }
    }
}

/// The format of a device's messages.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MessageTable {
    /// The first bytes of every message; empty for none: then everything before the first `end` or
    /// the first gap is dropped, because it is unknown where it began.
    pub start: &'static [u8],
    /// The last bytes; empty for none: then `length` is not 0.
    pub end: &'static [u8],
    /// The values in a message.
    pub fields: &'static [MessageField],
    /// The bytes of the body; 0: up to `end`.
    pub length: u16,
    /// The bytes of the longest message with start, checksum and end.
    pub bytes_max: u16,
    /// The checksum after the body.
    pub checksum: MessageChecksum,
    /// The first byte that the checksum covers, counted from the first of `start`; not for NMEA.
    pub checksum_from: u8,
}

impl MessageTable {
    /// A device without messages.
    pub const NEW: Self = Self {
        start: &[],
        end: &[],
        fields: &[],
        length: 0,
        bytes_max: 0,
        checksum: MessageChecksum::None,
        checksum_from: 0,
    };

    /// The size of the memory of a `MessageStream`.
    #[must_use]
    pub const fn stream_bytes(&self, schema: &Schema) -> usize {
        self.bytes_max as usize + schema.value_bytes_max()
    }

    /// The bytes around a body.
    pub(super) fn frame_bytes(&self) -> usize {
        self.start.len() + self.checksum.bytes() + self.end.len()
    }

    pub(super) fn body<'a>(&self, bytes: &'a [u8]) -> &'a [u8] {
        let end = bytes.len().saturating_sub(self.end.len() + self.checksum.bytes());
        bytes.get(self.start.len()..end).unwrap_or_default()
    }

    /// Whether only its position tells where a message begins.
    pub(super) fn needs_alignment(&self) -> bool {
        let is_recognised = self.checksum != MessageChecksum::None || !self.end.is_empty();
        self.start.is_empty() && (self.length == 0 || !is_recognised)
    }

    /// If only `end` bounds a body and no checksum covers it, a second start means that the end was
    /// lost.
    fn begins_anew(&self, bytes: &[u8]) -> bool {
        let is_bare = self.length == 0 && self.checksum == MessageChecksum::None;
        let has_two = !self.start.is_empty() && bytes.len() >= 2 * self.start.len();
        is_bare && has_two && bytes.ends_with(self.start)
    }

    fn starts_right(&self, bytes: &[u8]) -> bool {
        if self.checksum == MessageChecksum::Slamtec {
            let begins = bytes.first().is_none_or(|byte| self.may_begin(*byte));
            let goes_on = bytes.get(1).is_none_or(|byte| byte >> 4 == 0x5);
            return begins && goes_on && !self.announces_slamtec(bytes);
        }
        let begun = self.start.len().min(bytes.len());
        self.start.get(..begun) == bytes.get(..begun)
    }

    /// Before the messages, the part says once how long they are. This has the marks of a message.
    fn announces_slamtec(&self, bytes: &[u8]) -> bool {
        let [length, _] = self.length.to_le_bytes();
        bytes.starts_with(&[0xA5, 0x5A, length, 0, 0, 0x40])
    }

    /// Whether a message could begin with this byte.
    pub(super) fn may_begin(&self, byte: u8) -> bool {
        if self.checksum == MessageChecksum::Slamtec {
            return byte >> 4 == 0xA;
        }
        self.start.first().is_none_or(|first| *first == byte)
    }

    /// Whether a message with a wrong checksum can be told from other bytes.
    pub(super) fn has_marks(&self) -> bool {
        let is_slamtec = self.checksum == MessageChecksum::Slamtec;
        is_slamtec || !(self.start.is_empty() && self.end.is_empty())
    }

    pub(super) fn judge(&self, bytes: &[u8]) -> Verdict {
        let least = self.frame_bytes() + usize::from(self.length);
        if !self.starts_right(bytes) {
            return Verdict::Bad;
        }
        let ends_right = bytes.ends_with(self.end);
        if bytes.len() < least || (self.length == 0 && !ends_right) {
            let is_open = bytes.len() < usize::from(self.bytes_max) && !self.begins_anew(bytes);
            return if is_open { Verdict::More } else { Verdict::Bad };
        }
        if !ends_right {
            return Verdict::Bad;
        }
        let place = bytes.len().saturating_sub(self.end.len() + self.checksum.bytes());
        if self.checksum.is_right(bytes, place, self.start.len(), self.checksum_from) {
            Verdict::Whole
        } else {
            Verdict::Damaged
        }
    }
}

#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Verdict {
    /// It may become a message.
    More,
    /// It is a complete message.
    Whole,
    /// It is a message except for its checksum.
    Damaged,
    /// It cannot become a message.
    Bad,
}
