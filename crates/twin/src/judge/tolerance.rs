//! The tolerance of a correct value.

use sensedsl_job::{BoardJob, JobDevice};
use sensedsl_model::kind::Interface;
use sensedsl_model::kind::icu::{Icu, Mode};
use sensedsl_model::protocol::Format;
use sensedsl_wire::ScalarType;

use crate::parts::formula;
use crate::truth::Subject;
use crate::world::Signal;

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
        Interface::Analog(_) => 1.6,
        Interface::Icu(icu) => match icu.mode {
            Mode::Count => 2.0,
            Mode::Width | Mode::Period => 2.0 + 3.0 * tick(icu),
            Mode::Frequency => frequency_step(icu, subject),
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

/// The error that one tick, and a microsecond in each edge, cause at the highest frequency.
fn frequency_step(icu: &Icu, subject: &Subject) -> f64 {
    let bounds = subject.signals.iter().filter_map(Signal::bounds);
    let most = bounds.map(|(_, greatest)| subject.scale.raw(greatest)).fold(1.0, f64::max);
    1.0 + most * most * (2.0 / f64::from(icu.tick_hz.max(1)) + 4e-6)
}
