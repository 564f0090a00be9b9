//! A test: a run of the boards in a world, what the host sets and what breaks, and the rules that the run is held to.

use sensedsl_diagnostics::Span;
use sensedsl_rules::Rule;

use super::{DeviceIndex, FaultKind};
use crate::spanned::Spanned;
use crate::value::shifted;

/// Significant digits of values in conditions: what computing leaves beyond them is no difference.
const DIGITS: usize = 12;

/// A test of the file.
#[derive(Clone, Debug, PartialEq)]
pub struct Test {
    /// Its name.
    pub name: Spanned<String>,
    /// The file with the world, as written: relative to the file that the test is in.
    pub world: Option<Spanned<String>>,
    /// What chance begins with, if the test says.
    pub seed: Option<u64>,
    /// How long it runs.
    pub lasts_ns: u64,
    /// What the host sets, in the order of time.
    pub sets: Vec<Setting>,
    /// What breaks, in the order of time.
    pub faults: Vec<TestFault>,
    /// What the rules are about; terms name these by their place.
    pub signals: Vec<TestSignal>,
    /// What must hold, in file order.
    pub rules: Vec<TestRule>,
}

/// An actuator that the host sets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Setting {
    /// The actuator.
    pub device: DeviceIndex,
    /// When.
    pub at_ns: u64,
    /// The code that goes over the wire, for each element.
    pub raw: f64,
}

/// Something that breaks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TestFault {
    /// What.
    pub kind: FaultKind,
    /// The sensor that it is about; none if it is about the board.
    pub device: Option<DeviceIndex>,
    /// When it begins.
    pub at_ns: u64,
    /// How long it lasts.
    pub lasts_ns: u64,
}

/// What of a device a signal is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SignalOf {
    /// The value of an element.
    Value(usize),
    /// The time since the last value came.
    Age,
    /// The state, as its number on the wire.
    Health,
}

/// Something that rules are about.
#[derive(Clone, Debug, PartialEq)]
pub struct TestSignal {
    /// As a person writes it: `Line[3]`.
    pub name: String,
    /// The device.
    pub device: DeviceIndex,
    /// What of it.
    pub of: SignalOf,
    /// In what conditions are computed.
    pub unit: TestUnit,
}

/// The unit in which a value is shown, and how to get from it to the one in which conditions are computed.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct TestUnit {
    /// Its name; none for a plain number.
    pub name: Option<String>,
    /// The power of ten from it to the unit of computation, such as -2 from cm to m.
    pub power: i32,
    /// Whether a host shows ten-thousandths of what a person calls 100 %: an output of pulses.
    pub is_of_ten_thousand: bool,
}

/// A rule, with what a person reads of it.
#[derive(Clone, Debug, PartialEq)]
pub struct TestRule {
    /// What must hold.
    pub rule: Rule,
    /// As it is written, in one line.
    pub text: String,
    /// Where.
    pub span: Span,
    /// The unit of the distance from a violation; none if what is compared in the rule is of several sorts, or has no
    /// distance: states, what is true or false, equalities.
    pub margin: Option<TestUnit>,
}

impl TestUnit {
    /// The number in which conditions are computed, of one as a host shows it.
    #[must_use]
    pub fn computed(&self, shown: f64) -> f64 {
        let shown = if self.is_of_ten_thousand { shown / 100.0 } else { shown };
        rounded(shifted(shown, self.power))
    }

    /// The number as a person reads it in this unit, of one in which conditions are computed.
    #[must_use]
    pub fn shown(&self, computed: f64) -> f64 {
        rounded(shifted(computed, -self.power))
    }
}

impl Test {
    /// The devices that it is about, each once.
    #[must_use]
    pub fn devices(&self) -> Vec<DeviceIndex> {
        let mut all: Vec<DeviceIndex> = self.signals.iter().map(|one| one.device).collect();
        all.extend(self.sets.iter().map(|one| one.device));
        all.extend(self.faults.iter().filter_map(|one| one.device));
        all.sort();
        all.dedup();
        all
    }

    /// Gives its devices new numbers. Tells whether all of them are left.
    pub(super) fn renumber(&mut self, new: &dyn Fn(DeviceIndex) -> Option<DeviceIndex>) -> bool {
        let signals = self.signals.iter_mut().map(|one| &mut one.device);
        let sets = self.sets.iter_mut().map(|one| &mut one.device);
        let faults = self.faults.iter_mut().filter_map(|one| one.device.as_mut());
        signals.chain(sets).chain(faults).all(|one| new(*one).map(|new| *one = new).is_some())
    }
}

/// A number without what computing has left in its last digits: 0.1 * 3 is 0.3.
#[must_use]
pub fn rounded(number: f64) -> f64 {
    if number.fract() == 0.0 {
        return number;
    }
    let text = format!("{number:.*e}", DIGITS - 1);
    text.parse().unwrap_or(number)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_value_is_the_constant_that_a_person_writes_for_it() {
        let tenths = TestUnit { name: Some("cm".into()), power: -2, is_of_ten_thousand: false };
        assert_eq!(tenths.computed(0.1 * 3.0), 0.003);
        assert_eq!(tenths.computed(20.0), 0.2);
        assert_eq!(tenths.shown(0.2), 20.0);
        let pulses = TestUnit { is_of_ten_thousand: true, ..TestUnit::default() };
        assert_eq!(pulses.computed(3_000.0), 30.0);
    }
}
