//! What a HAL says about buses and ports: I²C, SPI, serial ports, CAN.

use sensedsl_board::signal::UnitName;
use sensedsl_job::kinds::can::{self, Identifier};
use sensedsl_job::{JobConnection, Pad};
use sensedsl_model::kind::Role;
use sensedsl_model::kind::uart::{Parity, Uart};

use crate::context::Context;
use crate::missing::{self, Printed};
use crate::section::{Constructor, Section};

/// I²C buses.
pub(crate) trait I2c {
    /// The runtime's type of a bus that tasks share.
    fn bus_type(&self, unit: &UnitName) -> String;

    /// The registers of a unit.
    fn registers(&self, context: &Context<'_>, unit: &str) -> String {
        format!("hal::pac::{}", context.peripheral(unit))
    }

    /// A unit as master at a clock, with its interrupts and DMA channels bound in the section. `wire` is one of those
    /// on the bus: all have its pads.
    fn unit(
        &self,
        context: &Context<'_>,
        unit: &UnitName,
        wire: &JobConnection<'_>,
        hz: u32,
        section: &mut Section,
    ) -> Printed<Constructor>;
}

/// SPI buses.
pub(crate) trait Spi {
    /// The runtime's type of a bus that tasks share.
    fn bus_type(&self, unit: &UnitName) -> String;

    /// A unit as master, with its DMA channels bound in the section. `wire` is one of those on the bus.
    fn unit(
        &self,
        context: &Context<'_>,
        unit: &UnitName,
        wire: &JobConnection<'_>,
        section: &mut Section,
    ) -> Printed<Constructor>;
}

/// The pins of an SPI bus. A strip of LEDs sends nothing back, and some have no clock.
pub(crate) enum SpiPins<'a> {
    /// SCK, MOSI and MISO.
    All([&'a Pad<'a>; 3]),
    /// SCK and MOSI.
    Sending([&'a Pad<'a>; 2]),
    /// MOSI.
    Data(&'a Pad<'a>),
}

impl<'a> SpiPins<'a> {
    /// The pins of a connection.
    pub(crate) fn of(wire: &'a JobConnection<'a>) -> Printed<Self> {
        let mosi = missing::pad(wire, Role::Mosi)?;
        Ok(match (wire.pad(Role::Sck), wire.pad(Role::Miso)) {
            (Some(sck), Some(miso)) => Self::All([sck, mosi, miso]),
            (Some(sck), None) => Self::Sending([sck, mosi]),
            (None, _) => Self::Data(mosi),
        })
    }
}

/// Wires that both ends pull low. The runtime's module `wire` has the type `OneWirePin`, and `pin`, which makes one. The
/// HAL's clock counts microseconds: a slot is timed by it.
pub(crate) trait OneWire {
    /// The feature of `sense-embassy` that the module needs on this line of MCUs.
    fn feature(&self) -> Option<&'static str> {
        None
    }
}

/// Serial ports of devices.
pub(crate) trait Serial {
    /// The runtime's module of serial ports, which has `transmit` and what [`Serial::hearing`] says.
    fn module(&self) -> &'static str;

    /// Who takes the bytes that a port receives.
    fn hearing(&self) -> Hearing {
        Hearing::Interrupt
    }

    /// Whether a port can take wires whose levels are inverted.
    fn can_invert(&self) -> bool {
        true
    }

    /// Whether a port can have both directions at TX.
    fn has_one_wire(&self) -> bool {
        false
    }

    /// The type of a port or of one of its directions.
    fn half_type(&self, half: Half) -> String;

    /// A port that is read and written by waiting.
    fn port(&self, context: &Context<'_>, port: &Port<'_>, section: &mut Section) -> String;

    /// The registers of a port, by the HAL's name of the unit.
    fn registers(&self, unit: &str) -> String {
        format!("hal::pac::{unit}")
    }
}

/// Who takes the bytes that a port receives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Hearing {
    /// The project's handler of the port's interrupt, with the module's `listen` and `on_interrupt`.
    Interrupt,
    /// A task, with the module's `receive`.
    Task,
}

/// A serial port or one of its directions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Half {
    Both,
    Rx,
    Tx,
}

impl Half {
    /// The type of its driver, which all HALs call the same.
    pub(crate) const fn driver(self) -> &'static str {
        match self {
            Self::Both => "Uart",
            Self::Rx => "UartRx",
            Self::Tx => "UartTx",
        }
    }
}

/// The HAL's `Parity`, which all HALs call the same.
pub(crate) const fn parity(uart: &Uart) -> &'static str {
    match uart.parity {
        Parity::None => "ParityNone",
        Parity::Even => "ParityEven",
        Parity::Odd => "ParityOdd",
    }
}

/// The wires of a serial port with its settings.
pub(crate) struct Port<'a> {
    pub(crate) unit: &'a str,
    pub(crate) uart: &'a Uart,
    pub(crate) pins: PortPins<'a>,
}

/// The pins of a serial port.
#[derive(Clone, Copy)]
pub(crate) enum PortPins<'a> {
    Both { rx: &'a Pad<'a>, tx: &'a Pad<'a> },
    Rx(&'a Pad<'a>),
    Tx(&'a Pad<'a>),
}

impl<'a> PortPins<'a> {
    /// The pin that hears.
    pub(crate) const fn rx(self) -> Option<&'a Pad<'a>> {
        match self {
            Self::Both { rx, .. } | Self::Rx(rx) => Some(rx),
            Self::Tx(_) => None,
        }
    }
}

/// CAN controllers.
pub(crate) trait Can {
    /// A controller, with its interrupts bound in the section.
    fn controller(
        &self,
        context: &Context<'_>,
        bus: &can::Bus<'_>,
        section: &mut Section,
    ) -> Printed<Constructor>;

    /// Which frames the controller lets through. What must be turned on for that is a start of the section.
    fn filters(
        &self,
        context: &Context<'_>,
        bus: &can::Bus<'_>,
        section: &mut Section,
    ) -> Printed<Filters>;
}

/// Which frames a CAN controller lets through.
pub(crate) struct Filters {
    /// The arguments of the runtime's `can::start` that say where the filters are, each with a comma after it.
    pub(crate) place: String,
    /// The identifiers that are let through; `None` if they exceed the filters, so that all are and the task looks.
    pub(crate) wanted: Option<Vec<Identifier>>,
}
