//! What there is no code for on RP2040 and RP2350, although the HAL has drivers of the kind.

use sensedsl_job::{BoardJob, JobConnection, JobDevice};
use sensedsl_model::kind::Kind;
use sensedsl_model::kind::digital::Digital;
use sensedsl_model::kind::icu::{Edge, Icu, Mode};
use sensedsl_wire::{Direction, ScalarType};

/// What a connection needs and there is no code for.
pub(super) fn lacks(job: &BoardJob<'_>, connection: &JobConnection<'_>) -> Option<&'static str> {
    let own = connection.devices.iter().filter_map(|index| job.devices.get(*index));
    let devices: Vec<&JobDevice<'_>> = own.collect();
    match &connection.connection.kind {
        Kind::Icu(icu) => of_capture(icu),
        Kind::Digital(own) if counts(own, &devices) => Some(
            "edges counted without `debounce` on RP2040 and RP2350, where `type = icu` counts them",
        ),
        Kind::Digital(_)
        | Kind::Analog(_)
        | Kind::I2c(_)
        | Kind::Encoder(_)
        | Kind::Uart(_)
        | Kind::Spi(_)
        | Kind::Pwm(_)
        | Kind::Dac(_)
        | Kind::Can(_)
        | Kind::OneWire(_)
        | Kind::Stepper(_)
        | Kind::Code(_) => None,
    }
}

/// A slice counts edges of one direction.
const fn of_capture(icu: &Icu) -> Option<&'static str> {
    match (icu.mode, icu.edge) {
        (Mode::Count, Edge::Both) => {
            Some("counts of both edges on RP2040 and RP2350, whose PWM slices count one of them")
        }
        (Mode::Count, Edge::Rising | Edge::Falling)
        | (Mode::Width | Mode::Period | Mode::Frequency | Mode::Duty | Mode::Ppm, _) => None,
    }
}

/// Whether any number of edges is counted in any time. An edge wakes a task, which may see two of them as one.
fn counts(own: &Digital, devices: &[&JobDevice<'_>]) -> bool {
    let is_count = |one: &&JobDevice<'_>| {
        one.device.direction == Direction::Sensor
            && one.device.value.value.scalar != ScalarType::Bool
    };
    own.edge.is_some() && own.debounce_us == 0 && devices.iter().any(is_count)
}
