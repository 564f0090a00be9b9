//! The pins of another tool's project, which is what `.ioc`, `hwdef.dat` and their like share, in;
//! a `.sense` file, and the table of all pins of the project's MCU, out.

pub(crate) mod chip;
mod link;
pub(crate) mod pads;
mod table;

use std::collections::{BTreeMap, BTreeSet};

use sensedsl_board::pin::PinName;
use sensedsl_diagnostics::Span;

use self::chip::Chip;
use self::link::Link;
use crate::assemble;
use crate::devices::{self, Inferred};
use crate::log::Log;
use crate::source::{Source, Texts};

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

/// Writes a project as a `.sense` file and its table.
pub(crate) fn made(project: &Project, source: &Source<'_>, whole: Span, log: &mut Log) -> Texts {
    let chip = Chip::of(project, whole, log);
    let project = &chip.as_it_has_them(project);
    let link = link::of(project, &chip, whole, log);
    let linked = link.as_ref().and_then(Link::unit);
    let inferred = devices::infer(project, &chip, linked, log);
    let rows = table::rows(project, &chip, &inferred, linked);
    let mcu = chip.mcu.iter().map(|mcu| ("mcu", mcu.clone()));
    let package = chip.package.iter().map(|package| ("package", (*package).to_owned()));
    let properties: Vec<_> = mcu.chain(package).collect();
    let Some(table) = assemble::table(&properties, rows, whole, log) else {
        return Texts::default();
    };
    let rules = Rules::of(project, &chip, &inferred, linked);
    let program = program(project, &inferred, (link.as_ref(), &rules), source.table);
    Texts { table: Some(table.to_csv()), program: Some(program) }
}

/// The rules of the board.
struct Rules {
    /// Pins that devices are on although the MCU needs them for itself, by what it needs them for.
    release: BTreeMap<&'static str, Vec<String>>,
    /// Units that the project uses for something that is not a device.
    reserve: Vec<String>,
}

impl Rules {
    fn of(project: &Project, chip: &Chip, inferred: &Inferred, linked: Option<&str>) -> Self {
        let standing = inferred.devices.iter().filter(|device| !device.open);
        let used: BTreeSet<&PinName> = standing.flat_map(|device| &device.pins).collect();
        let is_linked = |wire: &&Wire| {
            let unit = wire.using.signal().and_then(chip::unit_of);
            unit.is_some() && unit.as_deref() == linked
        };
        let of_link: BTreeSet<&PinName> =
            project.wires.iter().filter(is_linked).map(|wire| &wire.pin).collect();
        let pins = project.wires.iter().map(|wire| &wire.pin);
        let mut release: BTreeMap<&'static str, Vec<String>> = BTreeMap::new();
        for pin in pins.filter(|pin| used.contains(pin) || of_link.contains(pin)) {
            if let Some(role) = chip.needed_for(pin) {
                release.entry(role.describe()).or_default().push(pin.to_string());
            }
        }
        let is_free = |unit: &&String| chip.offers(unit) && Some(unit.as_str()) != linked;
        Self { release, reserve: inferred.reserved.iter().filter(is_free).cloned().collect() }
    }

    /// The statements, each with a comment that says why.
    fn lines(&self) -> Vec<String> {
        let release = self
            .release
            .iter()
            .map(|(role, pins)| format!("release {}; // otherwise for {role}", pins.join(", ")));
        let reserve = (!self.reserve.is_empty()).then(|| {
            format!("reserve {}; // in use for what is not a device", self.reserve.join(", "))
        });
        release.chain(reserve).collect()
    }
}

/// The text of the `.sense` file.
fn program(
    project: &Project,
    inferred: &Inferred,
    (link, rules): (Option<&Link>, &Rules),
    table: &str,
) -> String {
    let name = identifier(&project.name).unwrap_or_else(|| "Board".into());
    let mut text = format!("// The pins of {}, as they were.\n", one_line(&project.name));
    let table = table.replace(['"', '\\', '\n'], "_");
    text.push_str(&format!("board {name} on \"{table}\" {{\n"));
    if let Some(link) = link {
        let lines = link.lines().into_iter().map(|line| format!("        {line}\n"));
        text.push_str(&format!("    link {{\n{}    }}\n", lines.collect::<String>()));
    }
    for line in rules.lines() {
        text.push_str(&format!("    {line}\n"));
    }
    for device in &inferred.devices {
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
