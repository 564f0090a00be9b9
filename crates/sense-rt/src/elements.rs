//! When an array is told whose elements are measured one by one.
//!
//! It is told once each element has been measured, and then with the first new one, or only when all
//! are new: so that a distance of a ranger that answers no more does not look like one of now.

use crate::bits::Bits;

/// Which elements of an array have a value. Arrays of up to 256 elements can be measured so.
#[derive(Clone, Copy, Debug, Default)]
pub struct Elements {
    measured: Bits,
    fresh: Bits,
}

impl Elements {
    /// At the start.
    pub const NEW: Self = Self { measured: Bits::NONE, fresh: Bits::NONE };

    /// Element `index` has a new value.
    pub fn note(&mut self, index: usize) {
        self.measured.set(index);
        self.fresh.set(index);
    }

    /// True when the array of `count` elements is to be told; what was new is then old.
    /// `is_complete`: only when all are new.
    pub fn are_due(&mut self, count: usize, is_complete: bool) -> bool {
        let measured = (0..count).all(|index| self.measured.has(index));
        let fresh = (0..count).filter(|index| self.fresh.has(*index)).count();
        if !measured || fresh == 0 || (is_complete && fresh < count) {
            return false;
        }
        self.fresh = Bits::NONE;
        true
    }
}
