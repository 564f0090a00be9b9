//! The pins of another tool's project, which is what `.ioc` and `hwdef.dat` share, in; a `.sense`
//! file and the table of those pins out.

use std::collections::{BTreeMap, BTreeSet};

use sensedsl_board::pin::PinName;
use sensedsl_board::table::{Occupation, Onboard};
use sensedsl_diagnostics::Span;

use crate::assemble::{self, Row};
use crate::devices::{self, Device};
use crate::log::Log;
use crate::source::{Source, Texts};

/// A project.
#[derive(Debug, Default)]
pub(crate) struct Project {
    pub(crate) name: String,
    pub(crate) mcu: Option<String>,
    pub(crate) wires: Vec<Wire>,
    /// Bits per second of serial ports.
    pub(crate) bauds: BTreeMap<String, u32>,
    /// Devices on I2C buses with a known address.
    pub(crate) addressed: Vec<Addressed>,
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
            Self::Input | Self::Output(_) | Self::Interrupt(_) | Self::Select(_) => None,
        }
    }
}

/// Writes a project as a `.sense` file and its table.
pub(crate) fn made(project: &Project, source: &Source<'_>, whole: Span, log: &mut Log) -> Texts {
    let devices = devices::infer(project, log);
    let used: BTreeSet<&PinName> = devices.iter().flat_map(|device| &device.pins).collect();
    let mut rows = Vec::new();
    for wire in &project.wires {
        let mut row = Row::new(wire.pin.clone());
        row.pin.label.clone_from(&wire.label);
        let signal = wire.using.signal();
        if used.contains(&wire.pin) {
            row.usages.extend(signal.map(|signal| (signal.to_owned(), None)));
        } else {
            let part = wire.label.as_deref().or(signal).unwrap_or("in use").replace(':', " ");
            row.pin.onboard = Some(Onboard { part, how: Occupation::Taken });
            row.pin.note = signal.map(str::to_owned);
        }
        rows.push(row);
    }
    let mcu = project.mcu.iter().map(|mcu| ("mcu", mcu.clone())).collect::<Vec<_>>();
    let Some(table) = assemble::table(&mcu, rows, whole, log) else { return Texts::default() };
    let table = table.to_csv();
    let program = program(project, &devices, source.table);
    Texts { table: Some(table), program: Some(program) }
}

/// The text of the `.sense` file.
fn program(project: &Project, devices: &[Device], table: &str) -> String {
    let name = identifier(&project.name).unwrap_or_else(|| "Board".into());
    let mut text = format!("// The pins of {}, as they were.\n", one_line(&project.name));
    let table = table.replace(['"', '\\', '\n'], "_");
    text.push_str(&format!("board {name} on \"{table}\" {{\n"));
    for device in devices {
        let sign = if device.open { "    // " } else { "    " };
        let mut line = |line: &str| text.push_str(&format!("{sign}{line}\n"));
        line(&format!("{} {{", device.head));
        for property in &device.properties {
            line(&format!("    {property}"));
        }
        line("}");
    }
    text.push_str("}\n");
    text
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
