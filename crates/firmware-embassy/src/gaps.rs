//! What Embassy firmware cannot do yet. Every gap is reported; no device is left out in silence.

use sensedsl_model::kind::uart::Duplex;
use sensedsl_model::kind::{Kind, KindName};

use super::hal::contract::Drivers;
use super::hal::contract::buses::Serial;
use sensedsl_job::{BoardJob, JobConnection};

/// All kinds, in the order of the documentation.
pub(super) const KINDS: [KindName; 13] = [
    KindName::Analog,
    KindName::I2c,
    KindName::Icu,
    KindName::Encoder,
    KindName::Digital,
    KindName::Pwm,
    KindName::Dac,
    KindName::Uart,
    KindName::Spi,
    KindName::Can,
    KindName::OneWire,
    KindName::Stepper,
    KindName::Code,
];

/// The kinds that a HAL has drivers for.
pub(super) fn kinds(drivers: &dyn Drivers) -> Vec<KindName> {
    KINDS.into_iter().filter(|kind| serves(drivers, *kind)).collect()
}

fn serves(drivers: &dyn Drivers, kind: KindName) -> bool {
    match kind {
        KindName::Analog => drivers.analog().is_some(),
        KindName::I2c => drivers.i2c().is_some(),
        KindName::Icu => drivers.capture().is_some(),
        KindName::Encoder => drivers.encoder().is_some(),
        KindName::Digital | KindName::Code => true,
        KindName::Pwm => drivers.pulses().is_some(),
        KindName::Dac => drivers.dac().is_some(),
        KindName::Uart => drivers.serial().is_some(),
        KindName::Spi => drivers.spi().is_some(),
        KindName::Can => drivers.can().is_some(),
        KindName::OneWire => drivers.onewire().is_some(),
        KindName::Stepper => drivers.motors().is_some(),
    }
}

/// What a connection needs and there is no code for, although its kind is served.
pub(super) fn lacks(
    drivers: &dyn Drivers,
    job: &BoardJob<'_>,
    connection: &JobConnection<'_>,
) -> Option<&'static str> {
    if let Some(gap) = drivers.project().lacks(job, connection) {
        return Some(gap);
    }
    match &connection.connection.kind {
        Kind::I2c(_) | Kind::Spi(_) | Kind::OneWire(_) => job.lacks_on_buses(connection),
        Kind::Digital(own) if own.edge.is_some() && drivers.edges().is_none() => {
            Some("edges of digital inputs on this MCU")
        }
        Kind::Uart(own)
            if own.exchange.duplex == Duplex::Half
                && !drivers.serial().is_some_and(Serial::has_one_wire) =>
        {
            Some("both directions of a serial port on one wire")
        }
        Kind::Analog(_)
        | Kind::Icu(_)
        | Kind::Encoder(_)
        | Kind::Digital(_)
        | Kind::Uart(_)
        | Kind::Pwm(_)
        | Kind::Dac(_)
        | Kind::Can(_)
        | Kind::Stepper(_)
        | Kind::Code(_) => None,
    }
}

/// The connections that there is code for, in the design's order.
pub(super) fn served<'a>(
    drivers: &dyn Drivers,
    job: &'a BoardJob<'a>,
) -> Vec<&'a JobConnection<'a>> {
    let is_served = |one: &&JobConnection<'_>| {
        serves(drivers, one.connection.kind.name()) && lacks(drivers, job, one).is_none()
    };
    job.connections.iter().filter(is_served).collect()
}
