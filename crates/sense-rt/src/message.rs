//! The byte stream of a serial device: from bytes to messages, from messages to values.
//!
//! A message is `start`, the body, a checksum, `end`; the body has `length` bytes, or ends where
//! checksum and `end` do. A candidate that cannot become a message loses its first byte only, and the
//! rest is looked at again: so the first whole message is found wherever it starts, however the
//! stream is cut. A body without length and checksum has no `start` in it.

use core::ops::{Deref, DerefMut};

use crate::bytes::{at, move_down, split};
use crate::checksum::{crc8, sum8, sum16, xor8};
use crate::coding::Coding;
use crate::outcome::{Outcome, Sink};
use crate::parse::{field, parse_decimal, parse_degrees, parse_hex};
use crate::scalar::Scalar;
use crate::schema::{Item, Schema};

const DVB_S2_POLYNOMIAL: u8 = 0xD5;
const IBUS_START: u16 = 0xFFFF;

/// What stands behind the body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MessageChecksum {
    /// Nothing.
    None,
    /// 1 byte: low byte of the sum.
    Sum8,
    /// 1 byte: exclusive or.
    Xor8,
    /// 2 bytes, low byte first: 0xFFFF minus the sum of the bytes.
    Ibus,
    /// 1 byte: polynomial 0xD5 from 0.
    Crc8DvbS2,
    /// 3 bytes: `*` and two hex digits, exclusive or of the bytes between `start` and `*`.
    Nmea,
}

impl MessageChecksum {
    /// Bytes that it takes.
    #[must_use]
    pub const fn bytes(self) -> usize {
        match self {
            Self::None => 0,
            Self::Sum8 | Self::Xor8 | Self::Crc8DvbS2 => 1,
            Self::Ibus => 2,
            Self::Nmea => 3,
        }
    }

    /// The checksum of what stands before it, and its bytes.
    pub(crate) fn of(self, before: &[u8], start_bytes: usize, from: u8) -> ([u8; 3], usize) {
        let from = if self == Self::Nmea { start_bytes } else { usize::from(from) };
        let summed = before.get(from..).unwrap_or_default();
        let bytes = match self {
            Self::None => [0; 3],
            Self::Sum8 => [sum8(summed), 0, 0],
            Self::Xor8 => [xor8(summed), 0, 0],
            Self::Crc8DvbS2 => [crc8(DVB_S2_POLYNOMIAL, 0, summed), 0, 0],
            Self::Ibus => {
                let [low, high] = IBUS_START.wrapping_sub(sum16(summed)).to_le_bytes();
                [low, high, 0]
            }
            Self::Nmea => {
                let sum = xor8(summed);
                [b'*', hex_digit(sum >> 4), hex_digit(sum & 15)]
            }
        };
        (bytes, self.bytes())
    }

    /// Whether what begins with the checksum has that of what stands before it.
    fn is_right(self, bytes: &[u8], place: usize, start_bytes: usize, from: u8) -> bool {
        let before = bytes.get(..place).unwrap_or_default();
        let (sum, size) = self.of(before, start_bytes, from);
        (0..size).all(|index| {
            let (wanted, found) = (at(&sum, index), at(bytes, place + index));
            // Hexadecimal digits may be in lower case.
            found == wanted || self == Self::Nmea && found.to_ascii_uppercase() == wanted
        })
    }
}

const fn hex_digit(number: u8) -> u8 {
    if number < 10 { b'0' + number } else { b'A' + number - 10 }
}

/// How a number stands in a message.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FieldFormat {
    /// `byte` and `value` say how.
    Binary,
    /// Text: sign, digits, point, digits.
    Decimal,
    /// Text: `[d]ddmm.mmmm`, and N, S, E or W in the next field; in 1e-7 degrees.
    Degrees,
    /// Text: hexadecimal digits.
    Hex,
}

/// A value in a message. An array in text takes one field an element (with degrees two), one behind
/// the other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MessageField {
    /// Index of the item in the schema.
    pub item: u16,
    /// How the number stands there.
    pub format: FieldFormat,
    /// Binary: where the value begins, counted from the first byte behind `start`.
    pub byte: u16,
    /// Binary: how the value is coded.
    pub value: Coding,
    /// Text: only in a sentence whose first field ends so (`RMC`: any talker); none: in any message.
    pub sentence: Option<&'static [u8]>,
    /// Text: between fields; 0: the whole message is field 0.
    pub separator: u8,
    /// Text: which field, from 0; with a sentence, 0 is the first behind its type.
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

    /// Whether a body is of the kind that has this value.
    fn is_of(&self, body: &[u8]) -> bool {
        let Some(sentence) = self.sentence.filter(|_| self.format != FieldFormat::Binary) else {
            return true;
        };
        field(body, self.separator, 0).is_some_and(|first| first.ends_with(sentence))
    }

    /// The value in a body, which may also be the data of a CAN frame; none where it is not in it.
    #[must_use]
    pub fn read(&self, item: &Item, body: &[u8], value: &mut [u8]) -> Option<Outcome> {
        if self.format != FieldFormat::Binary {
            return self.is_of(body).then(|| self.read_text(item, body, value));
        }
        let bytes = body.get(usize::from(self.byte)..)?;
        let is_whole = self.value.wire_bytes(item.count) <= bytes.len();
        is_whole.then(|| self.value.decode(item, bytes, value))
    }

    /// One invalid element makes the whole value invalid, one that is empty makes it no measurement.
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

/// The messages of a device.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MessageTable {
    /// First bytes of every message; empty for none: then what comes before the first `end` or the
    /// first gap is dropped, because nobody knows where it began.
    pub start: &'static [u8],
    /// Last bytes; empty for none: then `length` is not 0.
    pub end: &'static [u8],
    /// The values in it.
    pub fields: &'static [MessageField],
    /// Bytes of the body; 0: as far as `end`.
    pub length: u16,
    /// Of the longest message with start, checksum and end.
    pub bytes_max: u16,
    /// Behind the body.
    pub checksum: MessageChecksum,
    /// First byte that is summed, counted from the first of `start`; not for NMEA.
    pub checksum_from: u8,
}

impl MessageTable {
    /// No message.
    pub const NEW: Self = Self {
        start: &[],
        end: &[],
        fields: &[],
        length: 0,
        bytes_max: 0,
        checksum: MessageChecksum::None,
        checksum_from: 0,
    };

    /// The memory of a [`MessageStream`].
    #[must_use]
    pub const fn stream_bytes(&self, schema: &Schema) -> usize {
        self.bytes_max as usize + schema.value_bytes_max()
    }

    /// What stands around a body.
    fn frame_bytes(&self) -> usize {
        self.start.len() + self.checksum.bytes() + self.end.len()
    }

    fn body<'a>(&self, bytes: &'a [u8]) -> &'a [u8] {
        let end = bytes.len().saturating_sub(self.end.len() + self.checksum.bytes());
        bytes.get(self.start.len()..end).unwrap_or_default()
    }

    /// Whether nothing but a place tells where a message begins.
    fn needs_alignment(&self) -> bool {
        let is_recognised = self.checksum != MessageChecksum::None || !self.end.is_empty();
        self.start.is_empty() && (self.length == 0 || !is_recognised)
    }

    /// Where nothing but `end` bounds a body and nothing sums it, another start means that the end
    /// was lost.
    fn begins_anew(&self, bytes: &[u8]) -> bool {
        let is_bare = self.length == 0 && self.checksum == MessageChecksum::None;
        let has_two = !self.start.is_empty() && bytes.len() >= 2 * self.start.len();
        is_bare && has_two && bytes.ends_with(self.start)
    }

    fn judge(&self, bytes: &[u8]) -> Verdict {
        let least = self.frame_bytes() + usize::from(self.length);
        let begun = self.start.len().min(bytes.len());
        if self.start.get(..begun) != bytes.get(..begun) {
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
enum Verdict {
    /// It may become a message.
    More,
    /// It is one.
    Whole,
    /// It is one but for its checksum.
    Damaged,
    /// It will never be one.
    Bad,
}

/// What came of a stream; all of it wraps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct StreamCounts {
    /// Whole messages.
    pub messages: u32,
    /// Bytes that were in no message.
    pub dropped_bytes: u32,
    /// Candidates with a start, a length and an end, but not the checksum.
    pub wrong_checksum: u32,
    /// Fresh values.
    pub values: u32,
    /// Values that were none.
    pub invalid: u32,
}

/// The stream of a device, with its memory in `[u8; TABLE.stream_bytes(&SCHEMA)]`.
#[derive(Debug)]
pub struct MessageStream<B: ?Sized = [u8]> {
    table: &'static MessageTable,
    schema: &'static Schema,
    size: usize,
    is_aligned: bool,
    counts: StreamCounts,
    /// A candidate, then a value.
    memory: B,
}

impl<const BYTES: usize> MessageStream<[u8; BYTES]> {
    /// At the start. `BYTES` is [`MessageTable::stream_bytes`].
    #[must_use]
    pub const fn new(table: &'static MessageTable, schema: &'static Schema) -> Self {
        let counts = StreamCounts {
            messages: 0,
            dropped_bytes: 0,
            wrong_checksum: 0,
            values: 0,
            invalid: 0,
        };
        Self { table, schema, size: 0, is_aligned: false, counts, memory: [0; BYTES] }
    }
}

impl<const BYTES: usize> Deref for MessageStream<[u8; BYTES]> {
    type Target = MessageStream;

    fn deref(&self) -> &MessageStream {
        self
    }
}

impl<const BYTES: usize> DerefMut for MessageStream<[u8; BYTES]> {
    fn deref_mut(&mut self) -> &mut MessageStream {
        self
    }
}

impl MessageStream {
    /// What came of the stream so far.
    #[must_use]
    pub fn counts(&self) -> &StreamCounts {
        &self.counts
    }

    /// Takes the next bytes of the stream, and says the values of each whole message. `Nothing`: the
    /// field is empty. `WrongCrc`: the checksum of its message does not fit.
    pub fn feed(&mut self, bytes: &[u8], sink: &mut Sink<'_>) {
        let least = self.table.frame_bytes() + usize::from(self.table.length);
        let room = usize::from(self.table.bytes_max).min(self.memory.len());
        for byte in bytes {
            match self.memory.get_mut(..room).and_then(|room| room.get_mut(self.size)) {
                Some(place) if least <= room => {
                    *place = *byte;
                    self.size += 1;
                    self.take(sink);
                }
                // No message fits into the buffer.
                _ => self.counts.dropped_bytes = self.counts.dropped_bytes.wrapping_add(1),
            }
        }
    }

    /// The line was silent for longer than within a message (an idle line tells): what has begun is
    /// dropped, and the next byte is taken for the first of a message. Devices with a weak start and
    /// no checksum need it: with SBUS a byte of the channels can look like the start, in every
    /// message at the same place.
    pub fn gap(&mut self) {
        self.drop_bytes(self.size);
        self.is_aligned = true;
    }

    fn held(&self) -> &[u8] {
        self.memory.get(..self.size).unwrap_or_default()
    }

    fn drop_bytes(&mut self, count: usize) {
        let count = count.min(self.size);
        move_down(&mut self.memory, count, self.size);
        self.size -= count;
        self.counts.dropped_bytes = self.counts.dropped_bytes.wrapping_add(count as u32);
    }

    /// Takes off the first byte, and what follows it up to the next that a message could begin with.
    fn drop_candidate(&mut self) {
        let count = match self.table.start.first() {
            None => 1,
            Some(first) => {
                let rest = self.held().get(1..).unwrap_or_default();
                rest.iter().position(|byte| byte == first).unwrap_or(rest.len()) + 1
            }
        };
        self.drop_bytes(count);
    }

    /// Before the first end nobody knows where a message began. True when the byte was taken.
    fn align(&mut self) -> bool {
        if self.is_aligned || !self.table.needs_alignment() {
            return false;
        }
        let end = self.table.end;
        if self.table.length == 0 && !end.is_empty() && self.held().ends_with(end) {
            self.drop_bytes(self.size);
            self.is_aligned = true;
        } else if self.size >= end.len() {
            // Enough stays to recognise the end.
            self.drop_bytes(1);
        }
        true
    }

    fn take(&mut self, sink: &mut Sink<'_>) {
        if self.align() {
            return;
        }
        while self.size > 0 {
            match self.table.judge(self.held()) {
                Verdict::More => return,
                Verdict::Whole => {
                    self.counts.messages = self.counts.messages.wrapping_add(1);
                    self.say_values(sink);
                    self.size = 0;
                    return;
                }
                Verdict::Damaged => {
                    self.counts.wrong_checksum = self.counts.wrong_checksum.wrapping_add(1);
                    self.say_damaged(sink);
                }
                Verdict::Bad => {}
            }
            if self.table.needs_alignment() {
                // Either too long, and its end is still to come, or at its end and wrong.
                self.is_aligned = self.held().ends_with(self.table.end);
                self.drop_bytes(self.size);
            } else {
                self.drop_candidate();
            }
        }
    }

    /// A damaged message is told of all values that it has. Without a start or an end nobody knows
    /// that it is one.
    fn say_damaged(&self, sink: &mut Sink<'_>) {
        if self.table.start.is_empty() && self.table.end.is_empty() {
            return;
        }
        let body = self.table.body(self.held());
        for field in self.table.fields.iter().filter(|field| field.is_of(body)) {
            sink(field.item.into(), Outcome::WrongCrc, &mut []);
        }
    }

    fn say_values(&mut self, sink: &mut Sink<'_>) {
        let (message, value) = split(&mut self.memory, usize::from(self.table.bytes_max));
        let body = self.table.body(message.get(..self.size).unwrap_or_default());
        for field in self.table.fields {
            let index = usize::from(field.item);
            let Some(item) = self.schema.items.get(index) else { continue };
            let value = value.get_mut(..item.bytes()).unwrap_or_default();
            match field.read(item, body, value) {
                None => {}
                Some(Outcome::Fresh) => {
                    self.counts.values = self.counts.values.wrapping_add(1);
                    sink(index, Outcome::Fresh, value);
                }
                Some(outcome) => {
                    let is_wrong = matches!(outcome, Outcome::Invalid | Outcome::WrongCrc);
                    self.counts.invalid = self.counts.invalid.wrapping_add(u32::from(is_wrong));
                    sink(index, outcome, &mut []);
                }
            }
        }
    }
}

/// How far the setting up of a serial device has come.
#[derive(Clone, Copy, Debug, Default)]
pub struct MessageStart {
    pause_until_ms: Option<u32>,
    at: usize,
}

impl MessageStart {
    /// From the beginning.
    pub const NEW: Self = Self { pause_until_ms: None, at: 0 };

    /// The step whose bytes are to be sent now; ask again until there is none. Then it pauses (and is
    /// asked in the next cycle), or all steps are done.
    pub fn next(
        &mut self,
        init: &'static [crate::InitStep],
        now_ms: u32,
    ) -> Option<&'static crate::InitStep> {
        if self.pause_until_ms.is_some_and(|until| now_ms.wrapping_sub(until) >= 0x8000_0000) {
            return None;
        }
        self.pause_until_ms = None;
        let step = init.get(self.at)?;
        self.at += 1;
        if step.pause_ms > 0 {
            // One more, for the first millisecond is cut short.
            self.pause_until_ms = Some(now_ms.wrapping_add(u32::from(step.pause_ms) + 1));
        }
        Some(step)
    }
}
