//! The contents of a decoded frame, read in place: the bytes stay where they were received.

use alloc::vec::Vec;

use crate::decode::Table;
use crate::health::{Health, HealthFrame};
use crate::scalar::Scalar;
use crate::schema::{Item, Schema};

/// When a report was assembled, and its number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stamp {
    /// Microseconds since the board started; wraps.
    pub time_us: u32,
    /// Counts assembled reports; wraps. A gap means that reports were lost.
    pub counter: u8,
}

/// The contents of a frame, with its values in place in the stream.
#[derive(Clone, Copy, Debug)]
pub enum Frame<'a> {
    /// Values.
    Report(Report<'a>),
    /// The board's schema hash (board to host).
    Hello(u32),
    /// The state of the board and its devices (board to host).
    Health(HealthFrame<'a>),
    /// Health of another version, about which nothing else is known (board to host).
    OtherHealth(u8),
    /// The host requests a hello (host to board).
    HelloRequest,
    /// The host requests health (host to board).
    HealthRequest,
}

/// The contents of a frame, with its own copy of the values.
#[derive(Clone, Debug, PartialEq)]
pub enum Event {
    /// Values in the order of the payload, and the stamp if the link has one.
    Report(Option<Stamp>, Vec<(u8, Vec<Scalar>)>),
    /// The board's schema hash (board to host).
    Hello(u32),
    /// The state of the board and its devices (board to host).
    Health(Health),
    /// Health of another version, about which nothing else is known (board to host).
    OtherHealth(u8),
    /// The host requests a hello (host to board).
    HelloRequest,
    /// The host requests health (host to board).
    HealthRequest,
}

impl From<Frame<'_>> for Event {
    fn from(frame: Frame<'_>) -> Self {
        match frame {
            Frame::Report(report) => Self::Report(
                report.stamp(),
                report.values().map(|value| (value.item.id, value.scalars().collect())).collect(),
            ),
            Frame::Hello(hash) => Self::Hello(hash),
            Frame::Health(health) => Self::Health(health.read()),
            Frame::OtherHealth(version) => Self::OtherHealth(version),
            Frame::HelloRequest => Self::HelloRequest,
            Frame::HealthRequest => Self::HealthRequest,
        }
    }
}

/// The values of a frame; the decoder has checked all of them.
#[derive(Clone, Copy)]
pub struct Report<'a> {
    pub(crate) schema: &'a Schema,
    pub(crate) table: &'a Table,
    pub(crate) stamp: Option<Stamp>,
    pub(crate) items: &'a [u8],
}

impl core::fmt::Debug for Report<'_> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_list().entries(self.values()).finish()
    }
}

impl<'a> Report<'a> {
    /// When the board assembled it; present if the link has stamps.
    #[must_use]
    pub fn stamp(self) -> Option<Stamp> {
        self.stamp
    }

    /// The values, in the order of the payload.
    #[must_use]
    pub fn values(self) -> Values<'a> {
        Values { report: self }
    }
}

/// The values of a report, one by one.
#[derive(Clone, Debug)]
pub struct Values<'a> {
    report: Report<'a>,
}

impl<'a> Iterator for Values<'a> {
    type Item = Value<'a>;

    #[inline]
    fn next(&mut self) -> Option<Value<'a>> {
        let (&id, rest) = self.report.items.split_first()?;
        let slot = self.report.table.slot(id);
        let (bytes, rest) = rest.split_at_checked(slot.value_bytes())?;
        self.report.items = rest;
        Some(Value { item: self.report.schema.items.get(slot.index())?, bytes })
    }
}

/// A value of a report.
#[derive(Clone, Copy, Debug)]
pub struct Value<'a> {
    /// The item that it is a value of.
    pub item: &'a Item,
    /// Its bytes as received, most significant first.
    pub bytes: &'a [u8],
}

impl<'a> Value<'a> {
    /// Its elements; a plain scalar has one element.
    pub fn scalars(self) -> impl Iterator<Item = Scalar> + use<'a> {
        let scalar = self.item.value.scalar;
        self.bytes.chunks_exact(scalar.size_bytes()).filter_map(move |bytes| scalar.read(bytes))
    }
}
