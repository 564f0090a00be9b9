//! The tolerance of a correct value.

use sensedsl_job::{BoardJob, JobDevice};
use sensedsl_model::kind::Interface;
use sensedsl_model::kind::icu::{Icu, Mode};
use sensedsl_model::protocol::Format;
use sensedsl_wire::ScalarType;

use crate::parts::formula;
use crate::truth::Subject;
use crate::world::Signal;

/// What handlers of interrupts on an AVR take: those of serial ports, and of the clock.
const HANDLER_US: f64 = 12.0;

/// By how much rounding and coding can move a raw number.
pub(super) fn tolerance(job: &BoardJob<'_>, one: &JobDevice<'_>, subject: &Subject) -> f64 {
    let device = one.device;
    let chip = job.design.part(device.part).and_then(|part| part.chip.as_ref());
    if let (Some(output), Some(chip)) = (device.coding.output, chip) {
        let bounds = subject.signals.iter().filter_map(Signal::bounds);
        let ends = bounds.flat_map(|(least, greatest)| [least, greatest]);
        let steps = ends.map(|end| formula::step(output, &chip.parameters, subject.scale.raw(end)));
        return steps.fold(1.5, |most, step| f64::max(most, 2.0 * step + 1.0));
    }
    if let Some(text) = &device.coding.text {
        return if text.format == Format::Degrees { 3.0 } else { 0.51 };
    }
    let tick = |icu: &Icu| f64::from(icu.tick_hz) / 1e6;
    match device.kind.interface() {
        Interface::Analog(_) => converter_step(job) + 0.6,
        Interface::Icu(icu) => match icu.mode {
            Mode::Count => 2.0,
            Mode::Width | Mode::Period => 2.0 + edge_us(job, one) * tick(icu),
            Mode::Frequency => frequency_step(icu, subject, edge_us(job, one)),
            Mode::Duty => 8.0,
            Mode::Ppm => 2.0 + 3.0 * tick(icu),
        },
        Interface::Encoder(_) => 3.0,
        Interface::Stepper(_) => 0.51,
        Interface::Digital(_) if subject.scalar != ScalarType::Bool => 2.0,
        Interface::Digital(_) => 0.0,
        Interface::I2c(_)
        | Interface::Spi(_)
        | Interface::Uart(_)
        | Interface::Can(_)
        | Interface::OneWire(_) => 0.51,
        Interface::Pwm(_) | Interface::Dac(_) | Interface::Code(_) => 0.0,
    }
}

/// The codes from one result of the board's converter to the next: values have 12 bits, whatever it has.
fn converter_step(job: &BoardJob<'_>) -> f64 {
    let bits = job.profile.map_or(12, |profile| profile.adc.resolution_bits);
    f64::from(1_u16 << 12_u8.saturating_sub(bits))
}

/// By how much the time between two edges may be off, in microseconds. A handler reads a coarse clock, and waits until
/// another one is over.
fn edge_us(job: &BoardJob<'_>, one: &JobDevice<'_>) -> f64 {
    let handled = job.profile.and_then(|profile| profile.edges.as_ref());
    let handled = handled.filter(|_| one.unit.is_none());
    handled.map_or(3.0, |edges| 2.0 * f64::from(edges.resolution_ns) / 1e3 + HANDLER_US)
}

/// The error that one tick, and an error of each edge, cause at the highest frequency.
fn frequency_step(icu: &Icu, subject: &Subject, edge_us: f64) -> f64 {
    let bounds = subject.signals.iter().filter_map(Signal::bounds);
    let most = bounds.map(|(_, greatest)| subject.scale.raw(greatest)).fold(1.0, f64::max);
    1.0 + most * most * (2.0 / f64::from(icu.tick_hz.max(1)) + (edge_us + 1.0) * 1e-6)
}
