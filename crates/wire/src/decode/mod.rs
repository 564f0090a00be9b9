//! Bytes to frames: for any split of the stream, with any garbage between frames.
//!
//! When a candidate for a frame cannot become valid, only its first byte is dropped, and the rest
//! is checked again, so that the first valid frame is found wherever it starts. A frame that is
//! entirely in the bytes of one call is read in place; only what a call leaves unfinished is
//! copied.
//!
//! The time is linear in the number of bytes, whatever the bytes and however long a frame may be: a
//! candidate costs at most a few dozen steps. Its comma is checked first, values are stepped over,
//! and no identifier occurs twice in a payload. Checksums, arrays of bools and identifiers that
//! were checked for a failed candidate are not checked again for the others: `memo` answers for the
//! bytes in constant time, and `leap` for sixteen identifiers at once.

mod candidate;
mod leap;
mod memo;
mod table;

use alloc::vec::Vec;

use self::candidate::{Candidate, Past, Rules, Verdict};
use self::leap::Leaps;
use self::memo::Memo;
pub(crate) use self::table::Table;
use crate::frame::{Event, Frame, Report, Stamp};
use crate::health::{HEALTH_VERSION, HealthFrame};
use crate::schema::{Direction, ID_HEALTH, ID_HELLO, Schema};

/// A decoder of one direction of one link.
#[derive(Clone, Debug)]
pub struct Decoder<'a> {
    schema: &'a Schema,
    rules: Rules,
    /// The first bytes of a frame whose end has not arrived; the candidate starts at `start`.
    held: Vec<u8>,
    start: usize,
    candidate: Candidate,
    /// The place of the candidate in the stream.
    place: u64,
    /// Failed candidates were checked byte by byte up to this place.
    spent: u64,
    memo: Memo,
    /// Failed candidates went from identifier to identifier up to this place.
    walked: u64,
    leaps: Leaps,
    frames: u64,
    dropped_bytes: u64,
}

impl<'a> Decoder<'a> {
    /// A decoder for frames that travel in `direction`.
    #[must_use]
    pub fn new(schema: &'a Schema, direction: Direction) -> Self {
        let table = Table::new(schema, direction);
        Self {
            schema,
            rules: Rules::new(table, schema, direction),
            held: Vec::new(),
            start: 0,
            candidate: Candidate::default(),
            place: 0,
            spent: 0,
            memo: Memo::new(schema.checksum, schema.frame_bytes_max(direction)),
            walked: 0,
            leaps: Leaps::new(schema.frame_bytes_max(direction)),
            frames: 0,
            dropped_bytes: 0,
        }
    }

    /// Takes the next bytes of the stream and passes each whole frame to `on_event`, with its own
    /// copy of the values.
    pub fn feed(&mut self, bytes: &[u8], mut on_event: impl FnMut(Event)) {
        self.feed_frames(bytes, |frame| on_event(frame.into()));
    }

    /// Takes the next bytes of the stream and passes each whole frame to `on_frame`, in place: a
    /// frame that arrived in one piece is not copied.
    pub fn feed_frames(&mut self, bytes: &[u8], mut on_frame: impl FnMut(Frame<'_>)) {
        let mut taken = 0;
        while !self.held.is_empty() {
            let missing = self.missing_bytes().min(bytes.len() - taken);
            if missing == 0 {
                return;
            }
            self.held.extend(bytes.get(taken..taken + missing).unwrap_or_default());
            taken += missing;
            let held = core::mem::take(&mut self.held);
            // Frames that start in the bytes of this call are looked for in those bytes.
            let old_bytes = held.len().saturating_sub(taken);
            let end = self.run(&held, self.start, old_bytes, &mut on_frame);
            self.held = held;
            if end >= old_bytes {
                self.held.clear();
                self.start = 0;
                taken = end - old_bytes;
            } else {
                self.start = end;
                self.drop_front();
            }
        }
        let rest = bytes.get(taken..).unwrap_or_default();
        let end = self.run(rest, 0, rest.len(), &mut on_frame);
        self.held.extend(rest.get(end..).unwrap_or_default());
    }

    /// The number of frames delivered so far.
    #[must_use]
    pub fn frames(&self) -> u64 {
        self.frames
    }

    /// The number of bytes so far that did not belong to a delivered frame.
    #[must_use]
    pub fn dropped_bytes(&self) -> u64 {
        self.dropped_bytes
    }

    /// How many bytes the candidate in `held` still needs; while its length is being read, one at a
    /// time.
    fn missing_bytes(&self) -> usize {
        let frame_bytes = self.candidate.frame_bytes;
        if frame_bytes == 0 { 1 } else { frame_bytes.saturating_sub(self.held.len() - self.start) }
    }

    /// Drops the used bytes only when they are more than half, so that a byte moves once on
    /// average.
    fn drop_front(&mut self) {
        if self.start > self.held.len() / 2 {
            self.held.drain(..self.start);
            self.start = 0;
        }
    }

    /// Looks for frames that start from `at` up to, but not including, `limit`. Returns the start
    /// of a candidate that needs more bytes, or the place to continue from.
    fn run(
        &mut self,
        bytes: &[u8],
        mut at: usize,
        limit: usize,
        on_frame: &mut impl FnMut(Frame<'_>),
    ) -> usize {
        while at < limit {
            let frame = bytes.get(at..).unwrap_or_default();
            let mut past = Past {
                place: self.place,
                memo: (self.place < self.spent).then_some(&mut self.memo),
                leaps: (self.place < self.walked).then_some(&mut self.leaps),
            };
            match self.candidate.look(&self.rules, frame, &mut past) {
                Verdict::Incomplete => return at,
                Verdict::Complete => {
                    on_frame(self.read(frame));
                    self.frames += 1;
                    at += self.candidate.frame_bytes;
                    self.place += self.candidate.frame_bytes as u64;
                }
                Verdict::Invalid => {
                    self.spent = self.spent.max(self.place + self.candidate.looked_at as u64);
                    self.walked = self.walked.max(self.place + self.candidate.at as u64);
                    let rest = bytes.get(at + 1..limit).unwrap_or_default();
                    let is_digit = |byte: &u8| matches!(byte, b'1'..=b'9');
                    let skipped = 1 + rest.iter().position(is_digit).unwrap_or(rest.len());
                    self.dropped_bytes += skipped as u64;
                    at += skipped;
                    self.place += skipped as u64;
                }
            }
            self.candidate.restart();
        }
        at
    }

    /// Reads a frame that is valid to its last byte.
    fn read<'f>(&'f self, frame: &'f [u8]) -> Frame<'f> {
        let values = self.candidate.payload_start..self.candidate.values_end;
        match frame.get(values).unwrap_or_default() {
            &[ID_HELLO] => Frame::HelloRequest,
            &[ID_HELLO, _] => Frame::HealthRequest,
            &[ID_HELLO, a, b, c, d] => Frame::Hello(u32::from_be_bytes([a, b, c, d])),
            [ID_HELLO, a, b, c, d, counter, items @ ..] => {
                let time_us = u32::from_be_bytes([*a, *b, *c, *d]);
                self.report(Some(Stamp { time_us, counter: *counter }), items)
            }
            [ID_HEALTH, HEALTH_VERSION, bytes @ ..] => {
                Frame::Health(HealthFrame { schema: self.schema, bytes })
            }
            [ID_HEALTH, version, ..] => Frame::OtherHealth(*version),
            items => self.report(None, items),
        }
    }

    fn report<'f>(&'f self, stamp: Option<Stamp>, items: &'f [u8]) -> Frame<'f> {
        Frame::Report(Report { schema: self.schema, table: &self.rules.table, stamp, items })
    }
}
