//! Queries of a target profile: a unit, a signal or a pin in, its facts out.

use super::types::{
    Adc, Dac, DacOutput, DmaRequest, ExtiRule, Pio, TargetProfile, Timer, Transport, Unit, Usb,
};
use crate::pin::PinName;
use crate::signal::{Function, Signal};

impl TargetProfile {
    /// The system's name: `chibios`.
    #[must_use]
    pub fn system(&self) -> &str {
        self.name.rsplit_once('-').map_or(self.name.as_str(), |(system, _)| system)
    }

    /// The system's version: `21.11`.
    #[must_use]
    pub fn version(&self) -> &str {
        self.name.rsplit_once('-').map_or("", |(_, version)| version)
    }

    /// The timer with a name.
    #[must_use]
    pub fn timer(&self, name: &str) -> Option<&Timer> {
        self.timers.iter().find(|timer| timer.name == name)
    }

    /// The block of state machines with a name.
    #[must_use]
    pub fn pio(&self, name: &str) -> Option<&Pio> {
        self.pios.iter().find(|pio| pio.name == name)
    }

    /// The converter with a number.
    #[must_use]
    pub fn adc(&self, number: u8) -> Option<&Adc> {
        self.adcs.iter().find(|adc| adc.number() == Some(number))
    }

    /// The I²C, SPI, serial or CAN unit with a name. `CAN`, the name of an only unit, means `CAN1`,
    /// and `SPI` means `SPI1`.
    #[must_use]
    pub fn unit(&self, name: &str) -> Option<&Unit> {
        let name = match name {
            "CAN" => "CAN1",
            "SPI" => "SPI1",
            name => name,
        };
        let units = self.i2cs.iter().chain(&self.spis).chain(&self.serials).chain(&self.cans);
        units.into_iter().find(|unit| unit.name == name)
    }

    /// An output of a digital-analog converter.
    #[must_use]
    pub fn dac_output(&self, unit: u8, channel: u8) -> Option<&DacOutput> {
        let named = |dac: &&Dac| dac.name.strip_prefix("DAC") == Some(unit.to_string().as_str());
        let dac = self.dacs.iter().find(named)?;
        dac.outputs.iter().find(|output| output.channel == channel)
    }

    /// The USB device with a name; the first one if there is no name.
    #[must_use]
    pub fn usb(&self, name: Option<&str>) -> Option<&Usb> {
        self.usbs.iter().find(|usb| name.is_none_or(|name| usb.name.eq_ignore_ascii_case(name)))
    }

    /// The DMA streams that the driver of a unit takes; empty if it takes none.
    #[must_use]
    pub fn dma(&self, unit: &str) -> &[DmaRequest] {
        let adc = self.adcs.iter().find(|adc| adc.name == unit).map(|adc| adc.dma.as_slice());
        adc.or_else(|| self.unit(unit).map(|unit| unit.dma.as_slice())).unwrap_or_default()
    }

    /// Whether edges at a pin can interrupt.
    #[must_use]
    pub fn interrupts_at(&self, pin: &PinName) -> bool {
        self.interrupts.as_ref().is_none_or(|all| all.contains(pin))
    }

    /// The interrupt line of a pin; pins on the same line exclude each other. `None` if each pin
    /// has its own line.
    #[must_use]
    pub fn exti_group(&self, pin: &PinName) -> Option<u8> {
        match self.exti.rule {
            ExtiRule::OnePortPerNumber => pin.number(),
            ExtiRule::OneLinePerPin => None,
        }
    }

    /// The pins that a link takes on any board, which are those of a USB device. The pins of a
    /// serial link are chosen like those of any device.
    #[must_use]
    pub fn link_pins(&self, transport: Transport, unit: Option<&str>) -> &[PinName] {
        match transport {
            Transport::Usb => self.usb(unit).map(|usb| usb.pins.as_slice()).unwrap_or_default(),
            Transport::Uart => &[],
        }
    }

    /// The usual alternate function of a signal on a pin; a number in the table takes precedence.
    #[must_use]
    pub fn alternate(&self, signal: &Signal, pin: &PinName) -> Option<u8> {
        let unit = |unit: &Unit| {
            let exception = unit.exceptions.iter().find(|exception| exception.pin == *pin);
            exception.map(|exception| exception.alternate).or(unit.alternate)
        };
        match signal.function() {
            Function::Timer { unit, .. } => self.timer(unit.as_str())?.alternate,
            Function::I2c { .. }
            | Function::Uart { .. }
            | Function::Spi { .. }
            | Function::Can { .. } => {
                let name = signal.function().units().into_iter().next()?;
                unit(self.unit(name.as_str())?)
            }
            Function::Adc { .. }
            | Function::Dac { .. }
            | Function::Pio { .. }
            | Function::Other => None,
        }
    }

    /// Whether the driver of some unit of the system can serve the function.
    #[must_use]
    pub fn serves(&self, function: &Function) -> bool {
        match function {
            Function::Adc { units, channel } => units
                .iter()
                .any(|unit| self.adc(*unit).is_some_and(|adc| adc.inputs.contains(channel))),
            Function::Timer { unit, .. } => self.timer(unit.as_str()).is_some(),
            Function::Dac { unit, channel } => self.dac_output(*unit, *channel).is_some(),
            Function::I2c { .. }
            | Function::Uart { .. }
            | Function::Spi { .. }
            | Function::Can { .. } => {
                function.units().iter().any(|unit| self.unit(unit.as_str()).is_some())
            }
            Function::Pio { unit } => self.pio(unit.as_str()).is_some(),
            Function::Other => false,
        }
    }
}
