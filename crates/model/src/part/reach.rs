//! The range of a value: a device in; what its part gives or takes, as far as its type holds it, and what a host shows
//! of it out.

use sensedsl_wire::{ScalarType, ValueType};

use crate::design::Device;
use crate::design::protocol::Coding;
use crate::kind::icu::Mode;
use crate::kind::pwm::FULL;
use crate::kind::{Kind, KindName};

/// The range that a kind or a bridge has, whatever the type.
pub(crate) fn fixed(kind: &Kind, coding: &Coding) -> Option<(f64, f64)> {
    if coding.drive.is_some() {
        return Some((-FULL, FULL));
    }
    let is_duty = kind.icu().is_some_and(|icu| icu.mode == Mode::Duty);
    if is_duty { Some((0.0, FULL)) } else { kind.name().spec().codes }
}

/// The least and the greatest code that can be given for a value: those of the part, as far as its
/// type holds them.
pub(crate) fn of_codes(kind: KindName, coding: &Coding, value: ValueType) -> Option<(f64, f64)> {
    let fixed = if coding.drive.is_some() { Some((-FULL, FULL)) } else { kind.spec().codes };
    let part = fixed.or_else(|| of_bits(coding, value));
    both(part, of_type(value.scalar))
}

/// The least and the greatest raw value that a part gives or takes; none if not known.
pub(crate) fn of_part(kind: &Kind, coding: &Coding, value: ValueType) -> Option<(f64, f64)> {
    let is_computed = coding.output.is_some() || coding.text.is_some() || coding.bcd;
    if is_computed { None } else { fixed(kind, coding).or_else(|| of_bits(coding, value)) }
}

/// The range that the bits of a word hold.
fn of_bits(coding: &Coding, value: ValueType) -> Option<(f64, f64)> {
    let scalar = coding.of.unwrap_or(value).scalar;
    let (least, _) = scalar.integer_range()?;
    let bits = coding.bits.map(|(high, low)| high - low + 1).or(coding.packed_bits);
    match bits {
        None => of_type(scalar),
        Some(bits) if coding.signed.unwrap_or(least < 0) => {
            let half = 2_f64.powi(i32::from(bits) - 1);
            Some((-half, half - 1.0))
        }
        Some(bits) => Some((0.0, 2_f64.powi(i32::from(bits)) - 1.0)),
    }
}

/// The least and the greatest number that a type holds; none for a fractional type, which holds
/// any.
pub(crate) fn of_type(scalar: ScalarType) -> Option<(f64, f64)> {
    let (least, most) = scalar.integer_range()?;
    #[expect(
        clippy::cast_precision_loss,
        reason = "the ends of 64 bits are as near as a number gets"
    )]
    Some((least as f64, most as f64))
}

/// The least and the greatest raw value of a device: those of its part, as far as its type holds
/// them.
#[must_use]
pub fn raw(device: &Device) -> Option<(f64, f64)> {
    let value = device.value.value;
    both(of_part(&device.kind, &device.coding, value), of_type(value.scalar))
}

fn both(part: Option<(f64, f64)>, held: Option<(f64, f64)>) -> Option<(f64, f64)> {
    match (part, held) {
        (Some(part), Some(held)) => Some((part.0.max(held.0), part.1.min(held.1))),
        (one, other) => one.or(other),
    }
}

/// The least and the greatest value that a host shows for a device.
#[must_use]
pub fn shown(device: &Device) -> Option<(f64, f64)> {
    let (least, most) = raw(device)?;
    let (one, other) = (device.shown.of_raw(least), device.shown.of_raw(most));
    let curve = device.shown.curve.iter().map(|point| point.1);
    let all = curve.chain([one, other]);
    let (low, high) = all.fold((f64::MAX, f64::MIN), |(low, high), y| (low.min(y), high.max(y)));
    Some((low, high))
}
