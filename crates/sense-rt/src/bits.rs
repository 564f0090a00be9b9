//! A bit for each of 256 items or identifiers.

/// A set of numbers below 256.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Bits([u32; 8]);

impl Bits {
    /// The empty set.
    pub const NONE: Self = Self([0; 8]);

    /// Whether `index` is in the set.
    #[must_use]
    pub fn has(&self, index: usize) -> bool {
        self.0.get(index / 32).is_some_and(|word| word >> (index % 32) & 1 != 0)
    }

    /// Adds `index`. Numbers from 256 on are ignored.
    pub fn set(&mut self, index: usize) {
        if let Some(word) = self.0.get_mut(index / 32) {
            *word |= 1 << (index % 32);
        }
    }

    /// Removes `index`.
    pub fn clear(&mut self, index: usize) {
        if let Some(word) = self.0.get_mut(index / 32) {
            *word &= !(1 << (index % 32));
        }
    }

    /// Adds all of `others`.
    pub fn add(&mut self, others: &Self) {
        for (word, other) in self.0.iter_mut().zip(&others.0) {
            *word |= other;
        }
    }

    /// Whether the set is empty.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.0.iter().all(|word| *word == 0)
    }
}
