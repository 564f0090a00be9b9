//! The pins of a project in; its link to the host out.

use std::collections::BTreeSet;

use sensedsl_board::pin::PinName;
use sensedsl_board::profile::Usb;
use sensedsl_board::signal::{Function, Signal, UartLine};
use sensedsl_diagnostics::Span;

use super::Project;
use super::chip::{Chip, unit_of};
use crate::log::Log;

/// Words in the label of a serial port that goes to the developer's computer.
const CONSOLE_WORDS: [&str; 9] =
    ["VCP", "VCOM", "STLINK", "STLK", "ST-LINK", "CONSOLE", "DEBUG", "DBG", "SHELL"];
/// The labels that ST's Nucleo boards have on the wires to their debug probe.
const PROBE_LABELS: [&str; 2] = ["USART_TX", "USART_RX"];

/// How a board talks to its host.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Link {
    /// The USB device; `false` if nothing is on the pin that shows the host's supply.
    Usb { vbus: bool },
    /// The project's console.
    Uart { unit: String, baud: Option<u32> },
    /// Any free serial port.
    Free,
    /// Nothing is left for a link.
    None,
}

impl Link {
    /// The lines of its block.
    pub(crate) fn lines(&self) -> Vec<String> {
        match self {
            Self::Usb { vbus } => {
                let vbus = (!vbus).then(|| "vbus = false;".to_owned());
                ["transport = usb;".to_owned()].into_iter().chain(vbus).collect()
            }
            Self::Uart { unit, baud } => {
                let baud = baud.map(|baud| format!("baud = {baud};"));
                let lines = ["transport = uart;".to_owned(), format!("unit = {unit};")];
                lines.into_iter().chain(baud).collect()
            }
            Self::Free => vec!["transport = uart;".to_owned()],
            Self::None => vec!["transport = none;".to_owned()],
        }
    }

    /// The serial port that it takes, if the project says which.
    pub(crate) fn unit(&self) -> Option<&str> {
        match self {
            Self::Uart { unit, .. } => Some(unit),
            Self::Usb { .. } | Self::Free | Self::None => None,
        }
    }
}

/// The link of a project; none if what the tool does by itself is right: without a target there is
/// no link, and a USB device or a serial port that nothing else needs is taken.
pub(crate) fn of(project: &Project, chip: &Chip, whole: Span, log: &mut Log) -> Option<Link> {
    let profile = chip.profile.as_ref()?;
    let usb = profile.usb(None);
    let pins: BTreeSet<&PinName> = project.wires.iter().map(|wire| &wire.pin).collect();
    let vbus = usb.and_then(|usb| usb.vbus.as_ref());
    let free = |usb: &Usb| !usb.pins.iter().any(|pin| pins.contains(pin));
    if usb.is_some_and(|usb| is_device(project, &usb.pins) || project.usb_device && free(usb)) {
        let is_wired = |pin: &PinName| {
            let mut wires = project.wires.iter().filter(|wire| wire.pin == *pin);
            wires.any(|wire| wire.using.signal().is_some_and(|signal| signal.contains("VBUS")))
        };
        return Some(Link::Usb { vbus: vbus.is_none_or(is_wired) });
    }
    if let Some(unit) = console(project, chip) {
        let baud = project.bauds.get(&unit).copied().filter(|baud| *baud != 115_200);
        let baud = baud.filter(|baud| (1_200..=10_000_000).contains(baud));
        return Some(Link::Uart { unit, baud });
    }
    let units = project.wires.iter().filter_map(|wire| unit_of(wire.using.signal()?)).collect();
    let taken = |usb: &Usb| usb.pins.iter().chain(vbus).any(|pin| pins.contains(pin));
    let has_port = chip.free_serial(&pins, &units);
    match (usb.map(taken), has_port) {
        (Some(false), _) | (None, true) => None,
        (Some(true), true) => {
            let what = "the project does not say how the board talks to a host: `link` takes a \
                        serial port that is free";
            log.doubtful(whole, "", what);
            Some(Link::Free)
        }
        (Some(true) | None, false) => {
            let what = "no USB device and no serial port is left for a link to a host: `link` \
                        takes none, and firmware needs one";
            log.doubtful(whole, "", what);
            Some(Link::None)
        }
    }
}

/// Whether the project uses the pins of the USB device as such.
fn is_device(project: &Project, pins: &[PinName]) -> bool {
    let usb = |pin: &PinName| {
        let mut wires = project.wires.iter().filter(|wire| wire.pin == *pin);
        let is_usb = |signal: &str| signal.starts_with("USB") || signal.starts_with("OTG");
        wires.any(|wire| wire.using.signal().is_some_and(is_usb))
    };
    !project.usb_host && !pins.is_empty() && pins.iter().all(usb)
}

/// The serial port that is plainly the console, with both wires and a driver.
fn console(project: &Project, chip: &Chip) -> Option<String> {
    let profile = chip.profile.as_ref()?;
    let known = |unit: &str| profile.serials.iter().any(|one| one.name == unit);
    let ends: BTreeSet<(String, bool)> = project
        .wires
        .iter()
        .filter_map(|wire| end(wire).map(|(unit, line)| (unit, line == UartLine::Tx)))
        .collect();
    let has = |unit: &str, is_tx: bool| ends.contains(&(unit.to_owned(), is_tx));
    let is_whole = |unit: &str| known(unit) && has(unit, true) && has(unit, false);
    let stated = project.console.clone();
    let by_label = || {
        let said = project.wires.iter().filter(|wire| is_console(wire.label.as_deref()));
        said.filter_map(end).map(|(unit, _)| unit).find(|unit| is_whole(unit))
    };
    stated.filter(|unit| is_whole(unit)).or_else(by_label)
}

/// The serial port of a wire, and which of its ends the wire is.
fn end(wire: &super::Wire) -> Option<(String, UartLine)> {
    let (signal, _) = Signal::parse(wire.using.signal()?);
    let Function::Uart { unit, line } = signal.function() else { return None };
    Some((unit.as_str().to_owned(), *line))
}

fn is_console(label: Option<&str>) -> bool {
    let label = label.unwrap_or_default().to_ascii_uppercase();
    let first = label.split(['[', ' ']).next().unwrap_or_default();
    PROBE_LABELS.contains(&first) || CONSOLE_WORDS.iter().any(|word| label.contains(word))
}
