//! What there is no firmware for yet. A gap is told; nothing is left out in silence.

use sensedsl_model::kind::icu::{Edge, Mode};
use sensedsl_model::kind::{Kind, KindName, Role};
use sensedsl_wire::Direction;

use crate::job::{BoardJob, JobConnection};

/// The kinds that there is code for.
pub(super) const KINDS: &[KindName] = &[
    KindName::Analog,
    KindName::I2c,
    KindName::Icu,
    KindName::Encoder,
    KindName::Digital,
    KindName::Pwm,
    KindName::Dac,
];

/// What a connection needs and no code is made for.
pub(super) fn lacks(job: &BoardJob<'_>, connection: &JobConnection<'_>) -> Option<&'static str> {
    let devices = connection.devices.iter().filter_map(|index| job.devices.get(*index));
    for device in devices {
        if device.device.coding.drive.is_some() {
            return Some("bridges in Embassy's firmware");
        }
    }
    if connection.connection.name.is_some() {
        return Some("chips with several connections in Embassy's firmware");
    }
    let plan = job.tables_of(connection);
    let is_actuator = connection.connection.direction == Direction::Actuator;
    let is_array = connection.connection.element.is_some();
    match &connection.connection.kind {
        Kind::Analog(_) if plan.is_some_and(|plan| !plan.formulas.is_empty()) => {
            Some("a formula of an analog value in Embassy's firmware")
        }
        Kind::I2c(_)
            if plan
                .and_then(|plan| plan.bus.as_ref())
                .is_some_and(|bus| !bus.commands.is_empty()) =>
        {
            Some("a chip that is written to in Embassy's firmware")
        }
        Kind::Icu(_) if is_array => Some("an array of captures in Embassy's firmware"),
        Kind::Icu(icu) if icu.mode == Mode::Ppm => Some("pulse trains in Embassy's firmware"),
        Kind::Icu(_) if connection.pad(Role::Trigger).is_some() => {
            Some("the trigger of a capture in Embassy's firmware")
        }
        Kind::Icu(icu) if icu.mode != Mode::Count && icu.edge != Edge::Rising => {
            Some("widths and periods from a falling edge in Embassy's firmware")
        }
        Kind::Encoder(_) if is_array => Some("an array of encoders in Embassy's firmware"),
        Kind::Digital(own) if !is_actuator && (own.edge.is_some() || own.debounce_us > 0) => {
            Some("an input with edges or a debounce time in Embassy's firmware")
        }
        Kind::Analog(_)
        | Kind::I2c(_)
        | Kind::Icu(_)
        | Kind::Encoder(_)
        | Kind::Digital(_)
        | Kind::Uart(_)
        | Kind::Spi(_)
        | Kind::Pwm(_)
        | Kind::Dac(_)
        | Kind::Can(_) => None,
    }
}
