//! The numbers that a device should report: conversion of the world's value, in the device's own unit, back to the
//! number on the wire.
//!
//! A host shows `curve(scale * raw + offset)`. This is inverted here, so that a world can be written in degrees and
//! centimetres, and parts get the numbers that real hardware would have measured.

use sensedsl_host::Scale;
use sensedsl_model::design::{Device, DeviceIndex, Presentation};
use sensedsl_wire::{Scalar, ScalarType};

use crate::arith::{rounded, signed_number};
use crate::world::Signal;

/// The conversion of a device's raw numbers to shown ones.
#[must_use]
pub fn scale_of(shown: &Presentation) -> Scale {
    Scale::new(shown.scale, shown.offset, shown.curve.clone())
}

/// A device and its signals.
#[derive(Clone, Debug, PartialEq)]
pub struct Subject {
    /// The device's index in the design.
    pub device: DeviceIndex,
    /// Its name.
    pub name: String,
    /// Its identifier on the link.
    pub id: u8,
    /// The type of an element.
    pub scalar: ScalarType,
    /// The conversion to shown numbers.
    pub scale: Scale,
    /// The signal of each element.
    pub signals: Vec<Signal>,
}

impl Subject {
    /// A device with its signals.
    #[must_use]
    pub fn new(index: DeviceIndex, device: &Device, signals: Vec<Signal>) -> Self {
        Self {
            device: index,
            name: device.name.value.clone(),
            id: device.id.value,
            scalar: device.value.value.scalar,
            scale: scale_of(&device.shown),
            signals,
        }
    }

    /// The world's value of an element, in the device's own unit.
    #[must_use]
    pub fn shown(&self, element: usize, now_ns: u64) -> f64 {
        self.signals.get(element).map_or(0.0, |signal| signal.at(now_ns))
    }

    /// The raw number of an element, before rounding.
    #[must_use]
    pub fn raw(&self, element: usize, now_ns: u64) -> f64 {
        self.scale.raw(self.shown(element, now_ns))
    }

    /// The least and the greatest raw number of an element in a span of time.
    #[must_use]
    pub fn raw_range(&self, element: usize, from_ns: u64, to_ns: u64) -> (f64, f64) {
        let range = self.signals.get(element).map(|signal| signal.range(from_ns, to_ns));
        let (one, other) = range.unwrap_or((0.0, 0.0));
        let (one, other) = (self.scale.raw(one), self.scale.raw(other));
        (one.min(other), one.max(other))
    }

    /// The raw number of an element, rounded.
    #[must_use]
    pub fn whole(&self, element: usize, now_ns: u64) -> i64 {
        rounded(self.raw(element, now_ns))
    }
}

/// A number in the type that carries it; a number that does not fit becomes the nearest that does.
#[must_use]
pub fn scalar(of: ScalarType, raw: f64) -> Scalar {
    #[expect(clippy::cast_possible_truncation, reason = "the type has no more digits")]
    match of {
        ScalarType::Float32 => Scalar::Float32(raw as f32),
        ScalarType::Float64 => Scalar::Float64(raw),
        ScalarType::Bool => Scalar::Bool(rounded(raw) != 0),
        ScalarType::Uint8 | ScalarType::Uint16 | ScalarType::Uint32 | ScalarType::Uint64 => {
            Scalar::Unsigned(u64::try_from(within(of, raw)).unwrap_or(0))
        }
        ScalarType::Int8 | ScalarType::Int16 | ScalarType::Int32 | ScalarType::Int64 => {
            Scalar::Signed(within(of, raw))
        }
    }
}

fn within(of: ScalarType, raw: f64) -> i64 {
    let (least, greatest) = of.integer_range().unwrap_or((0, 0));
    let number = i128::from(rounded(raw)).clamp(least, greatest);
    i64::try_from(number).unwrap_or(i64::MAX)
}

/// A scalar as a real number.
#[must_use]
pub fn real(scalar: Scalar) -> f64 {
    match scalar {
        Scalar::Bool(flag) => f64::from(u8::from(flag)),
        Scalar::Unsigned(number) => crate::arith::number(number),
        Scalar::Signed(number) => signed_number(number),
        Scalar::Float32(number) => f64::from(number),
        Scalar::Float64(number) => number,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scale(factor: f64, offset: f64, curve: &[(f64, f64)]) -> Scale {
        Scale::new(Some(factor), Some(offset), curve.to_vec())
    }

    #[test]
    fn what_is_shown_of_a_raw_number_leads_back_to_it() {
        let falling = [(0.4, 80.0), (1.3, 20.0), (2.8, 4.0)];
        let rising = [(0.0, -10.0), (1.0, 0.0), (3.3, 95.0)];
        for scale in [
            scale(1.0, 0.0, &[]),
            scale(-0.25, 40.0, &[]),
            scale(3.3 / 4095.0, 0.0, &falling),
            scale(3.3 / 4095.0, 0.0, &rising),
        ] {
            for raw in (500..3400).step_by(37) {
                let raw = f64::from(raw);
                let back = scale.raw(scale.shown(raw));
                assert!((back - raw).abs() < 1e-6, "{scale:?} {raw} {back}");
            }
        }
    }

    #[test]
    fn a_value_beyond_a_curve_is_at_its_end() {
        let scale = scale(1.0, 0.0, &[(0.4, 80.0), (1.3, 20.0)]);
        assert!((scale.raw(90.0) - 0.4).abs() < 1e-9);
        assert!((scale.raw(-5.0) - 1.3).abs() < 1e-9);
    }

    #[test]
    fn what_does_not_fit_is_the_nearest_that_does() {
        assert_eq!(scalar(ScalarType::Uint8, 300.0), Scalar::Unsigned(255));
        assert_eq!(scalar(ScalarType::Uint8, -3.0), Scalar::Unsigned(0));
        assert_eq!(scalar(ScalarType::Int16, -1e9), Scalar::Signed(-32768));
        assert_eq!(scalar(ScalarType::Bool, 0.7), Scalar::Bool(true));
    }
}
