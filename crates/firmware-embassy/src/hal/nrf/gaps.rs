//! What there is no code for on nRF52, although the HAL has drivers of the kind.

use sensedsl_job::{BoardJob, JobConnection, JobDevice};
use sensedsl_model::kind::Kind;
use sensedsl_model::kind::uart::{Parity, Uart};
use sensedsl_model::protocol::Drive;

use super::settings::Settings;
use crate::hal::counted;

/// What a connection needs and there is no code for.
pub(super) fn lacks(
    settings: &Settings,
    job: &BoardJob<'_>,
    connection: &JobConnection<'_>,
) -> Option<&'static str> {
    let own = connection.devices.iter().filter_map(|index| job.devices.get(*index));
    let devices: Vec<&JobDevice<'_>> = own.collect();
    if devices.iter().any(|one| one.device.coding.drive.is_some_and(|one| one != Drive::TwoPwm)) {
        return Some(
            "H-bridges with direction pins on nRF52, where those with two PWM inputs are driven",
        );
    }
    match &connection.connection.kind {
        Kind::Uart(uart) => of_port(settings, uart),
        Kind::Digital(own) if counted::is_counted(own, &devices) => {
            Some("edges counted without `debounce` on nRF52, where `type = icu` counts them")
        }
        Kind::Icu(_)
        | Kind::Digital(_)
        | Kind::Analog(_)
        | Kind::I2c(_)
        | Kind::Encoder(_)
        | Kind::Spi(_)
        | Kind::Pwm(_)
        | Kind::Dac(_)
        | Kind::Can(_)
        | Kind::OneWire(_)
        | Kind::Stepper(_)
        | Kind::Code(_) => None,
    }
}

/// A port has eight bits, and even parity or none.
fn of_port(settings: &Settings, uart: &Uart) -> Option<&'static str> {
    if uart.data_bits != 8 {
        Some("seven data bits on nRF52, whose ports have eight")
    } else if uart.parity == Parity::Odd {
        Some("odd parity on nRF52, whose ports have even parity or none")
    } else if uart.stop_bits == 2 && !settings.has_two_stop_bits {
        Some("two stop bits on nRF52832, whose port has one")
    } else {
        None
    }
}
