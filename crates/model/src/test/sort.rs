//! What a quantity measures, so that a length is never compared with a temperature.

use crate::design::{DeviceIndex, TestUnit};
use crate::value::{Dimension, Measure, Number};

/// What a quantity measures.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Sort {
    /// None where the device shows a unit that the language does not have: `lx`.
    pub(super) dimension: Option<Dimension>,
    /// The unit in which people read it.
    pub(super) unit: TestUnit,
    /// The shortest and the longest pulse in microseconds of an output that shows nothing else.
    pub(super) pulses_us: Option<(f64, f64)>,
    /// The device whose value it is, which knows what its codes mean.
    pub(super) device: Option<DeviceIndex>,
    /// Whether it is true or false.
    pub(super) is_truth: bool,
    /// Whether a number that is compared with it must have a unit.
    pub(super) needs_unit: bool,
}

impl Sort {
    pub(super) fn of(dimension: Option<Dimension>, unit: TestUnit) -> Self {
        let (pulses_us, device) = (None, None);
        Self { dimension, unit, pulses_us, device, is_truth: false, needs_unit: false }
    }

    /// A number without a unit.
    pub(super) fn plain() -> Self {
        Self::of(Some(Dimension::NONE), TestUnit::default())
    }

    /// What people call it.
    pub(super) fn words(&self) -> String {
        match &self.unit.name {
            Some(name) => format!("a value in {name}"),
            None => "a value without a unit".to_owned(),
        }
    }

    /// Whether values of both measure the same.
    pub(super) fn is_like(&self, other: &Self) -> bool {
        match (self.dimension, other.dimension) {
            (Some(one), Some(other)) => one == other,
            (None, None) => self.unit.name == other.unit.name,
            (Some(_), None) | (None, Some(_)) => false,
        }
    }

    fn is_plain(&self) -> bool {
        self.dimension == Some(Dimension::NONE)
    }

    /// What a product or a quotient of both measures; none if the language has no words for it.
    pub(super) fn combined(&self, other: &Self, is_product: bool) -> Option<Self> {
        if other.is_plain() {
            return Some(Self { device: None, is_truth: false, ..self.clone() });
        }
        if is_product && self.is_plain() {
            return Some(Self { device: None, is_truth: false, ..other.clone() });
        }
        let dimension = match (self.dimension, other.dimension) {
            (Some(one), Some(two)) if is_product => one.combine(two, i8::saturating_add),
            (Some(one), Some(two)) => one.combine(two, i8::saturating_sub),
            (None, None) if !is_product && self.is_like(other) => Dimension::NONE,
            (None | Some(_), _) => return None,
        };
        if dimension == Dimension::NONE {
            return Some(Self::plain());
        }
        let number = Number { value: 0.0, integer: None, measure: Measure::Derived(dimension) };
        let unit = TestUnit { name: Some(number.unit_name()), ..TestUnit::default() };
        Some(Self::of(Some(dimension), unit))
    }
}
