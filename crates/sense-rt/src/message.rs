//! The byte stream of a serial device: from bytes to messages, from messages to values.
//!
//! A message is `start`, the body, a checksum, `end`; the body has `length` bytes, or ends at the
//! checksum and `end`. A candidate that cannot become a message loses only its first byte, and the
//! rest is scanned again, so the first complete message is found wherever it starts, however the
//! stream is split. A body without length and checksum cannot contain `start`.

mod start;
mod table;

use core::ops::{Deref, DerefMut};

use crate::bytes::{move_down, split};
use crate::outcome::{Outcome, Sink};
use crate::schema::Schema;

pub use self::start::MessageStart;
use self::table::Verdict;
pub use self::table::{FieldFormat, MessageChecksum, MessageField, MessageTable};

/// Event counts of a stream; each wraps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct StreamCounts {
    /// Complete messages.
    pub messages: u32,
    /// Bytes that were in no message.
    pub dropped_bytes: u32,
    /// Candidates with a start, a length and an end, but a wrong checksum.
    pub wrong_checksum: u32,
    /// Fresh values.
    pub values: u32,
    /// Values that were not a measurement.
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
    /// The state at the start. `BYTES` is [`MessageTable::stream_bytes`].
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
    /// The event counts so far.
    #[must_use]
    pub fn counts(&self) -> &StreamCounts {
        &self.counts
    }

    /// Takes the next bytes of the stream, and reports the values of each complete message.
    /// `Nothing`: the field is empty. `WrongCrc`: the checksum of its message is wrong.
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

    /// The line was silent for longer than within a message (an idle line interrupt reports this):
    /// an unfinished message is dropped, and the next byte is taken for the first of a message.
    /// Devices with a weak start and no checksum need it: with SBUS a byte of the channels can look
    /// like the start, at the same place in every message.
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

    /// Drops the first byte and those after it, up to the next at which a message could begin.
    fn drop_candidate(&mut self) {
        let rest = self.held().get(1..).unwrap_or_default();
        let next = rest.iter().position(|byte| self.table.may_begin(*byte));
        self.drop_bytes(next.unwrap_or(rest.len()) + 1);
    }

    /// Before the first end, the start of a message is unknown. True if the byte was consumed.
    fn align(&mut self) -> bool {
        if self.is_aligned || !self.table.needs_alignment() {
            return false;
        }
        let end = self.table.end;
        if self.table.length == 0 && !end.is_empty() && self.held().ends_with(end) {
            self.drop_bytes(self.size);
            self.is_aligned = true;
        } else if self.size >= end.len() {
            // Enough remains to recognise the end.
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
                // Either it is too long, and its end is still to come, or it is at its end and
                // wrong.
                self.is_aligned = self.held().ends_with(self.table.end);
                self.drop_bytes(self.size);
            } else {
                self.drop_candidate();
            }
        }
    }

    /// A damaged message is reported for all its values, if it can be recognised as one.
    fn say_damaged(&self, sink: &mut Sink<'_>) {
        if !self.table.has_marks() {
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
