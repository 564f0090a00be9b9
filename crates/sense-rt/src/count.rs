//! Counts: what a hardware counter of 16 bits has counted in all, and when an unchanged count is
//! told again.
//!
//! A count wraps in its type, as a counter does, so that the difference of two values is right
//! whatever lies between.

use crate::convert::store_signed;
use crate::scalar::Scalar;

/// The total of a hardware counter of 16 bits, which is 0 at the start as well.
#[derive(Clone, Copy, Debug, Default)]
pub struct Counter {
    total: i32,
    last: u16,
}

impl Counter {
    /// At the start.
    pub const NEW: Self = Self { total: 0, last: 0 };

    /// The hardware counter was read. Between two calls it moves by at most 32767 up or 32768 down;
    /// else a wrap is lost.
    pub fn step(&mut self, now: u16) {
        let moved = now.wrapping_sub(self.last).cast_signed();
        self.total = self.total.wrapping_add(i32::from(moved));
        self.last = now;
    }

    /// Counts since the start; backwards is negative.
    #[must_use]
    pub const fn total(&self) -> i32 {
        self.total
    }
}

/// Stores a count as one element: integers get its low bits, so that it wraps; bool is "not zero".
pub fn store_count(scalar: Scalar, count: i64, element: &mut [u8]) {
    match scalar {
        Scalar::Bool | Scalar::Float32 | Scalar::Float64 => store_signed(scalar, count, element),
        Scalar::Uint8
        | Scalar::Int8
        | Scalar::Uint16
        | Scalar::Int16
        | Scalar::Uint32
        | Scalar::Int32
        | Scalar::Uint64
        | Scalar::Int64 => scalar.store(count.cast_unsigned(), element),
    }
}

/// When a value that does not change is told again.
#[derive(Clone, Copy, Debug, Default)]
pub struct Repeat {
    told_ms: u32,
    has_told: bool,
}

impl Repeat {
    /// At the start.
    pub const NEW: Self = Self { told_ms: 0, has_told: false };

    /// True when a value is to be told: it has changed, was never told, or not for `repeat_ms`.
    pub fn is_due(&mut self, has_changed: bool, repeat_ms: u32, now_ms: u32) -> bool {
        if self.has_told && !has_changed && now_ms.wrapping_sub(self.told_ms) < repeat_ms {
            return false;
        }
        *self = Self { told_ms: now_ms, has_told: true };
        true
    }
}
