//! Filtering of a value before it is reported: `up_filter_t`, with numbers of the value's own type.

use sensedsl_model::design::Device;
use sensedsl_wire::ScalarType;

use crate::snake;

/// A number of a value's own type, as the runtime's `up_number_t` holds it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Number {
    /// An unsigned number or a `bool`.
    Unsigned(u64),
    /// A signed integer.
    Signed(i64),
    /// A `float`.
    Float32(f32),
    /// A `double`.
    Float64(f64),
}

/// An `up_filter_t`.
#[derive(Clone, Debug)]
pub struct FilterPlan {
    /// The device's name.
    pub field: String,
    /// The device's identifier in code.
    pub ident: String,
    /// Ranges of values that are not measurements: from, to.
    pub invalid: Vec<(Number, Number)>,
    /// Whether it needs arithmetic in double precision.
    pub is_wide: bool,
    /// The number of values that the median is taken of.
    pub median: u8,
    /// The time constant of a low-pass.
    pub smooth_ms: u32,
    /// The least change that is reported; `None` if everything is. For integers the distance is unsigned, even if the
    /// type is signed.
    pub change: Option<Number>,
    /// The longest time from one report to the next.
    pub heartbeat_ms: u32,
    /// The number of elements of the value.
    pub count: usize,
    /// The bytes of one element.
    pub element_bytes: usize,
    /// The 64-bit words of memory, as `UP_FILTER_WORDS()` computes them.
    pub memory_words: usize,
}

impl FilterPlan {
    /// The filter of a device; `None` if every value is reported as it is.
    pub(super) fn new(device: &Device) -> Option<Self> {
        let filter = &device.filter;
        if filter.is_empty() {
            return None;
        }
        let scalar = device.value.value.scalar;
        let (has_smooth, has_change) = (filter.smooth_ms > 0, filter.change.is_some());
        let (count, element_bytes) = (device.value.value.count(), scalar.size_bytes());
        let value_words = |values: usize| (values * count * element_bytes).div_ceil(8);
        let smooth_words = if has_smooth { 2 * count } else { 0 };
        let change_words = if has_change { value_words(1) } else { 0 };
        Some(Self {
            field: device.name.value.clone(),
            ident: snake(&device.name.value),
            invalid: filter.invalid.iter().filter_map(|&ends| range(scalar, ends)).collect(),
            is_wide: scalar == ScalarType::Float64 && (has_smooth || has_change),
            median: filter.median,
            smooth_ms: filter.smooth_ms,
            change: filter.change.map(|change| distance(scalar, change)),
            heartbeat_ms: filter.heartbeat_ms,
            count,
            element_bytes,
            memory_words: value_words(usize::from(filter.median)) + smooth_words + change_words,
        })
    }
}

/// The part of a range that the type can represent; `None` if it is empty.
fn range(scalar: ScalarType, (low, high): (f64, f64)) -> Option<(Number, Number)> {
    let whole = if scalar == ScalarType::Bool { Some((0, 1)) } else { scalar.integer_range() };
    let Some((least, greatest)) = whole else {
        return Some((real(scalar, low), real(scalar, high)));
    };
    let (low, high) = (integer(low.ceil()).max(least), integer(high.floor()).min(greatest));
    (low <= high).then(|| (number(least, low), number(least, high)))
}

#[expect(clippy::cast_possible_truncation, reason = "it saturates, and every type is narrower")]
fn integer(whole: f64) -> i128 {
    whole as i128
}

/// A number of the integer type whose least value is `least`.
fn number(least: i128, number: i128) -> Number {
    if least < 0 {
        Number::Signed(i64::try_from(number).unwrap_or(i64::MAX))
    } else {
        Number::Unsigned(u64::try_from(number).unwrap_or(u64::MAX))
    }
}

/// The least distance between two numbers of the type that counts as a change.
fn distance(scalar: ScalarType, change: f64) -> Number {
    if matches!(scalar, ScalarType::Float32 | ScalarType::Float64) {
        return real(scalar, change);
    }
    number(0, integer(change.ceil()).max(1))
}

/// A floating-point number.
fn real(scalar: ScalarType, number: f64) -> Number {
    if scalar == ScalarType::Float64 {
        return Number::Float64(number.clamp(f64::MIN, f64::MAX));
    }
    #[expect(
        clippy::cast_possible_truncation,
        reason = "clamped, and rounded to what the type has"
    )]
    let number = number.clamp(f64::from(f32::MIN), f64::from(f32::MAX)) as f32;
    Number::Float32(number)
}
