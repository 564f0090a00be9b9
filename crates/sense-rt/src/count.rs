//! Counts: the total of a 16-bit hardware counter, when an unchanged count is reported again, and
//! which of many values is taken.
//!
//! A count wraps in its type, as a counter does, so that the difference of two values is right even
//! across a wrap.

use crate::convert::store_signed;
use crate::scalar::Scalar;

/// The total of a 16-bit hardware counter, which must also start at 0.
#[derive(Clone, Copy, Debug, Default)]
pub struct Counter {
    total: i32,
    last: u16,
}

impl Counter {
    /// The state at the start.
    pub const NEW: Self = Self { total: 0, last: 0 };

    /// The hardware counter was read. Between two calls it may move by at most 32767 up or 32768
    /// down; otherwise a wrap is lost.
    pub fn step(&mut self, now: u16) {
        let moved = now.wrapping_sub(self.last).cast_signed();
        self.total = self.total.wrapping_add(i32::from(moved));
        self.last = now;
    }

    /// The counts since the start; negative if backwards.
    #[must_use]
    pub const fn total(&self) -> i32 {
        self.total
    }
}

/// Stores a count as one element: integers get its low bits, so that they wrap; bool is "not zero".
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

/// When an unchanged value is reported again.
#[derive(Clone, Copy, Debug, Default)]
pub struct Repeat {
    reported_ms: u32,
    has_reported: bool,
}

impl Repeat {
    /// The state at the start.
    pub const NEW: Self = Self { reported_ms: 0, has_reported: false };

    /// True if a value must be reported: it has changed, or was never reported, or not for
    /// `repeat_ms`.
    pub fn is_due(&mut self, has_changed: bool, repeat_ms: u32, now_ms: u32) -> bool {
        if self.has_reported && !has_changed && now_ms.wrapping_sub(self.reported_ms) < repeat_ms {
            return false;
        }
        *self = Self { reported_ms: now_ms, has_reported: true };
        true
    }
}

/// Which of the values that others send by their own clocks is taken: one in each cycle, on average.
#[derive(Clone, Copy, Debug, Default)]
pub struct Turn {
    /// The turn of the last value that was taken.
    last_ms: Option<u32>,
}

impl Turn {
    /// The state at the start.
    pub const NEW: Self = Self { last_ms: None };

    /// True if a value that comes now is taken. Turns are a cycle apart, and one that comes up to a
    /// quarter of a cycle early has its turn: otherwise every second one of a sender that is as fast as the cycle would be left out.
    pub fn is_next(&mut self, cycle_ms: u32, now_ms: u32) -> bool {
        let since_ms = |last_ms: u32| now_ms.wrapping_add(cycle_ms / 4).wrapping_sub(last_ms);
        let turn_ms = match self.last_ms {
            Some(last_ms) if since_ms(last_ms) < cycle_ms => return false,
            Some(last_ms) if since_ms(last_ms) - cycle_ms < cycle_ms => {
                last_ms.wrapping_add(cycle_ms)
            }
            Some(_) | None => now_ms,
        };
        self.last_ms = Some(turn_ms);
        true
    }
}
