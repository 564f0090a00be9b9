//! Bytes to frames: any split of the stream, any garbage between frames.
//!
//! A candidate for a frame that cannot become a valid one loses its first byte only, and the rest
//! is looked at again: so the first valid frame is found wherever it starts. A frame that lies
//! whole in the bytes of one call is read there; only what a call leaves unfinished is copied.
//!
//! The time is linear in the bytes, whatever they are and however long a frame may be: a candidate
//! costs at most some dozens of steps. Its comma is looked at first, values are stepped over, and
//! no identifier stands twice in a payload. Where checksums, arrays of bools or identifiers were
//! gone through for a candidate that failed, the others do not go through them again: `memo`
//! answers for the bytes in constant time, `leap` for sixteen identifiers at once.

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

/// Decoder of one direction of one link.
#[derive(Clone, Debug)]
pub struct Decoder<'a> {
    schema: &'a Schema,
    rules: Rules,
    /// The first bytes of a frame whose end has not come; the candidate starts at `start`.
    held: Vec<u8>,
    start: usize,
    candidate: Candidate,
    /// Where the candidate stands in the stream.
    place: u64,
    /// Up to here a candidate that failed was gone through byte by byte.
    spent: u64,
    memo: Memo,
    /// Up to here a candidate that failed went from identifier to identifier.
    walked: u64,
    leaps: Leaps,
    frames: u64,
    dropped_bytes: u64,
}

impl<'a> Decoder<'a> {
    /// A decoder for what travels in `direction`.
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

    /// Takes the next bytes of the stream and hands each whole frame to `on_event`, with values of
    /// its own.
    pub fn feed(&mut self, bytes: &[u8], mut on_event: impl FnMut(Event)) {
        self.feed_frames(bytes, |frame| on_event(frame.into()));
    }

    /// Takes the next bytes of the stream and hands each whole frame to `on_frame`, in place:
    /// nothing is copied that arrived in one piece.
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
            // What starts in the bytes of this call is looked for there.
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

    /// Frames delivered so far.
    #[must_use]
    pub fn frames(&self) -> u64 {
        self.frames
    }

    /// Bytes so far that belonged to no delivered frame.
    #[must_use]
    pub fn dropped_bytes(&self) -> u64 {
        self.dropped_bytes
    }

    /// How many bytes the candidate in `held` lacks; while its length is read, one at a time.
    fn missing_bytes(&self) -> usize {
        let frame_bytes = self.candidate.frame_bytes;
        if frame_bytes == 0 { 1 } else { frame_bytes.saturating_sub(self.held.len() - self.start) }
    }

    /// Only when half of it is gone, so that a byte moves once on average.
    fn drop_front(&mut self) {
        if self.start > self.held.len() / 2 {
            self.held.drain(..self.start);
            self.start = 0;
        }
    }

    /// Looks for frames that start at `at` or behind it and before `limit`. Returns where the
    /// candidate starts that lacks bytes, or where to go on.
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

    /// A frame that is valid to its last byte.
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
