//! What becomes of a value before it is reported: `up_filter_t`, with numbers of the value's own type.

use sensedsl_model::design::Device;
use sensedsl_wire::ScalarType;

use crate::snake;

/// A number of a value's own type, as the runtime's `up_number_t` holds it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Number {
    /// Of a type without a sign, a `bool` among them.
    Unsigned(u64),
    /// Of an integer type with a sign.
    Signed(i64),
    /// Of `float`.
    Float32(f32),
    /// Of `double`.
    Float64(f64),
}

/// An `up_filter_t`.
#[derive(Clone, Debug)]
pub struct FilterPlan {
    /// The device.
    pub field: String,
    /// What code calls it.
    pub ident: String,
    /// Values that are not a measurement: from, to.
    pub invalid: Vec<(Number, Number)>,
    /// Whether it needs arithmetic in double precision.
    pub is_wide: bool,
    /// The median of so many values.
    pub median: u8,
    /// Time constant of a low-pass.
    pub smooth_ms: u32,
    /// What is a change; none where everything is reported. The distance of integers has no sign, whatever they have.
    pub change: Option<Number>,
    /// The longest time from report to report.
    pub heartbeat_ms: u32,
    /// Elements of the value.
    pub count: usize,
    /// Bytes of one.
    pub element_bytes: usize,
    /// 64-bit words of memory, as `UP_FILTER_WORDS()` counts.
    pub memory_words: usize,
}

impl FilterPlan {
    /// The filter of a device; none where every value is reported as it is.
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

/// The numbers of the type that are in a range; none where there are none.
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

/// A number of an integer type whose least one is that.
fn number(least: i128, number: i128) -> Number {
    if least < 0 {
        Number::Signed(i64::try_from(number).unwrap_or(i64::MAX))
    } else {
        Number::Unsigned(u64::try_from(number).unwrap_or(u64::MAX))
    }
}

/// How far two numbers of the type are apart at least, so that it is a change.
fn distance(scalar: ScalarType, change: f64) -> Number {
    if matches!(scalar, ScalarType::Float32 | ScalarType::Float64) {
        return real(scalar, change);
    }
    number(0, integer(change.ceil()).max(1))
}

/// A number with a fraction.
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
