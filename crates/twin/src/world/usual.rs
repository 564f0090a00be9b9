//! The signals of sensors that a world does not mention: each moves within the sensor's range at a pace of its own, so
//! that a board without a world shows live values that differ from each other.

use sensedsl_host::Scale;
use sensedsl_model::design::{Device, DeviceIndex};
use sensedsl_model::kind::Interface;
use sensedsl_model::kind::icu::Mode;
use sensedsl_model::protocol::Format;
use sensedsl_model::words::{Code, Words};
use sensedsl_wire::ScalarType;

use super::signal::{Shape, Signal, Visit};
use crate::arith::{nanoseconds, number};
use crate::parts::formula;
use crate::parts::line::Spikes;
use crate::range::{edges_a_second_max, is_counter, raw_range};
use crate::truth::scale_of;

/// How often a sensor has nothing to measure, and for how long.
const INVALID_EVERY_NS: u64 = 6_000_000_000;
const INVALID_NS: u64 = 700_000_000;
/// The time from one spike that a median removes to the next.
const SPIKE_EVERY_NS: u64 = 1_300_000_000;
/// The shortest time that a low-pass has to follow a step.
const STEP_NS: u64 = 1_500_000_000;

/// The length of a contact's press in per cent of its debounce time, and the number of its wire's spike periods from
/// one press to the next. A contact with twice the debounce time never sees the press.
const PRESS_PERCENT: u64 = 195;
const PRESSES: u64 = 2;

/// The bound for raw numbers from words, unless something else gives their range.
const FAR: f64 = 30_000.0;

/// The signals of a sensor that a world does not mention.
#[must_use]
pub fn usual(index: DeviceIndex, device: &Device) -> Vec<Signal> {
    let elements = u64::try_from(device.value.value.count()).unwrap_or(1);
    let place = u64::try_from(index.0).unwrap_or(0);
    let shape = |element: u64| {
        let shape = shape(device, place * 5 + element);
        if element == 0 { visits(device, shape) } else { shape }
    };
    (0..elements).map(|element| Signal::of(shape(element))).collect()
}

/// Adds visits that show whether filters work: an invalid value or a jump now and then.
fn visits(device: &Device, base: Shape) -> Shape {
    let Shape::Sine { offset, amplitude, period_ns } = base else { return base };
    let half = amplitude / 2.0;
    let filter = &device.filter;
    let cycle_ns = 1_000_000 * u64::from(device.delay_ms.max(1));
    let (every_ns, for_ns, to) = if let Some(code) = invalid_code(device) {
        (INVALID_EVERY_NS.max(20 * cycle_ns), INVALID_NS.max(4 * cycle_ns), Visit::To(code))
    } else if filter.smooth_ms > 0 {
        let half_ns = STEP_NS.max(5_000_000 * u64::from(filter.smooth_ms));
        (2 * half_ns, half_ns, Visit::By(half))
    } else if filter.median > 2 {
        (SPIKE_EVERY_NS.max(20 * cycle_ns), cycle_ns + cycle_ns / 5, Visit::By(half))
    } else {
        return base;
    };
    // Base and visits together stay in the sound range.
    let base = Box::new(Shape::Sine { offset, amplitude: half, period_ns });
    Shape::Visits { base, every_ns, for_ns, to }
}

/// A value in the device's own unit that is `invalid` and that its part can send.
fn invalid_code(device: &Device) -> Option<f64> {
    let is_coded = Words::of(device).is_some() && device.coding.output.is_none();
    if !is_coded && !device.kind.is_sampled() {
        return None;
    }
    let scale = scale_of(&device.shown);
    let (least, greatest) = raw_range(device)?;
    let codes = device.filter.invalid.iter().flat_map(|(low, high)| [*low, *high]);
    let is_there = |code: &f64| {
        (least..=greatest).contains(code) && (scale.raw(scale.shown(*code)) - code).abs() < 0.01
    };
    codes.into_iter().find(is_there).map(|code| scale.shown(code))
}

fn shape(device: &Device, place: u64) -> Shape {
    let pace = number(place % 11);
    let scale = scale_of(&device.shown);
    if is_counter(&device.kind, device) {
        let (zero, each) = (scale.shown(0.0), scale.shown(1.0) - scale.shown(0.0));
        let edges = 20.0 + 7.0 * pace;
        let edges = edges_a_second_max(device).map_or(edges, |most| edges.min(most / 2.0));
        return Shape::Rate { from: zero, a_second: each * edges };
    }
    // A level lasts longer than the debounce time.
    let lasts_us = device.kind.digital().map_or(0, |own| own.debounce_us);
    let lasts_s = f64::from(lasts_us) / 1e6;
    let period_ns = nanoseconds((4.0 + 0.7 * pace + 8.0 * lasts_s) * 1e9);
    if device.value.value.scalar == ScalarType::Bool || is_one_bit(device) {
        let (first, second) = (scale.shown(0.0), scale.shown(1.0));
        return pressed(lasts_us, Shape::Square { first, second, period_ns: period_ns / 2 });
    }
    let (low, high) = sound_range(device, &scale);
    // A width or a count of elements is a whole number, and the ends of the range are least like a measurement.
    let middle = low + (high - low) * (0.5 + 0.02 * (pace - 5.0));
    let (centre, reach) = (scale.shown(middle), scale.shown(high) - scale.shown(low));
    Shape::Sine { offset: centre, amplitude: reach * 0.3, period_ns }
}

/// A contact with a debounce time that is pressed now and then for a little longer than that.
fn pressed(lasts_us: u32, base: Shape) -> Shape {
    let Shape::Square { first, second, .. } = base else { return base };
    if lasts_us == 0 {
        return base;
    }
    let lasting_ns = 1_000 * u64::from(lasts_us);
    let every_ns = PRESSES * Spikes::below(lasting_ns).every_ns();
    let for_ns = lasting_ns.saturating_mul(PRESS_PERCENT) / 100;
    Shape::Visits { base: Box::new(base), every_ns, for_ns, to: Visit::Other(first + second) }
}

fn is_one_bit(device: &Device) -> bool {
    Words::of(device).is_some_and(|words| words.bits == 1)
}

/// A range of raw numbers as a measurement gives them, none of which is invalid.
fn sound_range(device: &Device, scale: &Scale) -> (f64, f64) {
    let (mut low, mut high) = likely_range(device);
    if let Some((least, greatest)) = raw_range(device) {
        let named = named_range(device).map(|(from, to)| (scale.raw(from), scale.raw(to)));
        let named =
            named.map(|(one, other)| (one.min(other).max(least), one.max(other).min(greatest)));
        if let Some(named) = named.filter(|(from, to)| from < to) {
            (low, high) = named;
        }
        (low, high) = (low.max(least), high.min(greatest));
        if low >= high {
            let width = greatest - least;
            (low, high) = (least + 0.1 * width, least + 0.9 * width);
        }
    }
    if let (Some(first), Some(last)) = (device.shown.curve.first(), device.shown.curve.last()) {
        let [one, other] = [first, last].map(|point| scale.raw(point.1));
        (low, high) = (low.max(one.min(other)), high.min(one.max(other)));
    }
    let shown = [device.shown.min, device.shown.max].map(|end| end.map(|end| scale.raw(end)));
    if let [Some(one), Some(other)] = shown {
        let (least, greatest) = (one.min(other), one.max(other));
        let overlaps = least < high && greatest > low;
        // What the part says of itself is worth more than what is usual.
        (low, high) =
            if overlaps { (low.max(least), high.min(greatest)) } else { (least, greatest) };
    }
    largest_piece((low, high), &device.filter.invalid)
}

/// The usual range of a quantity, in its unit, as people measure it in a room.
fn named_range(device: &Device) -> Option<(f64, f64)> {
    match device.shown.quantity.as_deref()? {
        "cm" => Some((20.0, 250.0)),
        "mm" => Some((100.0, 1_500.0)),
        "m" => Some((0.5, 80.0)),
        "degC" => Some((15.0, 30.0)),
        "%" => Some((20.0, 80.0)),
        "lx" => Some((50.0, 500.0)),
        "V" => Some((0.5, 3.0)),
        "A" => Some((0.1, 1.5)),
        "m/s" => Some((0.5, 5.0)),
        _ => None,
    }
}

/// The largest part of a range that has nothing invalid.
fn largest_piece(range: (f64, f64), invalid: &[(f64, f64)]) -> (f64, f64) {
    let mut holes = invalid.to_vec();
    holes.sort_by(|one, other| one.0.total_cmp(&other.0));
    let mut best = (range.0, range.0);
    let mut from = range.0;
    for (start, end) in holes.into_iter().chain([(range.1 + 1.0, range.1 + 1.0)]) {
        let to = (start - 1.0).min(range.1);
        if to - from > best.1 - best.0 {
            best = (from, to);
        }
        from = from.max(end + 1.0);
    }
    best
}

fn likely_range(device: &Device) -> (f64, f64) {
    let coding = &device.coding;
    if let Some(output) = coding.output {
        return formula::likely(output);
    }
    if let Some(text) = &coding.text {
        return match text.format {
            Format::Degrees => (577_000_000.0, 577_100_000.0),
            Format::Decimal | Format::Hex => (10.0, 240.0),
        };
    }
    match device.kind.interface() {
        Interface::Icu(icu) => {
            let ticks = |us: f64| us * f64::from(icu.tick_hz) / 1e6;
            match icu.mode {
                Mode::Width if icu.pulse_us.is_some() => (ticks(500.0), ticks(12_000.0)),
                Mode::Width | Mode::Ppm => (ticks(1_050.0), ticks(1_950.0)),
                Mode::Period => (ticks(5_000.0), ticks(20_000.0)),
                Mode::Frequency => (10.0, 200.0),
                Mode::Duty => (1_000.0, 9_000.0),
                Mode::Count => (0.0, 0.0),
            }
        }
        Interface::Encoder(_) | Interface::Stepper(_) => (-2_000.0, 2_000.0),
        Interface::Analog(_) => (400.0, 3_700.0),
        Interface::I2c(_)
        | Interface::Spi(_)
        | Interface::Uart(_)
        | Interface::Can(_)
        | Interface::OneWire(_) => of_words(device),
        Interface::Digital(_) | Interface::Pwm(_) | Interface::Dac(_) | Interface::Code(_) => {
            (0.0, 1.0)
        }
    }
}

fn of_words(device: &Device) -> (f64, f64) {
    let Some(words) = Words::of(device) else { return (0.0, 100.0) };
    match (words.code, crate::parts::words::range(&words)) {
        // A temperature or the like.
        (Code::Magnitude, _) => (-200.0, 400.0),
        // A month, a weekday, an hour.
        (Code::Bcd, _) => (1.0, 7.0),
        (_, None) => (-100.0, 100.0),
        (_, Some((least, greatest))) if least < 0.0 => {
            ((least * 0.5).max(-FAR), (greatest * 0.5).min(FAR))
        }
        (_, Some((_, greatest))) => (greatest * 0.1, (greatest * 0.9).min(FAR)),
    }
}
