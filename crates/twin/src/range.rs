//! The range of the numbers that a device can report at all: what its type holds and its hardware can measure.

use sensedsl_model::design::Device;
use sensedsl_model::kind::digital::Edge;
use sensedsl_model::kind::icu::Mode;
use sensedsl_model::kind::{Kind, KindName};
use sensedsl_model::words::Words;
use sensedsl_wire::ScalarType;

use crate::parts::words;
use crate::truth::Scale;

/// Whether the device counts edges, so that its value never decreases.
#[must_use]
pub fn is_counter(kind: &Kind, device: &Device) -> bool {
    match kind {
        Kind::Icu(icu) => icu.mode == Mode::Count,
        Kind::Digital(digital) => {
            digital.edge.is_some() && device.value.value.scalar != ScalarType::Bool
        }
        Kind::Analog(_)
        | Kind::I2c(_)
        | Kind::Encoder(_)
        | Kind::Uart(_)
        | Kind::Spi(_)
        | Kind::Pwm(_)
        | Kind::Dac(_)
        | Kind::Can(_) => false,
    }
}

/// The most edges a second that a contact's debounce lets through; `None` if it lets all through.
#[must_use]
pub fn edges_a_second_max(device: &Device) -> Option<f64> {
    let Kind::Digital(digital) = &device.kind else { return None };
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
        return Some(match (device.kind.name(), output) {
            (KindName::Analog, _) => (-4_000.0, 12_500.0),
            (_, 0) if matches!(&device.kind, Kind::I2c(i2c) if i2c.length_bytes == 4) => {
                (0.0, 20_000_000.0)
            }
            (_, 0) => (-4_000.0, 8_500.0),
            (_, 1) => (30_000.0 * 256.0, 110_000.0 * 256.0),
            (_, _) => (0.0, 100.0 * 1_024.0),
        });
    }
    match &device.kind {
        Kind::Analog(_) => Some((0.0, 4_095.0)),
        Kind::Digital(digital) if digital.edge.is_none() => Some((0.0, 1.0)),
        Kind::Icu(icu) if icu.mode == Mode::Duty => Some((0.0, 10_000.0)),
        Kind::Icu(icu) if icu.mode == Mode::Ppm => {
            let ticks = |us: f64| us * f64::from(icu.tick_hz) / 1e6;
            Some((ticks(600.0), ticks(2_100.0)))
        }
        Kind::Icu(_) | Kind::Digital(_) => Some((0.0, f64::from(u32::MAX))),
        Kind::I2c(_) | Kind::Spi(_) | Kind::Uart(_) | Kind::Can(_) => {
            Words::of(device).as_ref().and_then(words::range)
        }
        Kind::Encoder(_) | Kind::Pwm(_) | Kind::Dac(_) => None,
    }
}

/// The least and the greatest value in the device's own unit.
#[must_use]
pub fn shown_range(device: &Device) -> Option<(f64, f64)> {
    let (least, greatest) = raw_range(device)?;
    let scale = Scale::of(&device.shown);
    let ends = [least, greatest].map(|raw| scale.shown(raw));
    let curve = device.shown.curve.iter().map(|point| point.1);
    let all = ends.into_iter().filter(|_| device.shown.curve.is_empty()).chain(curve);
    let (low, high) = all.fold((f64::MAX, f64::MIN), |(l, h), one| (l.min(one), h.max(one)));
    Some((low, high))
}
