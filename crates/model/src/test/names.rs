//! Names in conditions: a name in; the device with what it measures, or a constant, out.

use sensedsl_diagnostics::codes::e0252_unknown_in_test as unknown;
use sensedsl_diagnostics::{Diagnostic, FileId, Span, nearest};
use sensedsl_wire::{Direction, ScalarType};

use super::sort::Sort;
use crate::design::{Design, Device, DeviceIndex, PartIndex, SignalOf, TestSignal, TestUnit};
use crate::fields::unit_of;
use crate::kind::Interface;
use crate::spanned::Spanned;
use crate::value::constants::Constants;
use crate::value::{Dimension, power_of_ten};

/// What a test can name.
#[derive(Clone, Copy)]
pub(super) struct Scope<'a> {
    /// The file that it is in.
    pub(super) file: FileId,
    pub(super) design: &'a Design,
    /// Devices that could not be read.
    pub(super) absent: &'a [Spanned<String>],
    pub(super) constants: &'a Constants,
}

impl<'a> Scope<'a> {
    /// The device of that name.
    pub(super) fn device(self, name: &str) -> Option<(DeviceIndex, &'a Device)> {
        let mut all = (0..).map(DeviceIndex).zip(&self.design.devices);
        all.find(|(_, device)| device.name.value == name)
    }

    /// Whether a name that is not there is that of a device that could not be read.
    pub(super) fn is_absent(self, name: &str) -> bool {
        self.absent.iter().any(|one| one.value == name)
    }

    /// Whether a device is a controller.
    pub(super) fn is_controller(self, device: DeviceIndex) -> bool {
        self.design.controllers.iter().any(|one| one.device == device)
    }

    /// Reports a name that is neither a device nor a constant.
    pub(super) fn unknown(self, at: Span, name: &str) -> Option<Diagnostic> {
        if self.is_absent(name) {
            return None;
        }
        let parts = (0..).map(PartIndex).zip(&self.design.parts);
        let mut named = parts.filter(|(_, part)| part.name.value == name);
        let values: Vec<&str> = named.next().map_or_else(Vec::new, |(index, _)| {
            let devices = self.design.devices.iter().filter(|device| device.part == index);
            devices.map(|device| device.name.value.as_str()).collect()
        });
        if !values.is_empty() {
            return Some(unknown::chip(at, name, &values));
        }
        let devices = self.design.devices.iter().map(|device| device.name.value.as_str());
        let near = nearest(name, devices.chain(self.constants.names()));
        Some(unknown::unknown_device(at, name, near))
    }
}

/// What a device measures, as hosts show it.
pub(super) fn sort(index: DeviceIndex, device: &Device) -> Sort {
    let is_truth = device.value.value.scalar == ScalarType::Bool;
    let mut sort = match device.shown.quantity.as_deref() {
        Some(quantity) => {
            let unit = unit_of(quantity);
            let power = unit.map_or(0, power_of_ten);
            let name = Some(quantity.to_owned());
            let dimension = unit.map(Dimension::of);
            Sort::of(dimension, TestUnit { name, power, is_of_ten_thousand: false })
        }
        None => match pulses_us(device) {
            Some(pulses_us) => {
                let name = Some("%".to_owned());
                let unit = TestUnit { name, power: 0, is_of_ten_thousand: true };
                let dimension = unit_of("%").map(Dimension::of);
                Sort { pulses_us: Some(pulses_us), ..Sort::of(dimension, unit) }
            }
            None => Sort::plain(),
        },
    };
    sort.device = Some(index);
    sort.is_truth = is_truth;
    sort
}

/// The shortest and the longest pulse of an output that shows nothing else; none if it is something else.
pub(super) fn pulses_us(device: &Device) -> Option<(f64, f64)> {
    let Interface::Pwm(pwm) = device.kind.interface() else { return None };
    let is_bare = device.shown.quantity.is_none() && device.shown.is_plain();
    let is_pulses = is_bare && device.value.value.scalar != ScalarType::Bool;
    let period_us = 1_000_000 / pwm.frequency_hz.max(1);
    let ends = [pwm.min_us.unwrap_or(0), pwm.max_us.unwrap_or(period_us)].map(f64::from);
    is_pulses.then_some(ends.into())
}

/// The signal of a device's value.
pub(super) fn value(index: DeviceIndex, device: &Device, element: Option<usize>) -> TestSignal {
    let name = device.name.value.clone();
    let name = element.map_or_else(|| name.clone(), |element| format!("{name}[{element}]"));
    let of = SignalOf::Value(element.unwrap_or(0));
    TestSignal { name, device: index, of, unit: sort(index, device).unit }
}

/// The signal of the steps of a controller that were late.
pub(super) fn overruns(index: DeviceIndex, device: &Device) -> TestSignal {
    let name = format!("{}.overruns", device.name.value);
    TestSignal { name, ..value(index, device, None) }
}

/// The signal of the time since a sensor's last value came; none if it is not a sensor.
pub(super) fn age(index: DeviceIndex, device: &Device) -> Option<(TestSignal, Sort)> {
    let unit = TestUnit { name: Some("ms".to_owned()), power: -3, is_of_ten_thousand: false };
    let name = format!("age({})", device.name.value);
    let signal = TestSignal { name, device: index, of: SignalOf::Age, unit: unit.clone() };
    let sort = Sort { needs_unit: true, ..Sort::of(Some(Dimension::TIME), unit) };
    (device.direction == Direction::Sensor).then_some((signal, sort))
}

/// The signal of a device's state.
pub(super) fn health(index: DeviceIndex, device: &Device) -> TestSignal {
    let name = format!("health({})", device.name.value);
    TestSignal { name, device: index, of: SignalOf::Health, unit: TestUnit::default() }
}
