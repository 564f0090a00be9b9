//! I²C and SPI, whose drivers have the unit in their type.

use sensedsl_board::signal::UnitName;
use sensedsl_model::kind::Role;

use crate::chips::Bus;
use crate::context::Context;
use crate::lack::{self, Printed};
use crate::section::{Field, Section};
use sensedsl_job::snake;

/// The runtime's type of an I²C bus.
pub(crate) fn i2c_type(unit: &UnitName) -> String {
    format!("rt::i2c::I2cBus<{unit}>")
}

/// The runtime's type of an SPI bus.
pub(crate) fn spi_type(unit: &UnitName) -> String {
    format!("rt::spi::SpiBus<{unit}>")
}

/// An I²C unit at a clock.
pub(crate) fn i2c(
    context: &Context<'_>,
    bus: &Bus<'_>,
    hz: u32,
    section: &mut Section,
) -> Printed<Field> {
    let unit = bus.unit.as_str();
    let hal = context.peripheral(unit);
    let (scl, sda) = (lack::pad(bus.first, Role::Scl)?, lack::pad(bus.first, Role::Sda)?);
    let interrupt = context.interrupt(unit, "EV")?;
    section.bind(interrupt, format!("hal::i2c::InterruptHandler<{hal}>"));
    Ok(Field {
        name: snake(unit),
        comment: format!("{unit} at {} and {}: {}", scl.pin.name, sda.pin.name, bus.titles()),
        type_: format!("hal::i2c::I2c<'static, {hal}, hal::i2c::Async>"),
        make: format!(
            "hal::i2c::I2c::new_async(p.{hal}, p.{}, p.{}, Irqs, crate::rt::i2c::config({hz}))",
            context.pin(&scl.pin.name),
            context.pin(&sda.pin.name)
        ),
    })
}
