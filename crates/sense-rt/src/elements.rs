//! When to report an array whose elements are measured one by one.
//!
//! It is first reported when every element has been measured. After that it is reported with the
//! first new element, or only when all are new, so that the distance from a ranger that no longer
//! answers does not look current.

use crate::bits::Bits;

/// Which elements of an array have a value, for arrays of up to 256 elements.
#[derive(Clone, Copy, Debug, Default)]
pub struct Elements {
    measured: Bits,
    fresh: Bits,
}

impl Elements {
    /// The state at the start.
    pub const NEW: Self = Self { measured: Bits::NONE, fresh: Bits::NONE };

    /// Notes that element `index` has a new value.
    pub fn note(&mut self, index: usize) {
        self.measured.set(index);
        self.fresh.set(index);
    }

    /// True if the array of `count` elements must be reported; its elements then no longer count as
    /// new. `is_complete`: only when all are new.
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
