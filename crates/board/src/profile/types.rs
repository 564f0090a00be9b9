//! The facts of a target profile: what silicon and system can do.

use std::collections::BTreeMap;
use std::fmt;

use serde::de::Error as _;
use serde::{Deserialize, Deserializer};

use super::rates::{Costs, Cycles, Dividers, I2cTiming, one};
use crate::pin::PinName;

/// What an operating system can do on one MCU.
#[derive(Clone, Debug, PartialEq)]
pub struct TargetProfile {
    /// The full name of the target: `chibios-21.11`.
    pub name: String,
    /// The MCU family: `STM32F4`.
    pub family: String,
    /// The line of the family.
    pub line: String,
    /// The starts of the part numbers of the line.
    pub parts: Vec<String>,
    /// Letters of the GPIO ports.
    pub gpio_ports: Vec<char>,
    /// What the kernel takes.
    pub kernel: Kernel,
    /// What the runtime costs the processor, where it was counted.
    pub costs: Option<Costs>,
    /// Pin interrupts.
    pub exti: Exti,
    /// Pins of the debug port.
    pub debug: Debug,
    /// Timers.
    pub timers: Vec<Timer>,
    /// What all converters have in common.
    pub adc: Adcs,
    /// Analog-digital converters.
    pub adcs: Vec<Adc>,
    /// What all I²C units have in common.
    pub i2c: I2cs,
    /// I²C units.
    pub i2cs: Vec<Unit>,
    /// SPI units.
    pub spis: Vec<Unit>,
    /// How an SPI unit divides its clock, where it is known.
    pub spi_dividers: Option<Dividers>,
    /// U(S)ARTs with a serial driver.
    pub serials: Vec<Unit>,
    /// How a serial port divides its clock, where it is known.
    pub serial_dividers: Option<Dividers>,
    /// CAN controllers.
    pub cans: Vec<Unit>,
    /// How a CAN controller divides its clock, where it is known.
    pub can_dividers: Option<Dividers>,
    /// What all digital-analog converters have in common, where there are any.
    pub dac: Option<Dacs>,
    /// Digital-analog converters.
    pub dacs: Vec<Dac>,
    /// USB devices.
    pub usbs: Vec<Usb>,
    /// Clocks in hertz that the system makes by itself, by name; empty where a board's facts have them.
    pub clocks_hz: BTreeMap<String, u32>,
    /// What only the system's own generator reads.
    pub own: Own,
}

/// What only a system's own generator reads, as the file states it: how the system spells things. Its form
/// is the generator's.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Own {
    /// `[system]` of the file.
    pub file: toml::Table,
    /// `system` of the line.
    pub line: toml::Table,
}

/// What carries frames between board and host.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Transport {
    /// The MCU's own USB device, seen as a serial port.
    Usb,
    /// A serial port of the MCU, often behind the board's debug probe.
    Uart,
}

/// The kernel's clock.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Kernel {
    /// Timers it can take, best first; the first that no device has is taken.
    pub timers: Vec<String>,
    /// What it takes when they are all gone; without one the last timer is not offered.
    pub fallback: Option<Fallback>,
    /// Where in the system's source the facts were read.
    pub source: String,
}

/// A clock of the kernel that is no timer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Fallback {
    /// The core's own tick.
    Systick,
}

/// Pin interrupts.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Exti {
    /// Number of lines.
    pub lines: u8,
    /// Which pins exclude each other.
    pub rule: ExtiRule,
    /// Where in the system's source the facts were read.
    pub source: String,
}

/// Which pins exclude each other as interrupt lines.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
pub enum ExtiRule {
    /// Pins of the same number, whatever their port: PA0 and PB0.
    #[serde(rename = "one port per number")]
    OnePortPerNumber,
    /// None: every pin has a line of its own.
    #[serde(rename = "one line per pin")]
    OneLinePerPin,
}

/// Pins of the debug port.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Debug {
    /// Pins without which the MCU cannot be programmed; they are not offered.
    #[serde(deserialize_with = "pins")]
    pub pins: Vec<PinName>,
    /// Pins of trace output; they are offered.
    #[serde(default, deserialize_with = "pins")]
    pub trace: Vec<PinName>,
    /// Where in the system's source the facts were read.
    pub source: String,
}

/// A timer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Timer {
    /// `TIM3`.
    pub name: String,
    /// Width of the counter.
    pub bits: u8,
    /// The name of the clock that drives it, among those of the board's facts.
    pub clock: String,
    /// The usual alternate function of its pins.
    pub alternate: Option<u8>,
    /// What input capture can use; `None` where it cannot measure.
    pub icu: Option<TimerUse>,
    /// What pulses can use.
    pub pwm: Option<TimerUse>,
    /// The hardware can count quadrature on channels 1 and 2.
    pub encoder: bool,
}

/// What a driver can use of a timer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TimerUse {
    /// The channels it can use.
    pub channels: Vec<u8>,
    /// The channels whose inverted output it can use.
    pub complementary: Vec<u8>,
}

/// What all converters have in common.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Adcs {
    /// Sampling times there are, ascending.
    pub sample_cycles: Vec<Cycles>,
    /// The one that is taken when nothing is said.
    pub sample_cycles_default: Cycles,
    /// How many different sampling times the inputs of one group can have, where it is not one each. The last one
    /// serves whoever asks for that or less.
    pub sampling_times: Option<u8>,
    /// Bits of a result.
    pub resolution_bits: u8,
    /// Inputs in one conversion group.
    pub channels_max: u8,
    /// The name of the clock that drives the converters, where it is known.
    pub clock: Option<String>,
    /// What that clock is divided by.
    #[serde(default = "one")]
    pub clock_divider: u32,
    /// Cycles of a conversion behind those of sampling, where they are known.
    pub conversion_cycles: Option<Cycles>,
    /// Where in the system's source the facts were read.
    pub source: String,
}

/// An analog-digital converter.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Adc {
    /// `ADC1`.
    pub name: String,
    /// Inputs that can be pins.
    pub inputs: Vec<u8>,
    /// DMA requests of the driver.
    pub dma: Vec<DmaRequest>,
}

impl Adc {
    /// The number in the name.
    #[must_use]
    pub fn number(&self) -> Option<u8> {
        self.name.strip_prefix("ADC")?.parse().ok()
    }
}

/// What all I²C units have in common.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct I2cs {
    /// The fastest bus the driver accepts.
    pub speed_max_hz: u32,
    /// The shortest read the driver accepts.
    pub read_bytes_min: u8,
    /// How the driver makes the bus clock; empty where it is told register values.
    #[serde(default)]
    pub modes: Vec<I2cMode>,
    /// How register values make the bus clock, where the driver is told them.
    pub timing: Option<I2cTiming>,
    /// Where in the system's source the facts were read.
    pub source: String,
}

/// One way in which an I²C driver makes the bus clock: the unit's clock, divided by `clocks` times
/// a whole number, with nothing left over.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct I2cMode {
    /// The driver's word for the duty cycle.
    pub duty: String,
    /// The slowest and the fastest bus of this mode.
    pub speeds_hz: [u32; 2],
    /// Steps of the divider in one bus clock.
    pub clocks: u32,
    /// The least and the greatest divider.
    pub dividers: [u32; 2],
}

/// A unit with one driver: I²C, SPI, serial, CAN.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unit {
    /// `I2C1`.
    pub name: String,
    /// The name of the clock that drives it, where the generated code must know.
    pub clock: Option<String>,
    /// The usual alternate function of its pins.
    pub alternate: Option<u8>,
    /// Pins with another alternate function.
    pub exceptions: Vec<Exception>,
    /// DMA requests of the driver.
    pub dma: Vec<DmaRequest>,
}

/// A pin whose alternate function is not the usual one of the unit.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Exception {
    /// The pin.
    #[serde(deserialize_with = "pin")]
    pub pin: PinName,
    /// The number.
    pub alternate: u8,
}

/// What all digital-analog converters have in common.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Dacs {
    /// Bits of a value.
    pub resolution_bits: u8,
    /// Where in the system's source the facts were read.
    pub source: String,
}

/// A digital-analog converter.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Dac {
    /// `DAC1`.
    pub name: String,
    /// Its outputs.
    pub outputs: Vec<DacOutput>,
}

/// An output of a digital-analog converter.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DacOutput {
    /// The output's number.
    pub channel: u8,
}

/// A USB device.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Usb {
    /// `OTG1`.
    pub name: String,
    /// The alternate function of its pins.
    pub alternate: Option<u8>,
    /// The data lines: minus, plus.
    pub pins: Vec<PinName>,
    /// The pin by which it is told that a host is there.
    pub vbus: Option<PinName>,
    /// Units that cannot work beside it.
    pub excludes: Vec<String>,
    /// Endpoints beside the control endpoint.
    pub endpoints: u8,
    /// Where in the system's source the facts were read.
    pub source: String,
}

/// A request of a driver for a DMA stream of its own.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DmaRequest {
    /// `I2C1_RX`.
    pub name: String,
    /// Streams that can serve it, best first.
    pub streams: Vec<Stream>,
}

/// A DMA stream (or channel): `1,0` is stream 0 of controller 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Stream {
    /// The controller's number.
    pub controller: u8,
    /// The stream's number in its controller.
    pub stream: u8,
}

impl fmt::Display for Stream {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{},{}", self.controller, self.stream)
    }
}

impl<'de> Deserialize<'de> for Stream {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let text = String::deserialize(deserializer)?;
        let pair = text.split_once(',').and_then(|(controller, stream)| {
            Some(Self { controller: controller.parse().ok()?, stream: stream.parse().ok()? })
        });
        pair.ok_or_else(|| D::Error::custom(format!("`{text}` is no DMA stream")))
    }
}

/// Reads a pin name of a data file.
pub(crate) fn pin<'de, D: Deserializer<'de>>(deserializer: D) -> Result<PinName, D::Error> {
    let text = String::deserialize(deserializer)?;
    PinName::parse(&text).ok_or_else(|| D::Error::custom(format!("`{text}` is no pin")))
}

/// Reads the pin names of a data file.
pub(crate) fn pins<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<PinName>, D::Error> {
    let texts = Vec::<String>::deserialize(deserializer)?;
    let read = |text: &String| {
        PinName::parse(text).ok_or_else(|| D::Error::custom(format!("`{text}` is no pin")))
    };
    texts.iter().map(read).collect()
}

/// Reads a pin name that may be absent.
pub(crate) fn optional_pin<'de, D: Deserializer<'de>>(
    deserializer: D,
) -> Result<Option<PinName>, D::Error> {
    pin(deserializer).map(Some)
}
