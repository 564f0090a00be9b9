//! What there is no code for on ESP32, although the HAL has drivers of the kind.

use sensedsl_job::{BoardJob, JobConnection, JobDevice};
use sensedsl_model::kind::Kind;
use sensedsl_model::protocol::Drive;

use crate::hal::counted;

/// What a connection needs and there is no code for.
pub(super) fn lacks(job: &BoardJob<'_>, connection: &JobConnection<'_>) -> Option<&'static str> {
    let own = connection.devices.iter().filter_map(|index| job.devices.get(*index));
    let devices: Vec<&JobDevice<'_>> = own.collect();
    if devices.iter().any(|one| one.device.coding.drive.is_some_and(|one| one != Drive::TwoPwm)) {
        return Some(
            "H-bridges with direction pins on ESP32, where those with two PWM inputs are driven",
        );
    }
    match &connection.connection.kind {
        Kind::Digital(own) if counted::is_counted(own, &devices) => {
            Some("edges counted without `debounce` on ESP32")
        }
        // Its SPI pauses wherever its 64 bytes are used up.
        Kind::Spi(own) if own.encoding.windows().is_some() => Some(
            "LED strips on one wire on ESP32, where those with a clock (`driver = apa102`) are served",
        ),
        Kind::Icu(_)
        | Kind::Digital(_)
        | Kind::Analog(_)
        | Kind::I2c(_)
        | Kind::Encoder(_)
        | Kind::Spi(_)
        | Kind::Uart(_)
        | Kind::Pwm(_)
        | Kind::Dac(_)
        | Kind::Can(_)
        | Kind::OneWire(_)
        | Kind::Stepper(_)
        | Kind::Code(_) => None,
    }
}
