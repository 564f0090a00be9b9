//! The latest value of every item, and which of them must still be reported to the host.
//!
//! An item becomes due each time it is read, and is reported once; so a payload contains exactly
//! what is due, in the order of the schema, and never a zero that nobody measured. If several tasks
//! share a store, the caller locks it.

use core::ops::Range;

use core::ops::{Deref, DerefMut};

use crate::bits::Bits;
use crate::bytes::{Writer, copy};
use crate::filter::Filter;
use crate::health::Health;
use crate::outcome::Outcome;
use crate::schema::{Direction, Item, Schema};

/// The values of a schema, in `[u8; SCHEMA.values_bytes()]`.
#[derive(Debug)]
pub struct Store<V: ?Sized = [u8]> {
    schema: &'static Schema,
    due: Bits,
    known: Bits,
    values: V,
}

impl<const BYTES: usize> Store<[u8; BYTES]> {
    /// A store without values. `BYTES` is [`Schema::values_bytes`]; a value that has no room is
    /// never stored.
    #[must_use]
    pub const fn new(schema: &'static Schema) -> Self {
        Self { schema, due: Bits::NONE, known: Bits::NONE, values: [0; BYTES] }
    }
}

impl<const BYTES: usize> Deref for Store<[u8; BYTES]> {
    type Target = Store;

    fn deref(&self) -> &Store {
        self
    }
}

impl<const BYTES: usize> DerefMut for Store<[u8; BYTES]> {
    fn deref_mut(&mut self) -> &mut Store {
        self
    }
}

impl Store {
    /// The schema of the values.
    #[must_use]
    pub fn schema(&self) -> &'static Schema {
        self.schema
    }

    /// Stores the value of an item; that of a sensor is then due.
    pub fn put(&mut self, index: usize, value: &[u8]) {
        let Some((at, item)) = self.schema.place(index) else { return };
        let wanted = value.get(..item.bytes());
        let room = self.values.get_mut(at..at.wrapping_add(item.bytes()));
        if let (Some(room), Some(value)) = (room, wanted) {
            copy(room, value);
            self.known.set(index);
            if item.direction == Direction::ToHost {
                self.due.set(index);
            }
        }
    }

    /// The value of an item; `None` until it was first read.
    #[must_use]
    pub fn get(&self, index: usize) -> Option<&[u8]> {
        let (at, item) = self.schema.place(index).filter(|_| self.known.has(index))?;
        self.values.get(at..at.wrapping_add(item.bytes()))
    }

    /// Takes the outcome of a reading: puts a fresh value through the filter, if there is one,
    /// stores what must be reported, which is then due, and notes the health of the device.
    #[inline]
    pub fn record(
        &mut self,
        health: &mut Health,
        filter: Option<&mut Filter>,
        index: usize,
        outcome: Outcome,
        value: &mut [u8],
        now_ms: u32,
    ) {
        match filter {
            Some(filter) => self.record_after_filter(health, filter, index, outcome, value, now_ms),
            None => self.record_plain(health, index, outcome, value, now_ms),
        }
    }

    /// The outcome of filtering a reading, for [`Self::record_filtered`]: a caller that must not hold the
    /// store for that long filters first.
    pub fn filtered(
        schema: &Schema,
        filter: &mut Filter,
        index: usize,
        outcome: Outcome,
        value: &mut [u8],
        now_ms: u32,
    ) -> Outcome {
        match schema.items.get(index) {
            Some(item) if outcome == Outcome::Fresh => filter.apply(item, now_ms, value),
            Some(_) | None => outcome,
        }
    }

    /// Takes the outcome of a reading, and the outcome after its filter.
    pub fn record_filtered(
        &mut self,
        health: &mut Health,
        index: usize,
        (outcome, reported): (Outcome, Outcome),
        value: &[u8],
        now_ms: u32,
    ) {
        if reported == Outcome::Nothing {
            // The device answered; the filter withholds the value from the host.
            health.note(index, outcome, now_ms);
        } else {
            self.record_plain(health, index, reported, value, now_ms);
        }
    }

    /// Like [`Self::record`] without a filter: a program that only calls this links no filter code.
    pub fn record_plain(
        &mut self,
        health: &mut Health,
        index: usize,
        outcome: Outcome,
        value: &[u8],
        now_ms: u32,
    ) {
        if outcome == Outcome::Fresh {
            self.put(index, value);
        }
        health.note(index, outcome, now_ms);
    }

    fn record_after_filter(
        &mut self,
        health: &mut Health,
        filter: &mut Filter,
        index: usize,
        outcome: Outcome,
        value: &mut [u8],
        now_ms: u32,
    ) {
        let reported = Self::filtered(self.schema, filter, index, outcome, value, now_ms);
        self.record_filtered(health, index, (outcome, reported), value, now_ms);
    }

    /// The items that are due.
    pub(crate) const fn due(&self) -> &Bits {
        &self.due
    }

    /// Whether anything is due.
    #[must_use]
    pub fn is_due(&self) -> bool {
        !self.due.is_empty()
    }

    /// Whether an item is due.
    #[must_use]
    pub fn has_due(&self, index: usize) -> bool {
        self.due.has(index)
    }

    /// Makes an item no longer due.
    pub fn forget(&mut self, index: usize) {
        self.due.clear(index);
    }

    /// Writes the identifier and the value of an item, which is at `place` in the memory, and makes
    /// it no longer due.
    pub(crate) fn hand_out(
        &mut self,
        (index, item, place): (usize, &Item, Range<usize>),
        out: &mut Writer<'_>,
    ) {
        if let Some(value) = self.values.get(place) {
            self.due.clear(index);
            out.put(&[item.id]);
            out.put(value);
        }
    }

    /// Makes items due again after their frame could not be sent.
    pub fn restore(&mut self, taken: &Bits) {
        self.due.add(taken);
    }
}
