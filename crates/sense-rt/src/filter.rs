//! Filtering of a value on the board before it is reported: invalid, median, smooth, change with
//! heartbeat; in this order, each only if the table asks for it.
//!
//! Integers of all sizes are handled without losing a bit. Arrays are filtered element by element,
//! but an invalid element makes the whole value invalid, because half a value cannot be reported.

mod real;
mod smooth;

use core::ops::{Deref, DerefMut};

use crate::bytes::{copy, part, split};
use crate::outcome::Outcome;
use crate::scalar::Scalar;
use crate::schema::Item;
use crate::uses;

pub use real::{WIDE, Wide};
pub use smooth::decay;

/// Bytes of the state of one smoothed element.
const SMOOTH_BYTES: usize = 16;

/// A number of an item's type, as its bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Number(u64);

impl Number {
    /// A bool or an unsigned integer; also a distance between any integers.
    #[must_use]
    pub const fn unsigned(number: u64) -> Self {
        Self(number)
    }

    /// A signed integer.
    #[must_use]
    pub const fn signed(number: i64) -> Self {
        Self(number.cast_unsigned())
    }

    /// A float32.
    #[must_use]
    pub const fn float32(number: f32) -> Self {
        Self(number.to_bits() as u64)
    }

    /// A float64.
    #[must_use]
    pub const fn float64(number: f64) -> Self {
        Self(number.to_bits())
    }

    /// The bits as an element has them.
    fn bits(self, scalar: Scalar) -> u64 {
        self.0 & (scalar.sign().wrapping_mul(2).wrapping_sub(1))
    }
}

/// A range that includes both ends; for a single value they are equal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Range {
    /// The lowest number.
    pub low: Number,
    /// The highest number.
    pub high: Number,
}

/// The configuration of a filter.
#[derive(Clone, Copy, Debug)]
pub struct FilterTable {
    /// The ranges of raw elements that are not a measurement.
    pub invalid: &'static [Range],
    /// [`WIDE`] for a float64 with `smooth_ms` or `change`, otherwise `None`; without it these two
    /// do nothing to a float64.
    pub wide: Option<Wide>,
    /// The number of values that the median is taken of: odd, 3 to 15; 0: off. At first it is taken
    /// of those received so far.
    pub median: u8,
    /// Time constant of a first-order low-pass; 0: off.
    pub smooth_ms: u32,
    /// How far an element must be from the last one reported; `None`: all are reported. Not
    /// negative.
    pub change: Option<Number>,
    /// With `change`: the longest time between reports while values come; 0: unlimited.
    pub heartbeat_ms: u32,
}

impl FilterTable {
    /// Everything is reported as it is.
    pub const NEW: Self =
        Self { invalid: &[], wide: None, median: 0, smooth_ms: 0, change: None, heartbeat_ms: 0 };

    /// The size of the memory of an item's [`Filter`].
    #[must_use]
    pub const fn bytes(&self, item: &Item) -> usize {
        let reported = if self.change.is_some() { item.bytes() } else { 0 };
        self.smooth_bytes(item) + reported + self.median as usize * item.bytes()
    }

    const fn smooth_bytes(&self, item: &Item) -> usize {
        if self.smooth_ms > 0 { SMOOTH_BYTES * item.count as usize } else { 0 }
    }

    fn is_invalid(&self, item: &Item, value: &[u8]) -> bool {
        let scalar = item.scalar;
        (0..usize::from(item.count)).any(|index| {
            let key = key_of(scalar, scalar.load_at(value, index));
            let range_has = |range: &Range| {
                let low = key_of(scalar, range.low.bits(scalar));
                key >= low && key <= key_of(scalar, range.high.bits(scalar))
            };
            self.invalid.iter().any(range_has)
        })
    }

    fn is_far(&self, distance: Number, scalar: Scalar, from: u64, to: u64) -> bool {
        if uses::REALS && scalar == Scalar::Float32 {
            real::is_far(from, to, distance.0)
        } else if uses::REALS && scalar == Scalar::Float64 {
            self.wide.is_none_or(|wide| (wide.is_far)(from, to, distance.0))
        } else {
            key_of(scalar, from).abs_diff(key_of(scalar, to)) >= distance.0
        }
    }
}

/// A filter, with its memory in `[u8; TABLE.bytes(&ITEM)]`.
#[derive(Debug)]
pub struct Filter<M: ?Sized = [u8]> {
    table: &'static FilterTable,
    /// When the last valid value came.
    seen_ms: Option<u32>,
    /// When a value was last reported.
    reported_ms: Option<u32>,
    window_at: u8,
    window_count: u8,
    /// The smoothed elements, the last value reported, the window of the median.
    memory: M,
}

impl<const BYTES: usize> Filter<[u8; BYTES]> {
    /// A filter in its initial state. `BYTES` is [`FilterTable::bytes`].
    #[must_use]
    pub const fn new(table: &'static FilterTable) -> Self {
        Self {
            table,
            seen_ms: None,
            reported_ms: None,
            window_at: 0,
            window_count: 0,
            memory: [0; BYTES],
        }
    }
}

impl<const BYTES: usize> Deref for Filter<[u8; BYTES]> {
    type Target = Filter;

    fn deref(&self) -> &Filter {
        self
    }
}

impl<const BYTES: usize> DerefMut for Filter<[u8; BYTES]> {
    fn deref_mut(&mut self) -> &mut Filter {
        self
    }
}

impl Filter {
    /// Filters one value in place. `Fresh`: report it. `Nothing`: valid, but too little changed to
    /// be reported. `Invalid`: not a measurement; the value and the filter are unchanged.
    #[must_use]
    pub fn apply(&mut self, item: &Item, now_ms: u32, value: &mut [u8]) -> Outcome {
        if self.table.is_invalid(item, value) {
            return Outcome::Invalid;
        }
        if uses::MEDIAN && self.table.median > 1 {
            self.take_median(item, value);
        }
        if uses::SMOOTH && self.table.smooth_ms > 0 {
            self.smooth(item, now_ms, value);
        }
        let change = self.table.change.filter(|_| uses::CHANGE);
        let is_reported = change.is_none_or(|change| self.is_reported(item, change, now_ms, value));
        self.seen_ms = Some(now_ms);
        if is_reported {
            self.reported_ms = Some(now_ms);
            Outcome::Fresh
        } else {
            Outcome::Nothing
        }
    }

    fn take_median(&mut self, item: &Item, value: &mut [u8]) {
        let stride = item.bytes();
        let (_, rest) = split(&mut self.memory, self.table.smooth_bytes(item));
        let reported = if self.table.change.is_some() { stride } else { 0 };
        let (_, window) = split(rest, reported);
        let place = usize::from(self.window_at).wrapping_mul(stride);
        copy(window.get_mut(place..).unwrap_or_default(), value.get(..stride).unwrap_or_default());
        self.window_at += 1;
        if self.window_at >= self.table.median {
            self.window_at = 0;
        }
        self.window_count = self.table.median.min(self.window_count.saturating_add(1));
        for index in 0..usize::from(item.count) {
            let bits = middle(item.scalar, window, index, stride, self.window_count.into());
            item.scalar.store_at(bits, value, index);
        }
    }

    fn smooth(&mut self, item: &Item, now_ms: u32, value: &mut [u8]) {
        // The first value is taken as it is.
        let decay =
            self.seen_ms.map_or(0, |seen| decay(now_ms.wrapping_sub(seen), self.table.smooth_ms));
        let scalar = item.scalar;
        let elements = value.chunks_exact_mut(scalar.bytes()).take(item.count.into());
        for (element, state) in elements.zip(self.memory.as_chunks_mut::<SMOOTH_BYTES>().0) {
            if uses::REALS && scalar == Scalar::Float32 {
                real::smooth(state, decay, element);
            } else if uses::REALS && scalar == Scalar::Float64 {
                if let Some(wide) = self.table.wide {
                    (wide.smooth)(state, decay, element);
                }
            } else {
                let key = smooth::smooth_key(state, decay, key_of(scalar, scalar.load(element)));
                scalar.store(bits_of_key(scalar, key), element);
            }
        }
    }

    /// Whether a value is reported; if so, it is stored as the last one reported.
    fn is_reported(&mut self, item: &Item, change: Number, now_ms: u32, value: &[u8]) -> bool {
        let scalar = item.scalar;
        let reported = part(&self.memory, self.table.smooth_bytes(item), item.bytes());
        let is_far = |index: usize| {
            let (from, to) = (scalar.load_at(reported, index), scalar.load_at(value, index));
            self.table.is_far(change, scalar, from, to)
        };
        let has_changed = (0..usize::from(item.count)).any(is_far);
        if self.reported_ms.is_some() && !has_changed && !self.is_heartbeat(now_ms) {
            return false;
        }
        let (_, reported) = split(&mut self.memory, self.table.smooth_bytes(item));
        copy(reported, value.get(..item.bytes()).unwrap_or_default());
        true
    }

    /// Whether the next value would be too late for the heartbeat, assuming that it comes after at
    /// least three quarters of the present interval.
    fn is_heartbeat(&self, now_ms: u32) -> bool {
        let silent_ms = now_ms.wrapping_sub(self.reported_ms.unwrap_or_default());
        let interval_ms = now_ms.wrapping_sub(self.seen_ms.unwrap_or_default());
        let next_ms = u64::from(silent_ms) + u64::from(interval_ms - interval_ms / 4);
        self.table.heartbeat_ms != 0 && next_ms > u64::from(self.table.heartbeat_ms)
    }
}

/// The bits of an element as an unsigned number with the same order.
fn key_of(scalar: Scalar, bits: u64) -> u64 {
    let sign = scalar.sign();
    if scalar.is_real() && bits & sign != 0 {
        return sign.wrapping_mul(2).wrapping_sub(1).wrapping_sub(bits);
    }
    if scalar.is_real() || scalar.is_signed() { bits ^ sign } else { bits }
}

fn bits_of_key(scalar: Scalar, key: u64) -> u64 {
    if scalar.is_signed() { key ^ scalar.sign() } else { key }
}

/// The bits of the median element in the window. It is found by counting, which needs no memory for
/// a sorted copy.
fn middle(scalar: Scalar, window: &[u8], index: usize, stride: usize, count: usize) -> u64 {
    let bits_at = |one: usize| {
        let value = window.get(one.wrapping_mul(stride)..).unwrap_or_default();
        scalar.load_at(value, index)
    };
    let rank = count.saturating_sub(1) / 2;
    let is_middle = |candidate: &usize| {
        let key = key_of(scalar, bits_at(*candidate));
        let (mut below, mut equal) = (0, 0);
        for one in 0..count {
            let other = key_of(scalar, bits_at(one));
            below += usize::from(other < key);
            equal += usize::from(other == key);
        }
        below <= rank && rank < below + equal
    };
    (0..count).find(is_middle).map_or(0, bits_at)
}
