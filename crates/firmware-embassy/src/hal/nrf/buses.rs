//! I²C and SPI, whose units take any pins and have DMA of their own.

use sensedsl_board::signal::UnitName;
use sensedsl_job::{JobConnection, Pad};
use sensedsl_model::kind::Role;

use super::settings::Settings;
use crate::context::Context;
use crate::hal::contract::buses::{I2c, Spi, SpiPins};
use crate::hal::contract::outputs::Pins as _;
use crate::missing::{self, Printed};
use crate::section::{Constructor, Section};

/// What a transfer writes is copied here if it is in the flash, which DMA does not reach.
const COPIED_BYTES: usize = 255;

impl I2c for Settings {
    fn bus_type(&self, _unit: &UnitName) -> String {
        "rt::i2c::I2cBus".to_owned()
    }

    /// The registers have the name that the chip's documents give to the unit as this kind of bus.
    fn registers(&self, _context: &Context<'_>, unit: &str) -> String {
        format!("hal::pac::{unit}")
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
        section.bind(interrupt, format!("hal::twim::InterruptHandler<{hal}>"));
        Ok(Constructor {
            type_: "hal::twim::Twim<'static>".to_owned(),
            make: format!(
                "{{ static COPY: ConstStaticCell<[u8; {COPIED_BYTES}]> = ConstStaticCell::new([0; {COPIED_BYTES}]); \
                 hal::twim::Twim::new(p.{hal}, Irqs, p.{}, p.{}, crate::rt::i2c::config({hz}), COPY.take()) }}",
                self.pin(&sda.pin.name),
                self.pin(&scl.pin.name)
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
        section: &mut Section,
    ) -> Printed<Constructor> {
        let hal = context.peripheral(unit.as_str());
        let interrupt = context.interrupt(unit.as_str(), "GLOBAL")?;
        section.bind(interrupt, format!("hal::spim::InterruptHandler<{hal}>"));
        let pin = |pad: &Pad<'_>| self.pin(&pad.pin.name);
        let rest = "Default::default())";
        let make = match SpiPins::of(wire)? {
            SpiPins::All(pads) => {
                let [sck, mosi, miso] = pads.map(pin);
                format!("new(p.{hal}, Irqs, p.{sck}, p.{miso}, p.{mosi}, {rest}")
            }
            SpiPins::Sending(pads) => {
                let [sck, mosi] = pads.map(pin);
                format!("new_txonly(p.{hal}, Irqs, p.{sck}, p.{mosi}, {rest}")
            }
            SpiPins::Data(mosi) => {
                format!("new_txonly_nosck(p.{hal}, Irqs, p.{}, {rest}", pin(mosi))
            }
        };
        Ok(Constructor {
            type_: "hal::spim::Spim<'static>".to_owned(),
            make: format!("hal::spim::Spim::{make}"),
        })
    }
}
