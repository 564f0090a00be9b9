//! The pins of another tool's project, which is what `.ioc`, `hwdef.dat` and their like come to. The
//! files beside this one make a `.sense` file of it, and the table of all pins of its MCU.

pub(crate) mod chip;
mod link;
pub(crate) mod pads;
pub(crate) mod program;
mod table;

use std::collections::BTreeMap;

use sensedsl_board::pin::PinName;
use sensedsl_diagnostics::Span;

/// A project.
#[derive(Clone, Debug, Default)]
pub(crate) struct Project {
    pub(crate) name: String,
    pub(crate) mcu: Option<String>,
    /// Where the source names the MCU.
    pub(crate) mcu_span: Option<Span>,
    /// The flash of the MCU, where only the line of MCUs is named.
    pub(crate) flash_bytes: Option<usize>,
    pub(crate) wires: Vec<Wire>,
    /// Bits per second of serial ports.
    pub(crate) bauds: BTreeMap<String, u32>,
    /// Devices on I2C buses with a known address.
    pub(crate) addressed: Vec<Addressed>,
    /// The serial port that is the console.
    pub(crate) console: Option<String>,
    /// Whether the MCU is the host on its USB pins.
    pub(crate) usb_host: bool,
    /// Whether the host is at the MCU's USB device, which no pin of the project has to say.
    pub(crate) usb_device: bool,
    /// What is printed beside pins that the project does not use.
    pub(crate) labels: BTreeMap<PinName, String>,
    /// Whether pins that have no label and no use are on no connector.
    pub(crate) is_list: bool,
}

/// A pin that is used.
#[derive(Clone, Debug)]
pub(crate) struct Wire {
    pub(crate) pin: PinName,
    pub(crate) label: Option<String>,
    pub(crate) using: Using,
    /// The resistor inside the MCU: `up` or `down`.
    pub(crate) pull: Option<&'static str>,
    pub(crate) span: Span,
}

/// The use of a pin.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Using {
    Input,
    /// An output, with its level at the start.
    Output(bool),
    /// An interrupt, with its edge: `rising`, `falling`, `both`.
    Interrupt(&'static str),
    /// An input of some converter.
    Analog,
    /// Pulses out of some timer.
    Pulses,
    /// The chip select of an SPI unit, with the unit if it is known.
    Select(Option<String>),
    Timer(String, TimerMode),
    /// A signal whose name is sufficient.
    Signal(String),
}

/// The use of a timer for a pin.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum TimerMode {
    Capture,
    Encoder,
    Output,
    Unknown,
}

/// A device on an I2C bus.
#[derive(Clone, Debug)]
pub(crate) struct Addressed {
    pub(crate) name: String,
    /// The unit: `I2C1`.
    pub(crate) unit: String,
    /// Its address, in 7-bit form.
    pub(crate) address: u8,
    pub(crate) span: Span,
}

impl Using {
    /// The signal of a peripheral.
    pub(crate) fn signal(&self) -> Option<&str> {
        match self {
            Self::Timer(signal, _) | Self::Signal(signal) => Some(signal),
            Self::Input
            | Self::Output(_)
            | Self::Interrupt(_)
            | Self::Analog
            | Self::Pulses
            | Self::Select(_) => None,
        }
    }
}

/// A text as a one-line comment.
pub(crate) fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// A name in the syntax of the language, made from a label.
pub(crate) fn identifier(label: &str) -> Option<String> {
    let label = label.split(['[', '(']).next().unwrap_or_default();
    let mut name = String::new();
    for c in label.trim().chars() {
        if c.is_ascii_alphanumeric() {
            name.push(c);
        } else if !name.ends_with('_') {
            name.push('_');
        }
    }
    let name: String = name.trim_matches('_').chars().take(40).collect();
    let first = name.chars().next()?;
    Some(if first.is_ascii_alphabetic() { name } else { format!("N{name}") })
}
