//! Bytes to frames: for any cut of the stream, with any garbage between frames.
//!
//! When bytes cannot become a frame, one of them is dropped and the rest is looked at again, so that the first valid
//! frame is found wherever it starts. A frame that is whole in the bytes of one call is read in place; what a call
//! leaves unfinished is held, in memory for one frame. Each byte that may begin a frame costs at most a step for each
//! identifier and one checksum.

use core::marker::PhantomData;

use super::health::HealthFrame;
use super::wire::{CHECKSUM, HEALTH, HEALTH_BYTES, HEALTH_VERSION, HELLO, STAMP_BYTES, Schema, Stamp, Table};

/// What a frame says.
#[derive(Clone, Copy, Debug)]
pub enum Found<'a, S: Schema> {
    /// Values.
    Report(Report<'a, S>),
    /// The board's schema hash.
    Hello(u32),
    /// How the board is.
    Health(HealthFrame<'a, S>),
    /// How the board is, in a version that is not read here.
    OtherHealth(u8),
    /// A host asks who the board is.
    HelloRequest,
    /// A host asks how the board is.
    HealthRequest,
}

/// The values of a frame.
#[derive(Clone, Copy, Debug)]
pub struct Report<'a, S: Schema> {
    /// When the board put it together, where the link has stamps.
    pub stamp: Option<Stamp>,
    items: &'a [u8],
    table: &'static Table,
    schema: PhantomData<S>,
}

impl<'a, S: Schema> Report<'a, S> {
    /// The messages, in the order of the frame.
    #[inline]
    #[must_use]
    pub fn messages(self) -> Messages<'a, S> {
        Messages(self)
    }
}

/// The messages of a report.
#[derive(Clone, Copy, Debug)]
pub struct Messages<'a, S: Schema>(Report<'a, S>);

impl<S: Schema> Iterator for Messages<'_, S> {
    type Item = S::Message;

    #[inline]
    fn next(&mut self) -> Option<S::Message> {
        let (&id, rest) = self.0.items.split_first()?;
        let (bytes, rest) = rest.split_at_checked(self.0.table.slots[usize::from(id)].bytes as usize)?;
        self.0.items = rest;
        S::read(id, bytes)
    }
}

/// What bytes can be.
enum Look {
    Invalid,
    Incomplete,
    /// A frame: where its payload starts, where its values end, and where it ends.
    Complete(usize, usize, usize),
}

/// Copies as many bytes as there is room for, and returns how many.
fn copy(bytes: &[u8], room: Option<&mut [u8]>) -> usize {
    let room = room.unwrap_or_default();
    let count = room.len().min(bytes.len());
    room.iter_mut().zip(bytes).for_each(|(place, byte)| *place = *byte);
    count
}

/// A decoder of a link: of what the board sends or, with `SENSORS` false, of what the host does.
#[derive(Clone, Debug)]
pub struct Decoder<S: Schema, const SENSORS: bool = true> {
    held: S::Held,
    length: usize,
    frames: u64,
    dropped_bytes: u64,
}

impl<S: Schema, const SENSORS: bool> Default for Decoder<S, SENSORS> {
    fn default() -> Self {
        Self::new()
    }
}

impl<S: Schema, const SENSORS: bool> Decoder<S, SENSORS> {
    const TABLE: &'static Table = if SENSORS { S::SENSORS } else { S::ACTUATORS };
    const CRC: usize = S::CHECKSUM.bytes();
    const HELLO: usize = if SENSORS { 5 } else { 1 };
    /// Bytes of a question for health; 0 for none.
    const REQUEST: usize = if SENSORS { 0 } else { 2 };
    const HEALTH: usize = if SENSORS { HEALTH_BYTES[0] + HEALTH_BYTES[1] * S::ITEMS.len() } else { 0 };
    const SHORT: usize = Self::TABLE.short_bytes;
    const LONGEST: usize = if Self::HEALTH > Self::SHORT { Self::HEALTH } else { Self::SHORT } + Self::CRC;
    const IS_STAMPED: bool = S::IS_STAMPED && SENSORS;

    /// A decoder that has seen nothing.
    #[must_use]
    pub const fn new() -> Self {
        Self { held: S::HELD, length: 0, frames: 0, dropped_bytes: 0 }
    }

    /// Frames so far.
    #[must_use]
    pub fn frames(&self) -> u64 {
        self.frames
    }

    /// Bytes so far that belong to no frame.
    #[must_use]
    pub fn dropped_bytes(&self) -> u64 {
        self.dropped_bytes
    }

    /// Takes the next bytes, and hands on each frame that ends in them.
    #[inline]
    pub fn feed(&mut self, bytes: &[u8], mut on_frame: impl FnMut(Found<'_, S>)) {
        let (held, counts) = (self.held.as_mut(), (&mut self.frames, &mut self.dropped_bytes));
        let mut rest = bytes;
        while self.length > 0 && !rest.is_empty() {
            let old = self.length;
            let count = copy(rest, held.get_mut(old..));
            let known = held.get(..old + count).unwrap_or_default();
            let at = Self::run(known, old, (counts.0, counts.1), &mut on_frame);
            if at >= old {
                self.length = 0;
                rest = rest.get(at - old..).unwrap_or_default();
            } else {
                held.copy_within(at..old + count, 0);
                self.length = old + count - at;
                rest = rest.get(count..).unwrap_or_default();
            }
        }
        if !rest.is_empty() {
            let at = Self::run(rest, rest.len(), counts, &mut on_frame);
            self.length = copy(rest.get(at..).unwrap_or_default(), Some(held));
        }
    }

    /// Looks for frames that start before `limit`. Returns where one starts that needs more bytes, or where to go on.
    #[inline]
    fn run(
        bytes: &[u8],
        limit: usize,
        (frames, dropped_bytes): (&mut u64, &mut u64),
        on_frame: &mut impl FnMut(Found<'_, S>),
    ) -> usize {
        let mut at = 0;
        while at < limit {
            let here = bytes.get(at..).unwrap_or_default();
            match Self::look(here) {
                Look::Incomplete => return at,
                Look::Complete(start, stop, end) => {
                    *frames += 1;
                    at += end;
                    on_frame(Self::read(here.get(start..stop).unwrap_or_default()));
                }
                Look::Invalid => {
                    let others = bytes.get(at + 1..limit).unwrap_or_default();
                    let skipped = others.iter().position(|byte| matches!(byte, b'1'..=b'9'));
                    let skipped = 1 + skipped.unwrap_or(others.len());
                    *dropped_bytes += skipped as u64;
                    at += skipped;
                }
            }
        }
        at
    }

    /// What the bytes from the first one on can be.
    #[inline]
    fn look(bytes: &[u8]) -> Look {
        let mut size = match bytes.first() {
            Some(digit @ b'1'..=b'9') => usize::from(digit - b'0'),
            Some(_) => return Look::Invalid,
            None => return Look::Incomplete,
        };
        let mut colon = 1;
        loop {
            if size > Self::LONGEST {
                return Look::Invalid;
            }
            match bytes.get(colon) {
                None => return Look::Incomplete,
                Some(b':') => break,
                Some(digit @ b'0'..=b'9') => size = size * 10 + usize::from(digit - b'0'),
                Some(_) => return Look::Invalid,
            }
            colon += 1;
        }
        if size <= Self::CRC || (size - Self::CRC > Self::SHORT && size - Self::CRC != Self::HEALTH) {
            return Look::Invalid;
        }
        let (start, comma) = (colon + 1, colon + 1 + size);
        let stop = comma - Self::CRC;
        // The cheapest checks first: most bytes that only look like a frame do not end with a comma.
        if bytes.get(comma).is_some_and(|byte| *byte != b',')
            || (Self::CRC > 0 && bytes.get(stop).is_some_and(|byte| *byte != CHECKSUM))
        {
            return Look::Invalid;
        }
        let payload = bytes.get(start..comma.min(bytes.len())).unwrap_or_default();
        let values = payload.get(..stop - start);
        if !Self::walk(values.unwrap_or(payload), stop - start) {
            return Look::Invalid;
        }
        if payload.len() == size {
            let (values, behind) = payload.split_at(stop - start);
            if !S::CHECKSUM.agrees(values, behind) {
                return Look::Invalid;
            }
        }
        if comma < bytes.len() { Look::Complete(start, stop, comma + 1) } else { Look::Incomplete }
    }

    /// Whether the first bytes of a payload are those of one with `size` bytes, as far as they are there.
    #[inline]
    fn walk(bytes: &[u8], size: usize) -> bool {
        let mut at = match bytes.first() {
            None => return true,
            Some(&HELLO) if size == Self::HELLO => return true,
            Some(&HELLO) if size == Self::REQUEST => return bytes.get(1).is_none_or(|byte| *byte == 1),
            Some(&HELLO) if Self::IS_STAMPED && size > STAMP_BYTES && size <= Self::SHORT => STAMP_BYTES,
            Some(&HEALTH) => return size == Self::HEALTH,
            Some(_) if !Self::IS_STAMPED && size <= Self::SHORT => 0,
            Some(_) => return false,
        };
        let mut seen = [0_u64; 4];
        while let Some(&id) = bytes.get(at) {
            let slot = &Self::TABLE.slots[usize::from(id)];
            let (value, bit) = (slot.bytes as usize, 1 << (id % 64));
            let word = &mut seen[usize::from(id / 64)];
            let next = at + 1 + value;
            if value == 0 || *word & bit != 0 || next > size {
                return false;
            }
            *word |= bit;
            if slot.is_bool {
                let flags = bytes.get(at + 1..next.min(bytes.len())).unwrap_or_default();
                if flags.iter().any(|byte| *byte > 1) {
                    return false;
                }
            }
            at = next;
        }
        true
    }

    /// Reads a payload that is valid to its last byte.
    #[inline]
    fn read(payload: &[u8]) -> Found<'_, S> {
        let report = |stamp, items| {
            Found::Report(Report { stamp, items, table: Self::TABLE, schema: PhantomData })
        };
        match payload {
            [HELLO] => Found::HelloRequest,
            [HELLO, _] => Found::HealthRequest,
            &[HELLO, a, b, c, d] => Found::Hello(u32::from_be_bytes([a, b, c, d])),
            [HELLO, a, b, c, d, counter, items @ ..] => {
                let time_us = u32::from_be_bytes([*a, *b, *c, *d]);
                report(Some(Stamp { time_us, counter: *counter }), items)
            }
            [HEALTH, HEALTH_VERSION, bytes @ ..] => Found::Health(HealthFrame::new(bytes)),
            [HEALTH, version, ..] => Found::OtherHealth(*version),
            items => report(None, items),
        }
    }
}
