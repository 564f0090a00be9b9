//! The latest value of every item, and which of them a report owes the host.
//!
//! An item becomes due each time it is read, and is reported once; so a payload holds whatever is
//! due, in the order of the schema, and never a zero that nobody measured. Where several tasks share
//! a store the caller locks it.

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
    /// Nothing is known. `BYTES` is [`Schema::values_bytes`]; what has no room is never stored.
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
    /// What it has values of.
    #[must_use]
    pub fn schema(&self) -> &'static Schema {
        self.schema
    }

    /// Takes over the value of an item; that of a sensor is then due.
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

    /// The value of an item; none while nothing was read.
    #[must_use]
    pub fn get(&self, index: usize) -> Option<&[u8]> {
        let (at, item) = self.schema.place(index).filter(|_| self.known.has(index))?;
        self.values.get(at..at.wrapping_add(item.bytes()))
    }

    /// What a reading came to: puts a fresh value through the filter, if there is one, keeps what is
    /// to be reported, which is then due, and notes how the device is.
    #[inline]
    pub fn tell(
        &mut self,
        health: &mut Health,
        filter: Option<&mut Filter>,
        index: usize,
        outcome: Outcome,
        value: &mut [u8],
        now_ms: u32,
    ) {
        match filter {
            Some(filter) => self.tell_filtered(health, filter, index, outcome, value, now_ms),
            None => self.tell_plain(health, index, outcome, value, now_ms),
        }
    }

    /// What a filter makes of a reading, for who must not hold the store for so long; [`Self::tell_told`] takes it.
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

    /// A reading that came to `outcome`, and what its filter has made of it.
    pub fn tell_told(
        &mut self,
        health: &mut Health,
        index: usize,
        (outcome, told): (Outcome, Outcome),
        value: &[u8],
        now_ms: u32,
    ) {
        if told == Outcome::Nothing {
            // The device answered; the filter keeps the value from the host.
            health.note(index, outcome, now_ms);
        } else {
            self.tell_plain(health, index, told, value, now_ms);
        }
    }

    /// The same without a filter: who has none anywhere calls this, and nothing of filters is linked.
    pub fn tell_plain(
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

    fn tell_filtered(
        &mut self,
        health: &mut Health,
        filter: &mut Filter,
        index: usize,
        outcome: Outcome,
        value: &mut [u8],
        now_ms: u32,
    ) {
        let told = Self::filtered(self.schema, filter, index, outcome, value, now_ms);
        self.tell_told(health, index, (outcome, told), value, now_ms);
    }

    /// Whether anything is due.
    #[must_use]
    pub fn is_due(&self) -> bool {
        !self.due.is_empty()
    }

    /// Whether an item is.
    #[must_use]
    pub fn has_due(&self, index: usize) -> bool {
        self.due.has(index)
    }

    /// The value of an item is not to be reported.
    pub fn forget(&mut self, index: usize) {
        self.due.clear(index);
    }

    /// Puts the value of an item, which is at `at` in the memory, behind its identifier where it is due, and takes it off
    /// the list; `taken` says that it was.
    pub(crate) fn hand_out(
        &mut self,
        (index, item, at): (usize, &Item, usize),
        out: &mut Writer<'_>,
        taken: &mut Bits,
    ) {
        let value = self.values.get(at..at.wrapping_add(item.bytes()));
        if let Some(value) = value.filter(|_| self.due.has(index)) {
            self.due.clear(index);
            taken.set(index);
            out.put(&[item.id]);
            out.put(value);
        }
    }

    /// Makes the items of a frame due again that could not be sent.
    pub fn restore(&mut self, taken: &Bits) {
        self.due.add(taken);
    }
}
