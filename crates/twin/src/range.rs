//! The range of the numbers that a device can report at all: what its type holds and its hardware can measure.

use sensedsl_model::design::Device;
use sensedsl_model::kind::digital::Edge;
use sensedsl_model::kind::icu::Mode;
use sensedsl_model::kind::{Interface, Kind};
use sensedsl_model::words::Words;
use sensedsl_wire::ScalarType;

use crate::parts::{formula, words};
use crate::truth::scale_of;

/// Whether the device counts edges, so that its value never decreases.
#[must_use]
pub fn is_counter(kind: &Kind, device: &Device) -> bool {
    match kind.interface() {
        Interface::Icu(icu) => icu.mode == Mode::Count,
        Interface::Digital(digital) => {
            digital.edge.is_some() && device.value.value.scalar != ScalarType::Bool
        }
        Interface::Analog(_)
        | Interface::I2c(_)
        | Interface::Encoder(_)
        | Interface::Uart(_)
        | Interface::Spi(_)
        | Interface::OneWire(_)
        | Interface::Pwm(_)
        | Interface::Dac(_)
        | Interface::Can(_)
        | Interface::Stepper(_)
        | Interface::Code(_) => false,
    }
}

/// The most edges a second that a contact's debounce lets through; `None` if it lets all through.
#[must_use]
pub fn edges_a_second_max(device: &Device) -> Option<f64> {
    let digital = device.kind.digital()?;
    let levels_an_edge = match digital.edge? {
        Edge::Rising | Edge::Falling => 2.0,
        Edge::Both => 1.0,
    };
    let lasts_us = f64::from(digital.debounce_us);
    (lasts_us > 0.0).then(|| 1e6 / (lasts_us * levels_an_edge))
}

/// The least and the greatest raw number; `None` for real numbers without bounds.
#[must_use]
pub fn raw_range(device: &Device) -> Option<(f64, f64)> {
    let whole = device.value.value.scalar.integer_range();
    #[expect(clippy::cast_precision_loss, reason = "the ends of 64 bits are rounded")]
    let whole = whole.map(|(least, greatest)| (least as f64, greatest as f64));
    let own = own_range(device);
    match (whole, own) {
        (Some(one), Some(other)) => Some((one.0.max(other.0), one.1.min(other.1))),
        (one, other) => one.or(other),
    }
}

/// The range that the hardware can measure.
fn own_range(device: &Device) -> Option<(f64, f64)> {
    if let Some(output) = device.coding.output {
        return Some(formula::range(output));
    }
    match device.kind.interface() {
        Interface::Analog(_) => Some((0.0, 4_095.0)),
        Interface::Digital(digital) if digital.edge.is_none() => Some((0.0, 1.0)),
        Interface::Icu(icu) if icu.mode == Mode::Duty => Some((0.0, 10_000.0)),
        Interface::Icu(icu) if icu.mode == Mode::Ppm => {
            let ticks = |us: f64| us * f64::from(icu.tick_hz) / 1e6;
            Some((ticks(600.0), ticks(2_100.0)))
        }
        Interface::Icu(_) | Interface::Digital(_) => Some((0.0, f64::from(u32::MAX))),
        Interface::I2c(_)
        | Interface::Spi(_)
        | Interface::Uart(_)
        | Interface::Can(_)
        | Interface::OneWire(_) => Words::of(device).as_ref().and_then(words::range),
        Interface::Encoder(_)
        | Interface::Pwm(_)
        | Interface::Dac(_)
        | Interface::Stepper(_)
        | Interface::Code(_) => None,
    }
}

/// The least and the greatest value in the device's own unit.
#[must_use]
pub fn shown_range(device: &Device) -> Option<(f64, f64)> {
    let (least, greatest) = raw_range(device)?;
    let scale = scale_of(&device.shown);
    let ends = [least, greatest].map(|raw| scale.shown(raw));
    let curve = device.shown.curve.iter().map(|point| point.1);
    let all = ends.into_iter().filter(|_| device.shown.curve.is_empty()).chain(curve);
    let (low, high) = all.fold((f64::MAX, f64::MIN), |(l, h), one| (l.min(one), h.max(one)));
    Some((low, high))
}
