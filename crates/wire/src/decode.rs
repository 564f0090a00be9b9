//! Bytes to values: any split of the stream, any garbage between frames.
//!
//! The decoder keeps the bytes from the first possible frame start on. What cannot become a valid
//! frame of the schema loses its first byte only, and the rest is looked at again; so a torn frame
//! costs itself and never the whole frame behind it.

use alloc::vec::Vec;

use crate::checksum::crc16_ccitt_false;
use crate::scalar::Scalar;
use crate::schema::{Checksum, Direction, ID_CHECKSUM, ID_HELLO, Schema};

/// What a frame said.
#[derive(Clone, Debug, PartialEq)]
pub enum Event {
    /// Values in the order of the payload.
    Report(Vec<(u8, Vec<Scalar>)>),
    /// The board's schema hash (board to host).
    Hello(u32),
    /// The host wants a hello (host to board).
    HelloRequest,
}

/// Decoder of one direction of one link.
#[derive(Clone, Debug)]
pub struct Decoder<'a> {
    schema: &'a Schema,
    direction: Direction,
    payload_bytes_max: usize,
    buffer: Vec<u8>,
    frames: u64,
    dropped_bytes: u64,
}

/// What the bytes at hand can be.
enum Prefix {
    /// No valid frame starts here.
    Invalid,
    /// A valid frame may start here; more bytes will tell.
    Incomplete,
    /// A valid frame of that many bytes.
    Complete(Event, usize),
}

impl<'a> Decoder<'a> {
    /// A decoder for what travels in `direction`.
    #[must_use]
    pub fn new(schema: &'a Schema, direction: Direction) -> Self {
        let payload_bytes_max = schema.payload_bytes_max(direction);
        Self {
            schema,
            direction,
            payload_bytes_max,
            buffer: Vec::new(),
            frames: 0,
            dropped_bytes: 0,
        }
    }

    /// Takes the next bytes of the stream and hands each whole frame to `on_event`.
    pub fn feed(&mut self, bytes: &[u8], mut on_event: impl FnMut(Event)) {
        for &byte in bytes {
            self.buffer.push(byte);
            self.drain(&mut on_event);
        }
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

    fn drain(&mut self, on_event: &mut impl FnMut(Event)) {
        while !self.buffer.is_empty() {
            match self.classify() {
                Prefix::Incomplete => return,
                Prefix::Invalid => {
                    self.buffer.drain(..1);
                    self.dropped_bytes += 1;
                }
                Prefix::Complete(event, frame_bytes) => {
                    self.buffer.drain(..frame_bytes);
                    self.frames += 1;
                    on_event(event);
                }
            }
        }
    }

    fn classify(&self) -> Prefix {
        let mut payload_bytes = 0_usize;
        for (index, &byte) in self.buffer.iter().enumerate() {
            match byte {
                b'0' if index == 0 => return Prefix::Invalid,
                b'0'..=b'9' => payload_bytes = payload_bytes * 10 + usize::from(byte - b'0'),
                b':' if index > 0 => return self.classify_payload(index + 1, payload_bytes),
                _ => return Prefix::Invalid,
            }
            if payload_bytes > self.payload_bytes_max {
                return Prefix::Invalid;
            }
        }
        Prefix::Incomplete
    }

    fn classify_payload(&self, start: usize, payload_bytes: usize) -> Prefix {
        let rest = self.buffer.get(start..).unwrap_or_default();
        let payload = rest.get(..payload_bytes.min(rest.len())).unwrap_or_default();
        let Some(event) = self.parse(payload, payload_bytes) else { return Prefix::Invalid };
        match (event, rest.get(payload_bytes)) {
            (Some(event), Some(b',')) => Prefix::Complete(event, start + payload_bytes + 1),
            (Some(_), Some(_)) => Prefix::Invalid,
            (Some(_), None) | (None, _) => Prefix::Incomplete,
        }
    }

    /// Reads the part of a payload that is there. The outer option is none when it can never
    /// become valid, the inner one when bytes are still missing.
    #[expect(
        clippy::option_option,
        reason = "invalid, incomplete and complete in one small helper"
    )]
    fn parse(&self, payload: &[u8], payload_bytes: usize) -> Option<Option<Event>> {
        let checksum_bytes = self.schema.checksum.size_bytes();
        let values_bytes = payload_bytes.checked_sub(checksum_bytes)?;
        if values_bytes == 0 {
            return None;
        }
        let (values, checksum) = payload.split_at(values_bytes.min(payload.len()));
        let event = self.parse_values(values, values_bytes)?;
        if !self.checksum_may_be(values, checksum) {
            return None;
        }
        Some(if payload.len() == payload_bytes { event } else { None })
    }

    fn checksum_may_be(&self, values: &[u8], checksum: &[u8]) -> bool {
        match (self.schema.checksum, checksum) {
            (_, []) => true,
            (Checksum::None, _) => false,
            (Checksum::Crc16, [id]) | (Checksum::Crc16, [id, _]) => *id == ID_CHECKSUM,
            (Checksum::Crc16, [id, crc @ ..]) => {
                *id == ID_CHECKSUM && *crc == crc16_ccitt_false(values).to_be_bytes()
            }
        }
    }

    #[expect(clippy::option_option, reason = "see parse")]
    fn parse_values(&self, values: &[u8], values_bytes: usize) -> Option<Option<Event>> {
        if values.first() == Some(&ID_HELLO) {
            return self.parse_hello(values, values_bytes);
        }
        let mut report: Vec<(u8, Vec<Scalar>)> = Vec::new();
        let mut at = 0;
        while let Some(&id) = values.get(at) {
            let item = self.schema.item(self.direction, id)?;
            let size_bytes = item.value.size_bytes();
            if report.iter().any(|(seen, _)| *seen == id) || at + 1 + size_bytes > values_bytes {
                return None;
            }
            let bytes = values.get(at + 1..).unwrap_or_default();
            let mut scalars = Vec::with_capacity(item.value.count());
            for element in bytes
                .get(..size_bytes.min(bytes.len()))
                .unwrap_or_default()
                .chunks_exact(item.value.scalar.size_bytes())
            {
                scalars.push(item.value.scalar.read(element)?);
            }
            report.push((id, scalars));
            at += 1 + size_bytes;
        }
        Some((at == values_bytes && values.len() == values_bytes).then_some(Event::Report(report)))
    }

    #[expect(clippy::option_option, reason = "see parse")]
    fn parse_hello(&self, values: &[u8], values_bytes: usize) -> Option<Option<Event>> {
        match (self.direction, values_bytes, values) {
            (Direction::Actuator, 1, [_]) => Some(Some(Event::HelloRequest)),
            (Direction::Sensor, 5, [_, a, b, c, d]) => {
                Some(Some(Event::Hello(u32::from_be_bytes([*a, *b, *c, *d]))))
            }
            (Direction::Sensor, 5, _) => Some(None),
            (Direction::Sensor | Direction::Actuator, _, _) => None,
        }
    }
}
