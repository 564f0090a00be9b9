//! I²C and SPI, whose transfers go by DMA.

use sensedsl_board::signal::UnitName;
use sensedsl_job::JobConnection;
use sensedsl_model::kind::Role;

use super::settings::Settings;
use crate::context::Context;
use crate::hal::contract::buses::{I2c, OneWire, Spi, SpiPins};
use crate::hal::dma::channel;
use crate::missing::{self, Printed};
use crate::section::{Constructor, Section};

impl I2c for Settings {
    fn bus_type(&self, _unit: &UnitName) -> String {
        "rt::i2c::I2cBus".to_owned()
    }

    fn unit(
        &self,
        context: &Context<'_>,
        unit: &UnitName,
        wire: &JobConnection<'_>,
        hz: u32,
        section: &mut Section,
    ) -> Printed<Constructor> {
        let unit = unit.as_str();
        let hal = context.peripheral(unit);
        let (scl, sda) = (missing::pad(wire, Role::Scl)?, missing::pad(wire, Role::Sda)?);
        let tx = channel(context, wire, "_TX", section)?;
        let rx = channel(context, wire, "_RX", section)?;
        for (signal, handler) in [("EV", "EventInterruptHandler"), ("ER", "ErrorInterruptHandler")]
        {
            // A unit with one interrupt for both has it under either name.
            let interrupt = context.interrupt(unit, signal)?;
            section.bind(interrupt, format!("hal::i2c::{handler}<{hal}>"));
        }
        section.features.insert(if self.has_old_buses() { "i2c-v1" } else { "i2c-v2" });
        if self.has_pulls() {
            section.features.insert("gpio-v2");
        }
        Ok(Constructor {
            type_: "hal::i2c::I2c<'static, hal::mode::Async, hal::i2c::Master>".to_owned(),
            make: format!(
                "hal::i2c::I2c::new{}(p.{hal}, p.{}, p.{}, p.{tx}, p.{rx}, Irqs, crate::rt::i2c::config({hz}))",
                self.generics(context, unit, &["_"; 3]),
                scl.pin.name,
                sda.pin.name
            ),
        })
    }
}

impl OneWire for Settings {
    fn feature(&self) -> Option<&'static str> {
        // An output of F1 has no resistor.
        self.has_pulls().then_some("gpio-v2")
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
        let unit = unit.as_str();
        let hal = context.peripheral(unit);
        let tx = channel(context, wire, "_TX", section)?;
        let rest = "Irqs, Default::default())";
        let make = match SpiPins::of(wire)? {
            SpiPins::All([sck, mosi, miso]) => {
                let rx = channel(context, wire, "_RX", section)?;
                let [sck, mosi, miso] = [sck, mosi, miso].map(|pad| &pad.pin.name);
                let generics = self.generics(context, unit, &["_"; 3]);
                format!(
                    "new{generics}(p.{hal}, p.{sck}, p.{mosi}, p.{miso}, p.{tx}, p.{rx}, {rest}"
                )
            }
            SpiPins::Sending([sck, mosi]) => {
                let [sck, mosi] = [sck, mosi].map(|pad| &pad.pin.name);
                let generics = self.generics(context, unit, &["_"; 2]);
                format!("new_txonly{generics}(p.{hal}, p.{sck}, p.{mosi}, p.{tx}, {rest}")
            }
            SpiPins::Data(mosi) => {
                let generics = self.generics(context, unit, &["_"; 2]);
                format!("new_txonly_nosck{generics}(p.{hal}, p.{}, p.{tx}, {rest}", mosi.pin.name)
            }
        };
        Ok(Constructor {
            type_: "hal::spi::Spi<'static, hal::mode::Async, hal::spi::mode::Master>".to_owned(),
            make: format!("hal::spi::Spi::{make}"),
        })
    }
}
