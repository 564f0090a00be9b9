//! The wiring in types: one line of Rust for each wire, which the compiler takes only if the HAL knows that wire.
//!
//! In: a [`BoardJob`] of any target, and the HAL's names for its MCU. Out: a crate that is checked on the host and does
//! nothing, and for each of its lines the device that it is of. The HAL's traits are made from ST's data by other
//! people, so what they refuse is a mistake of theirs or of ours.

use std::collections::{BTreeMap, BTreeSet};

use askama::Template;
use sensedsl_board::profile::{self, Target, TargetProfile};
use sensedsl_board::signal::{CanLine, Function, I2cLine, SpiLine, TimerLine, UartLine, UnitName};
use sensedsl_diagnostics::Span;
use sensedsl_model::design::Transport;
use sensedsl_model::kind::{Kind, KindName};

use super::hal::Hal;
use super::names::Names;
use super::{cargo, moved, rp};
use sensedsl_files::{FileSet, print};
use sensedsl_job::{BoardJob, JobConnection, Pad};

/// The crate on `embassy-stm32`.
#[derive(Template)]
#[template(path = "templates/stm32/wiring_check.rs.txt", escape = "none")]
struct Stm32Check<'a> {
    calls: &'a [(&'static str, String)],
    lines: &'a [String],
}

/// The crate on `embassy-rp`.
#[derive(Template)]
#[template(path = "templates/rp/wiring_check.rs.txt", escape = "none")]
struct RpCheck<'a> {
    calls: &'a [(&'static str, String)],
    lines: &'a [String],
}

/// The functions that the lines call. Only those in use are printed, because a chip has not all modules. `{A}` is the
/// parameter for the block of pins, which one family has.
const CALLS: &[(&str, &str)] = &[
    (
        "analog",
        "<T: hal::adc::Instance, P: PeripheralType>(_: Peri<'static, P>) where Peri<'static, P>: hal::adc::AdcChannel<T>",
    ),
    ("adc_dma", "<T: hal::adc::Instance, D: hal::adc::RxDma<T>>(_: Peri<'static, D>)"),
    (
        "dac_out",
        "<T: hal::dac::Instance, C: hal::dac::Channel, P: hal::dac::DacPin<T, C>>(_: Peri<'static, P>)",
    ),
    ("scl", "<T: hal::i2c::Instance{A}, P: hal::i2c::SclPin<T{A}>>(_: Peri<'static, P>)"),
    ("sda", "<T: hal::i2c::Instance{A}, P: hal::i2c::SdaPin<T{A}>>(_: Peri<'static, P>)"),
    ("i2c_rx", "<T: hal::i2c::Instance, D: hal::i2c::RxDma<T>>(_: Peri<'static, D>)"),
    ("i2c_tx", "<T: hal::i2c::Instance, D: hal::i2c::TxDma<T>>(_: Peri<'static, D>)"),
    ("sck", "<T: hal::spi::Instance{A}, P: hal::spi::SckPin<T{A}>>(_: Peri<'static, P>)"),
    ("miso", "<T: hal::spi::Instance{A}, P: hal::spi::MisoPin<T{A}>>(_: Peri<'static, P>)"),
    ("mosi", "<T: hal::spi::Instance{A}, P: hal::spi::MosiPin<T{A}>>(_: Peri<'static, P>)"),
    ("spi_rx", "<T: hal::spi::Instance, D: hal::spi::RxDma<T>>(_: Peri<'static, D>)"),
    ("spi_tx", "<T: hal::spi::Instance, D: hal::spi::TxDma<T>>(_: Peri<'static, D>)"),
    ("uart_tx", "<T: hal::usart::Instance{A}, P: hal::usart::TxPin<T{A}>>(_: Peri<'static, P>)"),
    ("uart_rx", "<T: hal::usart::Instance{A}, P: hal::usart::RxPin<T{A}>>(_: Peri<'static, P>)"),
    ("can_tx", "<T: hal::can::Instance{A}, P: hal::can::TxPin<T{A}>>(_: Peri<'static, P>)"),
    ("can_rx", "<T: hal::can::Instance{A}, P: hal::can::RxPin<T{A}>>(_: Peri<'static, P>)"),
    (
        "channel",
        "<T: hal::timer::GeneralInstance4Channel, C: hal::timer::TimerChannel{A}, P: hal::timer::TimerPin<T, C{A}>>(_: Peri<'static, P>)",
    ),
    (
        "inverted",
        "<T: hal::timer::AdvancedInstance4Channel, C: hal::timer::TimerChannel{A}, P: hal::timer::TimerComplementaryPin<T, C{A}>>(_: Peri<'static, P>)",
    ),
    ("usb_dm", "<T: hal::usb::Instance, P: hal::usb::DmPin<T>>(_: Peri<'static, P>)"),
    ("usb_dp", "<T: hal::usb::Instance, P: hal::usb::DpPin<T>>(_: Peri<'static, P>)"),
];

/// A crate whose compilation judges the wiring of one board.
#[derive(Clone, Debug)]
pub struct TypeCheck {
    /// The HAL's feature for the chip, which crates of one chip share a folder by.
    pub chip: String,
    /// Its files.
    pub files: FileSet,
    /// What each line of `src/lib.rs` is of, by its number from 1.
    pub lines: BTreeMap<usize, Judged>,
    /// Wires that the HAL has no types for, for people.
    pub unjudged: Vec<String>,
}

/// What a line of the check is of.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Judged {
    /// Where it is in the file: the name of the device or the board.
    pub span: Span,
    /// For people: `IRFront at PB0 (ADC12-IN8)`.
    pub what: String,
}

/// The profile of Embassy for the MCU of a board, whatever the board's own target is.
#[must_use]
pub fn profile_of(mcu: &str) -> Option<TargetProfile> {
    let Ok(Target::Profile(profile)) = profile::find("embassy", mcu) else { return None };
    Some(*profile)
}

/// The check of a board's wiring.
///
/// # Errors
///
/// Why there is none, in words that follow a colon.
pub fn type_check(job: &BoardJob<'_>) -> Result<TypeCheck, String> {
    let mcu = job.board.mcu.as_deref().ok_or("its table does not say which MCU it describes")?;
    let profile = profile_of(mcu).ok_or_else(|| format!("Embassy does not know {mcu}"))?;
    let names = Names::of(&profile)?;
    let chip = names.chip(mcu).ok_or_else(|| format!("Embassy does not know {mcu}"))?;
    let kernel = match names.hal {
        Hal::Stm32 => super::clock::timer(job, &profile),
        Hal::Rp => None,
    };
    let mut lines = Lines::new(&profile, &names, job);
    lines.units();
    for connection in &job.connections {
        lines.connection(connection);
    }
    lines.link();
    let (text, known) = print_check(&names, lines.all);
    let mut files = FileSet::default();
    match names.hal {
        Hal::Stm32 => {
            files.add("Cargo.toml", cargo::check_manifest(job, &chip, kernel.as_deref()));
            files.add("Cargo.lock", cargo::check_lock(&chip, kernel.as_deref()));
        }
        Hal::Rp => {
            files.add("Cargo.toml", cargo::check_manifest_rp(&chip));
            files.add("Cargo.lock", cargo::check_lock_rp());
            if names.target.starts_with("thumbv8m") {
                files.add(".cargo/config.toml", rp::typed::CONFIG);
            }
        }
    }
    files.add("src/lib.rs", text);
    Ok(TypeCheck { chip: chip.feature, files, lines: known, unjudged: lines.unjudged })
}

/// The crate, and what each line of it is of.
fn print_check(names: &Names, lines: Vec<(String, Judged)>) -> (String, BTreeMap<usize, Judged>) {
    let parameter = if names.afio { ", A" } else { "" };
    let signatures = match names.hal {
        Hal::Stm32 => CALLS,
        Hal::Rp => rp::typed::CALLS,
    };
    let is_called = |name: &str| {
        lines.iter().any(|(code, _)| code.split_once("::").is_some_and(|(call, _)| call == name))
    };
    let calls: Vec<(&str, String)> = signatures
        .iter()
        .filter(|(name, _)| is_called(name))
        .map(|(name, signature)| (*name, signature.replace("{A}", parameter)))
        .collect();
    let (code, judged): (Vec<String>, Vec<Judged>) = lines.into_iter().unzip();
    let text = match names.hal {
        Hal::Stm32 => print(&Stm32Check { calls: &calls, lines: &code }),
        Hal::Rp => print(&RpCheck { calls: &calls, lines: &code }),
    };
    // They are the last lines of the crate, but for a brace.
    let first = text.lines().count() - code.len();
    (text, (first..).zip(judged).collect())
}

/// Lines in the making.
struct Lines<'a> {
    profile: &'a TargetProfile,
    names: &'a Names,
    job: &'a BoardJob<'a>,
    /// The block of pins of each unit.
    blocks: BTreeMap<UnitName, u8>,
    all: Vec<(String, Judged)>,
    unjudged: Vec<String>,
}

impl<'a> Lines<'a> {
    fn new(profile: &'a TargetProfile, names: &'a Names, job: &'a BoardJob<'a>) -> Self {
        let blocks = moved::blocks(job);
        Self { profile, names, job, blocks, all: Vec::new(), unjudged: Vec::new() }
    }

    fn push(&mut self, code: String, judged: &Judged) {
        self.all.push((code, judged.clone()));
    }

    /// A unit is taken once, whoever shares it; the clock's timer cannot be taken.
    fn units(&mut self) {
        let mut seen = BTreeSet::new();
        for connection in &self.job.connections {
            let Some(unit) = connection.unit.filter(|unit| seen.insert((*unit).to_owned())) else {
                continue;
            };
            if self.knows(unit) {
                let judged = of_connection(connection);
                self.push(format!("unit(p.{});", self.names.peripheral(unit)), &judged);
            }
        }
    }

    /// Whether the HAL has a driver for a unit.
    fn knows(&self, unit: &str) -> bool {
        let profile = self.profile;
        let unit = if unit == "CAN" { "CAN1" } else { unit };
        let mut names = (profile.adcs.iter().map(|one| &one.name))
            .chain(profile.timers.iter().map(|one| &one.name))
            .chain(profile.dacs.iter().map(|one| &one.name))
            .chain(profile.usbs.iter().map(|one| &one.name))
            .chain(profile.i2cs.iter().chain(&profile.spis).map(|one| &one.name))
            .chain(profile.serials.iter().chain(&profile.cans).map(|one| &one.name));
        names.any(|name| name == unit)
    }

    fn connection(&mut self, connection: &JobConnection<'_>) {
        let judged = of_connection(connection);
        let kind = connection.connection.kind.name();
        let shares = matches!(kind, KindName::I2c | KindName::Spi | KindName::Can);
        for pad in &connection.pads {
            let Some(code) = self.wire(connection, pad) else {
                self.unjudged.push(format!("{} at {}", connection.title, pad.pin.name));
                continue;
            };
            let is_known = self.all.iter().any(|(known, _)| *known == code);
            if !(shares && pad.usage.is_some() && is_known) {
                self.push(code, &judged);
            }
        }
        let Some(unit) = connection.unit else { return };
        for stream in &connection.streams {
            let Some(code) = self.stream(unit, kind, stream.request, stream.stream) else {
                let (request, stream) = (stream.request, stream.stream);
                self.unjudged.push(format!("{} by DMA {stream} ({request})", connection.title));
                continue;
            };
            if !self.all.iter().any(|(known, _)| *known == code) {
                self.push(code, &judged);
            }
        }
    }

    /// The line of a wire; none where the HAL has no types for it.
    fn wire(&self, connection: &JobConnection<'_>, pad: &Pad<'_>) -> Option<String> {
        let pin = self.names.hal.pin(&pad.pin.name);
        if let Kind::Digital(digital) = &connection.connection.kind {
            let line = pad.interrupt.filter(|_| digital.edge.is_some());
            return Some(match line.filter(|_| self.names.hal == Hal::Stm32) {
                Some(line) => format!("edge!(p.{pin}, p.EXTI{line});"),
                None => format!("pin(p.{pin});"),
            });
        }
        match (connection.unit, pad.usage) {
            (Some(unit), Some(usage)) => self.typed(unit, usage.signal.function(), &pin),
            _ => Some(format!("pin(p.{pin});")),
        }
    }

    /// The line of a wire with a signal.
    fn typed(&self, unit: &str, function: &Function, pin: &str) -> Option<String> {
        if !self.knows(unit) {
            return None;
        }
        let moved =
            self.names.remap(unit, self.blocks.get(&UnitName::new(unit)).copied().unwrap_or(0));
        let moved = moved.map_or(String::new(), |block| format!(", {block}"));
        let unit = self.names.peripheral(unit);
        if self.names.hal == Hal::Rp {
            return rp::typed::wire(unit, function, pin);
        }
        let (call, extra) = match function {
            Function::Adc { .. } => return Some(format!("analog::<{unit}, _>(p.{pin});")),
            Function::Dac { channel, .. } => {
                return Some(format!("dac_out::<{unit}, hal::dac::Ch{channel}, _>(p.{pin});"));
            }
            Function::I2c { line, .. } => match line {
                I2cLine::Scl => ("scl", String::new()),
                I2cLine::Sda => ("sda", String::new()),
            },
            Function::Timer { channel, line, .. } => match line {
                TimerLine::Inverted => ("inverted", format!(", hal::timer::Ch{channel}")),
                TimerLine::Both | TimerLine::Output | TimerLine::Input => {
                    ("channel", format!(", hal::timer::Ch{channel}"))
                }
            },
            Function::Uart { line, .. } => match line {
                UartLine::Tx => ("uart_tx", String::new()),
                UartLine::Rx => ("uart_rx", String::new()),
            },
            Function::Spi { line, .. } => match line {
                SpiLine::Sck => ("sck", String::new()),
                SpiLine::Miso => ("miso", String::new()),
                SpiLine::Mosi => ("mosi", String::new()),
                SpiLine::Nss => return None,
            },
            Function::Can { line, .. } => match line {
                CanLine::Tx => ("can_tx", String::new()),
                CanLine::Rx => ("can_rx", String::new()),
            },
            Function::Other => return None,
        };
        Some(format!("{call}::<{unit}{extra}{moved}, _>(p.{pin});"))
    }

    /// The line of a DMA stream; none where the HAL's driver takes none.
    fn stream(&self, unit: &str, kind: KindName, request: &str, stream: &str) -> Option<String> {
        if !self.knows(unit) {
            return None;
        }
        let channel = self.names.channel(stream)?;
        if self.names.hal == Hal::Rp {
            // Any channel serves any unit.
            return Some(format!("dma(p.{channel});"));
        }
        let unit = self.names.peripheral(unit);
        let call = match (kind, request.rsplit_once('_').map(|(_, signal)| signal)) {
            (KindName::Analog, _) => "adc_dma",
            (KindName::I2c, Some("RX")) => "i2c_rx",
            (KindName::I2c, Some("TX")) => "i2c_tx",
            (KindName::Spi, Some("RX")) => "spi_rx",
            (KindName::Spi, Some("TX")) => "spi_tx",
            _ => return None,
        };
        Some(format!("{call}::<{unit}, _>(p.{channel});"))
    }

    /// The wires of the link.
    fn link(&mut self) {
        let board = self.job.board;
        let judged = |wire: &str| Judged {
            span: board.name.span,
            what: format!("the link of {} at {wire}", board.name.value),
        };
        if let Some(link) = &self.job.link {
            if !self.job.connections.iter().any(|one| one.unit == Some(link.unit)) {
                let unit = self.names.peripheral(link.unit);
                self.push(format!("unit(p.{unit});"), &judged(link.unit));
            }
            for pad in &link.pads {
                let function = pad.usage.map(|usage| usage.signal.function());
                let pin = self.names.hal.pin(&pad.pin.name);
                let code = function.and_then(|one| self.typed(link.unit, one, &pin));
                let judged = judged(pad.pin.name.as_str());
                match code {
                    Some(code) => self.push(code, &judged),
                    None => self.unjudged.push(judged.what),
                }
            }
        }
        let usb = super::link::usb(self.job).filter(|_| board.link.transport == Transport::Usb);
        let Some(usb) = usb.filter(|usb| self.knows(&usb.name)) else { return };
        let unit = self.names.peripheral(&usb.name);
        self.push(format!("unit(p.{unit});"), &judged(&usb.name));
        for (call, pin) in ["usb_dm", "usb_dp"].into_iter().zip(&usb.pins) {
            self.push(format!("{call}::<{unit}, _>(p.{pin});"), &judged(pin.as_str()));
        }
    }
}

fn of_connection(connection: &JobConnection<'_>) -> Judged {
    Judged { span: connection.part.name.span, what: connection.place() }
}
