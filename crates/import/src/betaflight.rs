//! A flight controller of Betaflight in, as the dump of its resources (`resource MOTOR 1 A08`) or as
//! its `config.h` (`#define MOTOR1_PIN PA8`); a `.sense` file and the table of the MCU's pins out.

mod dump;
mod header;

use std::collections::BTreeMap;

use sensedsl_board::pin::PinName;
use sensedsl_board::signal::{Function, Signal};
use sensedsl_diagnostics::Span;
use sensedsl_parts::Sheet;

use crate::log::Log;
use crate::project::pads::Wires;
use crate::project::{self, Addressed, Project, Using, Wire, chip, program};
use crate::source::{Source, Texts};

/// What a source says.
#[derive(Debug, Default)]
struct Board {
    name: Option<String>,
    /// The MCU: `STM32F405`, `STM32F7X2`.
    mcu: Option<(String, Span)>,
    resources: Vec<Resource>,
    /// What says which timer a pin is on.
    timers: BTreeMap<PinName, OnTimer>,
    /// The buses of parts, as settings name them: `gyro_1` is on SPI1.
    buses: BTreeMap<String, String>,
    /// Parts on I2C buses.
    addressed: Vec<Addressed>,
}

/// A pin and its use.
#[derive(Debug)]
struct Resource {
    /// The use in the words of a dump: `MOTOR`, `SERIAL_TX`, `GYRO_CS`.
    what: String,
    /// Its number; parts that are there once have 1, or none.
    index: String,
    pin: PinName,
    span: Span,
}

/// How a source tells which of a pin's timers is meant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum OnTimer {
    /// By the alternate function.
    Alternate(u8),
    /// By its place, from 1, among the timers of the pin in the order of their alternate functions.
    Place(usize),
}

/// Whether a text is one of Betaflight's.
pub(crate) fn is_board(text: &str) -> bool {
    dump::is_dump(text) || header::is_header(text)
}

/// Imports a board.
pub(crate) fn import(source: &Source<'_>, log: &mut Log) -> Texts {
    let (file, text) = log.text(source.name, source.bytes);
    let whole = Span::new(file, 0..0);
    if log.has_errors() {
        return Texts::default();
    }
    let board = if header::is_header(&text) {
        header::read(file, &text)
    } else {
        dump::read(file, &text, log)
    };
    if board.resources.is_empty() {
        log.no_pins(whole, "no line says what a pin is for");
        return Texts::default();
    }
    let sheet = board.mcu.as_ref().and_then(|(mcu, _)| chip::widest(mcu));
    let mut wires = Wires::default();
    for resource in &board.resources {
        let using = board.using(resource, sheet.as_ref());
        // A device cannot have the name of a signal.
        let label = (!matches!(using, Using::Signal(_))).then(|| resource.label());
        let pin = resource.pin.clone();
        wires.add(Wire { pin, label, using, pull: None, span: resource.span }, log);
    }
    let stem = source.name.rsplit(['/', '\\']).next().and_then(|name| name.split('.').next());
    let project = Project {
        name: board.name.as_deref().or(stem).unwrap_or_default().to_owned(),
        mcu: board.mcu.as_ref().map(|(mcu, _)| mcu.clone()),
        mcu_span: board.mcu.as_ref().map(|(_, span)| *span),
        wires: wires.into_vec(),
        addressed: board.addressed,
        // The configurator is always at the MCU's own USB device.
        usb_device: true,
        ..Project::default()
    };
    program::made(&project, source, whole, log)
}

impl Resource {
    /// What the pin is called: `MOTOR3`, and `BEEPER` of what is there once.
    fn label(&self) -> String {
        let alone = matches!(self.index.as_str(), "" | "1");
        let numbered = matches!(self.what.as_str(), "MOTOR" | "SERVO" | "PWM" | "LED");
        let index = if alone && !numbered { "" } else { self.index.as_str() };
        format!("{}{index}", self.what)
    }
}

impl Board {
    fn using(&self, resource: &Resource, sheet: Option<&Sheet>) -> Using {
        let index = resource.index.as_str();
        let pin = &resource.pin;
        let signal = |name: String| Using::Signal(name);
        match resource.what.as_str() {
            "MOTOR" | "SERVO" => match self.timer(pin, sheet) {
                Some(timer) => Using::Timer(timer, project::TimerMode::Output),
                None => Using::Pulses,
            },
            "PPM" | "PWM" => match self.timer(pin, sheet) {
                Some(timer) => Using::Timer(timer, project::TimerMode::Capture),
                None => signal(resource.what.clone()),
            },
            "SERIAL_TX" => signal(port(pin, index, "TX", sheet)),
            "SERIAL_RX" => signal(port(pin, index, "RX", sheet)),
            "I2C_SCL" => signal(format!("I2C{index}_SCL")),
            "I2C_SDA" => signal(format!("I2C{index}_SDA")),
            "SPI_SCK" => signal(format!("SPI{index}_SCK")),
            "SPI_MISO" | "SPI_SDI" => signal(format!("SPI{index}_MISO")),
            "SPI_MOSI" | "SPI_SDO" => signal(format!("SPI{index}_MOSI")),
            "LED" | "BEEPER" | "PINIO" | "INVERTER" => Using::Output(false),
            "USB_DETECT" | "SDCARD_DETECT" | "RX_BIND_PLUG" => Using::Input,
            "GYRO_EXTI" => Using::Interrupt("rising"),
            what if what.starts_with("ADC_") => Using::Analog,
            what if what.ends_with("_CS") => Using::Select(self.bus(what, index)),
            // The others, such as a strip of LEDs, are no devices.
            what => signal(what.to_owned()),
        }
    }

    /// The bus of a chip select: of `GYRO_CS 1` that of `gyro_1`.
    fn bus(&self, select: &str, index: &str) -> Option<String> {
        let part = select.strip_suffix("_CS")?.to_ascii_lowercase();
        let part = part.strip_suffix("_spi").unwrap_or(&part);
        let part = if part == "osd" { "max7456" } else { part };
        let numbered = format!("{part}_{}", if index.is_empty() { "1" } else { index });
        self.buses.get(part).or_else(|| self.buses.get(&numbered)).cloned()
    }

    /// The channel of a timer that a pin is on.
    fn timer(&self, pin: &PinName, sheet: Option<&Sheet>) -> Option<String> {
        let (_, usages) = sheet?.pin(pin)?;
        let channel =
            |usage: &str| matches!(Signal::parse(usage).0.function(), Function::Timer { .. });
        let mut channels: Vec<&(String, Option<u8>)> =
            usages.iter().filter(|(usage, _)| channel(usage)).collect();
        channels.sort_by_key(|(_, alternate)| *alternate);
        let found = match self.timers.get(pin)? {
            OnTimer::Alternate(number) => {
                channels.into_iter().find(|(_, alternate)| *alternate == Some(*number))
            }
            OnTimer::Place(place) => channels.into_iter().nth(place.checked_sub(1)?),
        };
        found.map(|(usage, _)| usage.clone())
    }
}

/// The wire of a serial port by its number: USART1, UART4. Above 10 are ports in software.
fn port(pin: &PinName, index: &str, end: &str, sheet: Option<&Sheet>) -> String {
    let usages = sheet.and_then(|sheet| sheet.pin(pin)).map_or(&[][..], |(_, usages)| usages);
    let names = ["USART", "UART", "LPUART"].map(|stem| format!("{stem}{index}_{end}"));
    let is_there = |name: &&String| usages.iter().any(|(usage, _)| usage == *name);
    names.iter().find(is_there).cloned().unwrap_or_else(|| format!("SOFTSERIAL{index}_{end}"))
}
