//! The items of one direction, by identifier, so that a look-up is a single load.

use alloc::boxed::Box;

use crate::scalar::ScalarType;
use crate::schema::{Direction, Schema};

/// The facts that a decoder needs about an identifier.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Slot {
    /// Bytes of the value; 0 for an identifier that does not travel in this direction.
    value_bytes: u32,
    is_bool: bool,
    /// Index in the schema's list; identifiers are unique, so there are at most 254.
    index: u8,
}

impl Slot {
    #[inline]
    pub(crate) fn value_bytes(self) -> usize {
        self.value_bytes as usize
    }

    #[inline]
    pub(crate) fn is_bool(self) -> bool {
        self.is_bool
    }

    #[inline]
    pub(crate) fn index(self) -> usize {
        usize::from(self.index)
    }
}

/// A slot for each identifier.
#[derive(Clone, Debug)]
pub(crate) struct Table(Box<[Slot; 256]>);

impl Table {
    pub(crate) fn new(schema: &Schema, direction: Direction) -> Self {
        let mut slots = Box::new([Slot::default(); 256]);
        for (index, item) in schema.items.iter().enumerate().rev() {
            if item.direction != direction {
                continue;
            }
            let (Ok(index), Ok(value_bytes), Some(slot)) = (
                u8::try_from(index),
                u32::try_from(item.value.size_bytes()),
                slots.get_mut(usize::from(item.id)),
            ) else {
                continue;
            };
            *slot = Slot { value_bytes, is_bool: item.value.scalar == ScalarType::Bool, index };
        }
        Self(slots)
    }

    #[inline]
    pub(crate) fn slot(&self, id: u8) -> Slot {
        // A byte is always below 256, so the compiler drops the bounds check.
        self.0.get(usize::from(id)).copied().unwrap_or_default()
    }
}
