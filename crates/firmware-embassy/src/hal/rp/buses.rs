//! I²C and SPI, whose drivers have the unit in their types.

use sensedsl_board::signal::UnitName;
use sensedsl_job::{JobConnection, Pad};
use sensedsl_model::kind::Role;

use super::settings::Settings;
use crate::context::Context;
use crate::hal::contract::buses::{I2c, OneWire, Spi, SpiPins};
use crate::hal::contract::outputs::Pins as _;
use crate::hal::dma::channel;
use crate::missing::{self, Printed};
use crate::section::{Constructor, Section};

impl I2c for Settings {
    fn bus_type(&self, unit: &UnitName) -> String {
        format!("rt::i2c::I2cBus<{unit}>")
    }

    fn unit(
        &self,
        context: &Context<'_>,
        unit: &UnitName,
        wire: &JobConnection<'_>,
        hz: u32,
        section: &mut Section,
    ) -> Printed<Constructor> {
        let hal = context.peripheral(unit.as_str());
        let (scl, sda) = (missing::pad(wire, Role::Scl)?, missing::pad(wire, Role::Sda)?);
        let interrupt = context.interrupt(unit.as_str(), "EV")?;
        section.bind(interrupt, format!("hal::i2c::InterruptHandler<{hal}>"));
        Ok(Constructor {
            type_: format!("hal::i2c::I2c<'static, {hal}, hal::i2c::Async>"),
            make: format!(
                "hal::i2c::I2c::new_async(p.{hal}, p.{}, p.{}, Irqs, crate::rt::i2c::config({hz}))",
                self.pin(&scl.pin.name),
                self.pin(&sda.pin.name)
            ),
        })
    }
}

impl OneWire for Settings {}

impl Spi for Settings {
    fn bus_type(&self, unit: &UnitName) -> String {
        format!("rt::spi::SpiBus<{unit}>")
    }

    fn unit(
        &self,
        context: &Context<'_>,
        unit: &UnitName,
        wire: &JobConnection<'_>,
        section: &mut Section,
    ) -> Printed<Constructor> {
        let hal = context.peripheral(unit.as_str());
        let tx = channel(context, wire, "_TX", section)?;
        let pin = |pad: &Pad<'_>| self.pin(&pad.pin.name);
        let rest = "Irqs, Default::default())";
        let make = match SpiPins::of(wire)? {
            SpiPins::All(pads) => {
                let rx = channel(context, wire, "_RX", section)?;
                let [sck, mosi, miso] = pads.map(pin);
                format!("new(p.{hal}, p.{sck}, p.{mosi}, p.{miso}, p.{tx}, p.{rx}, {rest}")
            }
            SpiPins::Sending(pads) => {
                let [sck, mosi] = pads.map(pin);
                format!("new_txonly(p.{hal}, p.{sck}, p.{mosi}, p.{tx}, {rest}")
            }
            SpiPins::Data(mosi) => {
                format!("new_txonly_nosck(p.{hal}, p.{}, p.{tx}, {rest}", pin(mosi))
            }
        };
        Ok(Constructor {
            type_: format!("hal::spi::Spi<'static, {hal}, hal::spi::Async>"),
            make: format!("hal::spi::Spi::{make}"),
        })
    }
}
