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
    /// The prefixes of the line's part numbers.
    pub parts: Vec<String>,
    /// The letters of the GPIO ports.
    pub gpio_ports: Vec<char>,
    /// The clock that the kernel takes.
    pub kernel: Kernel,
    /// The cost of the runtime, if it was counted.
    pub costs: Option<Costs>,
    /// Pin interrupts.
    pub exti: Exti,
    /// The pins whose edges can interrupt; `None` if all can.
    pub interrupts: Option<Vec<PinName>>,
    /// What handlers of pin interrupts measure without a timer, if they do.
    pub edges: Option<Edges>,
    /// Pins of the debug port.
    pub debug: Debug,
    /// Timers.
    pub timers: Vec<Timer>,
    /// Blocks of programmable state machines.
    pub pios: Vec<Pio>,
    /// What all analog-digital converters share.
    pub adc: Adcs,
    /// Analog-digital converters.
    pub adcs: Vec<Adc>,
    /// What all I²C units share.
    pub i2c: I2cs,
    /// I²C units.
    pub i2cs: Vec<Unit>,
    /// SPI units.
    pub spis: Vec<Unit>,
    /// How an SPI unit divides its clock, if known.
    pub spi_dividers: Option<Dividers>,
    /// U(S)ARTs with a serial driver.
    pub serials: Vec<Unit>,
    /// How a serial port divides its clock, if known.
    pub serial_dividers: Option<Dividers>,
    /// CAN controllers.
    pub cans: Vec<Unit>,
    /// How a CAN controller divides its clock, if known.
    pub can_dividers: Option<Dividers>,
    /// What all digital-analog converters share, if there are any.
    pub dac: Option<Dacs>,
    /// Digital-analog converters.
    pub dacs: Vec<Dac>,
    /// USB devices.
    pub usbs: Vec<Usb>,
    /// Clocks, in hertz, that the system sets itself, by name; empty if the board's facts have
    /// them.
    pub clocks_hz: BTreeMap<String, u32>,
    /// Facts that only the system's own generator reads.
    pub own: Own,
}

/// Facts that only a system's own generator reads, as the file states them: how the system spells
/// things. The generator defines their format.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Own {
    /// The table `[system]` of the file.
    pub file: toml::Table,
    /// The table `system` of the line.
    pub line: toml::Table,
}

/// The medium that carries frames between board and host.
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
    /// Timers that the kernel can take, best first; it takes the first one that no device uses.
    pub timers: Vec<String>,
    /// What it takes if devices use them all; without a fallback, a wiring leaves it one.
    pub fallback: Option<Fallback>,
    /// The place in the system's source that the facts come from.
    pub source: String,
}

impl Kernel {
    /// The timers of which devices must leave one; empty if they may have them all.
    #[must_use]
    pub fn needed(&self) -> &[String] {
        if self.fallback.is_some() { &[] } else { &self.timers }
    }
}

/// A kernel clock that is not a timer.
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
    /// The number of lines.
    pub lines: u8,
    /// The rule for which pins exclude each other.
    pub rule: ExtiRule,
    /// The place in the system's source that the facts come from.
    pub source: String,
}

/// A rule for which pins exclude each other as interrupt lines.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
pub enum ExtiRule {
    /// Pins with the same number, on any port: PA0 and PB0.
    #[serde(rename = "one port per number")]
    OnePortPerNumber,
    /// No pins: each has its own line.
    #[serde(rename = "one line per pin")]
    OneLinePerPin,
}

/// What handlers of pin interrupts measure: pulses with the framework's clock, quadrature by their own state.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Edges {
    /// The steps of the clock, in nanoseconds.
    pub resolution_ns: u32,
    /// The most edges per second of all wires together that leave half of the processor.
    pub rate_max_hz: u32,
    /// How that was measured.
    pub source: String,
}

/// Pins of the debug port.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Debug {
    /// Pins needed to program the MCU; they are not offered.
    #[serde(deserialize_with = "pins")]
    pub pins: Vec<PinName>,
    /// Pins of trace output; they are offered.
    #[serde(default, deserialize_with = "pins")]
    pub trace: Vec<PinName>,
    /// The place in the system's source that the facts come from.
    pub source: String,
}

/// A timer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Timer {
    /// The name: `TIM3`.
    pub name: String,
    /// Width of the counter.
    pub bits: u8,
    /// The name of its clock, among those of the board's facts.
    pub clock: String,
    /// The usual alternate function of its pins.
    pub alternate: Option<u8>,
    /// What input capture can use; `None` if it cannot measure.
    pub icu: Option<TimerUse>,
    /// What PWM can use.
    pub pwm: Option<TimerUse>,
    /// True if the system serves its interrupt.
    pub interrupt: bool,
    /// True if the hardware can count quadrature on channels 1 and 2.
    pub encoder: bool,
    /// True if an input makes it count, instead of keeping the time of an edge: it gives counts of edges of one
    /// direction, and widths.
    pub gate: bool,
    /// The lowest frequency of its outputs, in hertz; `None` if it makes any.
    pub slowest_hz: Option<u32>,
}

/// A block of programmable state machines, which run one program.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Pio {
    /// The name: `PIO0`.
    pub name: String,
    /// The number of its state machines; a device takes one.
    pub machines: u8,
    /// The name of its clock, among those of the board's facts.
    pub clock: String,
    /// The number of the first pin that it does not reach.
    pub pins_end: u8,
}

impl Pio {
    /// Whether a machine can see the pin, by the number at the end of its name.
    #[must_use]
    pub fn reaches(&self, pin: &PinName) -> bool {
        let name = pin.as_str();
        let number = name.trim_start_matches(|c: char| !c.is_ascii_digit()).parse();
        number.is_ok_and(|number: u8| number < self.pins_end)
    }
}

/// The channels of a timer that a driver can use.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TimerUse {
    /// The usable channels.
    pub channels: Vec<u8>,
    /// The channels with a usable inverted output.
    pub complementary: Vec<u8>,
}

/// What all analog-digital converters share.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Adcs {
    /// The available sampling times, in ascending order.
    pub sample_cycles: Vec<Cycles>,
    /// The default sampling time.
    pub sample_cycles_default: Cycles,
    /// How many different sampling times the inputs of a group can have, if not one each. The last
    /// one also serves inputs that need less.
    pub sampling_times: Option<u8>,
    /// Bits of a result.
    pub resolution_bits: u8,
    /// Inputs in one conversion group.
    pub channels_max: u8,
    /// The name of the converters' clock, if known.
    pub clock: Option<String>,
    /// The divider of that clock.
    #[serde(default = "one")]
    pub clock_divider: u32,
    /// Cycles of a conversion after sampling, if known.
    pub conversion_cycles: Option<Cycles>,
    /// The place in the system's source that the facts come from.
    pub source: String,
}

/// An analog-digital converter.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Adc {
    /// The name: `ADC1`.
    pub name: String,
    /// Inputs that can be pins.
    pub inputs: Vec<u8>,
    /// The driver's DMA requests.
    pub dma: Vec<DmaRequest>,
}

impl Adc {
    /// The number in the name.
    #[must_use]
    pub fn number(&self) -> Option<u8> {
        self.name.strip_prefix("ADC")?.parse().ok()
    }
}

/// What all I²C units share.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct I2cs {
    /// The fastest bus that the driver accepts, in hertz.
    pub speed_max_hz: u32,
    /// The shortest read that the driver accepts, in bytes.
    pub read_bytes_min: u8,
    /// How the driver sets the bus clock; empty if it takes register values.
    #[serde(default)]
    pub modes: Vec<I2cMode>,
    /// How register values set the bus clock, if the driver takes them.
    pub timing: Option<I2cTiming>,
    /// The place in the system's source that the facts come from.
    pub source: String,
}

/// One way in which an I²C driver sets the bus clock: the unit's clock is divided, without
/// remainder, by `clocks` times a whole number.
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
    /// The name: `I2C1`.
    pub name: String,
    /// The name of its clock, if the generated code needs it.
    pub clock: Option<String>,
    /// The usual alternate function of its pins.
    pub alternate: Option<u8>,
    /// Pins with another alternate function.
    pub exceptions: Vec<Exception>,
    /// The driver's DMA requests.
    pub dma: Vec<DmaRequest>,
}

/// A pin whose alternate function differs from the usual one of the unit.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Exception {
    /// The pin.
    #[serde(deserialize_with = "pin")]
    pub pin: PinName,
    /// The number of its alternate function.
    pub alternate: u8,
}

/// What all digital-analog converters share.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Dacs {
    /// Bits of a value.
    pub resolution_bits: u8,
    /// The place in the system's source that the facts come from.
    pub source: String,
}

/// A digital-analog converter.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Dac {
    /// The name: `DAC1`.
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
    /// The name: `OTG1`.
    pub name: String,
    /// The alternate function of its pins.
    pub alternate: Option<u8>,
    /// The data lines: minus, plus.
    pub pins: Vec<PinName>,
    /// The pin that shows whether a host is there.
    pub vbus: Option<PinName>,
    /// Units that cannot work at the same time.
    pub excludes: Vec<String>,
    /// The number of endpoints besides the control endpoint.
    pub endpoints: u8,
    /// The place in the system's source that the facts come from.
    pub source: String,
}

/// A driver's request for a DMA stream of its own.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DmaRequest {
    /// The name: `I2C1_RX`.
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

/// Reads a pin name from a data file.
pub(crate) fn pin<'de, D: Deserializer<'de>>(deserializer: D) -> Result<PinName, D::Error> {
    let text = String::deserialize(deserializer)?;
    PinName::parse(&text).ok_or_else(|| D::Error::custom(format!("`{text}` is no pin")))
}

/// Reads the pin names from a data file.
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

/// Reads pin names that stand in one text, with white space between them.
pub(crate) fn all_pins<'de, D: Deserializer<'de>>(
    deserializer: D,
) -> Result<Option<Vec<PinName>>, D::Error> {
    let text = String::deserialize(deserializer)?;
    let read = |text: &str| {
        PinName::parse(text).ok_or_else(|| D::Error::custom(format!("`{text}` is no pin")))
    };
    text.split_whitespace().map(read).collect::<Result<_, _>>().map(Some)
}
