//! I²C and SPI, whose units take any pins.

use sensedsl_board::signal::UnitName;
use sensedsl_job::JobConnection;
use sensedsl_model::kind::Role;

use super::settings::Settings;
use crate::context::Context;
use crate::hal::contract::buses::{I2c, Spi, SpiPins};
use crate::missing::{self, Missing, Printed};
use crate::section::{Constructor, Section};

impl I2c for Settings {
    fn bus_type(&self, _unit: &UnitName) -> String {
        "rt::i2c::I2cBus".to_owned()
    }

    /// The HAL ends by itself whatever does not end.
    fn registers(&self, _context: &Context<'_>, _unit: &str) -> String {
        "()".to_owned()
    }

    fn unit(
        &self,
        context: &Context<'_>,
        unit: &UnitName,
        wire: &JobConnection<'_>,
        hz: u32,
        _section: &mut Section,
    ) -> Printed<Constructor> {
        let hal = context.peripheral(unit.as_str());
        let (scl, sda) = (missing::pad(wire, Role::Scl)?, missing::pad(wire, Role::Sda)?);
        Ok(Constructor {
            type_: "crate::rt::i2c::Master".to_owned(),
            make: format!(
                "crate::rt::i2c::bus(p.{hal}, {hz}, p.{}, p.{})",
                sda.pin.name, scl.pin.name
            ),
        })
    }
}

impl Spi for Settings {
    fn bus_type(&self, _unit: &UnitName) -> String {
        "rt::spi::SpiBus".to_owned()
    }

    fn unit(
        &self,
        context: &Context<'_>,
        unit: &UnitName,
        wire: &JobConnection<'_>,
        _section: &mut Section,
    ) -> Printed<Constructor> {
        let hal = context.peripheral(unit.as_str());
        let make = match SpiPins::of(wire)? {
            SpiPins::All(pads) => {
                let [sck, mosi, miso] = pads.map(|pad| &pad.pin.name);
                format!("bus(p.{hal}, p.{sck}, p.{mosi}, p.{miso})")
            }
            SpiPins::Sending(pads) => {
                let [sck, mosi] = pads.map(|pad| &pad.pin.name);
                format!("bus(p.{hal}, p.{sck}, p.{mosi}, esp_hal::gpio::NoPin)")
            }
            SpiPins::Data(_) => return Err(Missing::wire("SCK".to_owned())),
        };
        Ok(Constructor {
            type_: "crate::rt::spi::Master".to_owned(),
            make: format!("crate::rt::spi::{make}"),
        })
    }
}
