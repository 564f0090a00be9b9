//! The wiring in types: one line of Rust for each wire, which only compiles if the HAL knows the wire.
//!
//! In: a [`BoardJob`] of any target, whose MCU Embassy knows. Out: a crate that is checked on the host and does
//! nothing, and for each of its lines the device that it is of. The types of the HALs are the work of other people, so
//! what they refuse is a mistake of theirs or of ours.

use std::collections::{BTreeMap, BTreeSet};

use sensedsl_board::profile::{self, Target, TargetProfile};
use sensedsl_board::signal::Function;
use sensedsl_diagnostics::Span;
use sensedsl_model::design::Transport;
use sensedsl_model::kind::{Kind, KindName};

use super::cargo;
use super::context::Context;
use super::hal::contract::outputs::Pins;
use super::hal::contract::types::{Request, Types, UsbWire};
use super::hal::{HALS, Opened};
use super::names::numbered;
use sensedsl_files::FileSet;
use sensedsl_job::{BoardJob, JobConnection, JobStream, Pad};

/// A crate whose compilation judges the wiring of one board.
#[derive(Clone, Debug)]
pub struct TypeCheck {
    /// The HAL's feature for the chip. Crates of the same chip share a build folder.
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
fn profile_of(mcu: &str) -> Option<TargetProfile> {
    let Ok(Target::Profile(profile)) = profile::find("embassy", mcu) else { return None };
    Some(*profile)
}

/// Whether the HAL of an MCU has types that can judge its wiring.
#[must_use]
pub fn is_judged(mcu: &str) -> bool {
    let drivers = profile_of(mcu).and_then(|profile| Opened::new(&profile, HALS).ok());
    drivers.is_some_and(|opened| opened.drivers.types().is_some())
}

/// The check of a board's wiring.
///
/// # Errors
///
/// Why there is none, worded to follow a colon.
pub fn type_check(job: &BoardJob<'_>) -> Result<TypeCheck, String> {
    let mcu = job.board.mcu.as_deref().ok_or("its table does not say which MCU it describes")?;
    let profile = profile_of(mcu).ok_or_else(|| format!("Embassy does not know {mcu}"))?;
    let Opened { names, hal, drivers } = Opened::new(&profile, HALS)?;
    let chip = names.chip(mcu).ok_or_else(|| format!("Embassy does not know {mcu}"))?;
    let types = drivers.types().ok_or("the HAL for its MCU has no types to check")?;
    let served = job.connections.iter().collect();
    let context = Context { job, profile: &profile, names: &names, chip, served };
    let mut lines = Lines::new(&context, drivers.pins(), types);
    lines.units();
    for connection in &job.connections {
        lines.connection(connection);
    }
    lines.link();
    let Lines { all, unjudged, .. } = lines;
    let (text, known) = print_check(types, all);
    let mut files = FileSet::default();
    files.add("Cargo.toml", cargo::check_manifest(&context, hal.package(), types));
    files.add("Cargo.lock", cargo::check_lock(&context, hal.package(), types));
    if let Some(config) = types.cargo_config(&context) {
        files.add(".cargo/config.toml", config);
    }
    files.add("src/lib.rs", text);
    Ok(TypeCheck { chip: context.chip.feature, files, lines: known, unjudged })
}

/// The crate, and what each line of it is of. Only functions that a line calls are printed, because not every chip has
/// all modules of the HAL.
fn print_check(
    types: &dyn Types,
    lines: Vec<(String, Judged)>,
) -> (String, BTreeMap<usize, Judged>) {
    let is_called = |name: &str| {
        lines.iter().any(|(code, _)| code.split_once("::").is_some_and(|(call, _)| call == name))
    };
    let mut calls = types.calls();
    calls.retain(|(name, _)| is_called(name));
    let (code, judged): (Vec<String>, Vec<Judged>) = lines.into_iter().unzip();
    let text = types.print(&calls, &code);
    // They are the last lines of the crate, but for a brace.
    let first = text.lines().count() - code.len();
    (text, (first..).zip(judged).collect())
}

/// The lines of a check while they are made.
struct Lines<'a> {
    context: &'a Context<'a>,
    pins: &'a dyn Pins,
    types: &'a dyn Types,
    all: Vec<(String, Judged)>,
    unjudged: Vec<String>,
}

impl<'a> Lines<'a> {
    fn new(context: &'a Context<'a>, pins: &'a dyn Pins, types: &'a dyn Types) -> Self {
        Self { context, pins, types, all: Vec::new(), unjudged: Vec::new() }
    }

    fn push(&mut self, code: String, judged: &Judged) {
        self.all.push((code, judged.clone()));
    }

    /// A line for each unit: the crate takes it once, whoever shares it. The timer of the clock cannot be taken.
    fn units(&mut self) {
        let mut seen = BTreeSet::new();
        for connection in &self.context.job.connections {
            let Some(unit) = connection.unit.filter(|unit| seen.insert((*unit).to_owned())) else {
                continue;
            };
            if self.knows(unit) {
                let judged = of_connection(connection);
                self.push(format!("unit(p.{});", self.context.peripheral(unit)), &judged);
            }
        }
    }

    /// Whether the HAL has a driver for a unit.
    fn knows(&self, unit: &str) -> bool {
        let (profile, unit) = (self.context.profile, numbered(unit));
        let mut names = (profile.adcs.iter().map(|one| &one.name))
            .chain(profile.timers.iter().map(|one| &one.name))
            .chain(profile.pios.iter().map(|one| &one.name))
            .chain(profile.dacs.iter().map(|one| &one.name))
            .chain(profile.usbs.iter().map(|one| &one.name))
            .chain(profile.i2cs.iter().chain(&profile.spis).map(|one| &one.name))
            .chain(profile.serials.iter().chain(&profile.cans).map(|one| &one.name));
        names.any(|name| name == unit)
    }

    /// The lines of a connection: its pads, and the DMA streams of its unit.
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
            let is_shared = (shares && pad.usage.is_some()) || kind == KindName::OneWire;
            if !(is_shared && is_known) {
                self.push(code, &judged);
            }
        }
        let Some(unit) = connection.unit else { return };
        for stream in &connection.streams {
            let Some(code) = self.stream(unit, kind, stream) else {
                let (request, stream) = (stream.request, stream.stream);
                self.unjudged.push(format!("{} by DMA {stream} ({request})", connection.title));
                continue;
            };
            if !self.all.iter().any(|(known, _)| *known == code) {
                self.push(code, &judged);
            }
        }
    }

    /// The line of a wire; `None` if the HAL has no types for it.
    fn wire(&self, connection: &JobConnection<'_>, pad: &Pad<'_>) -> Option<String> {
        let pin = self.pins.pin(&pad.pin.name);
        if let Kind::Digital(digital) = &connection.connection.kind {
            let line = pad.interrupt.filter(|_| digital.edge.is_some());
            return Some(match line {
                Some(line) => self.types.edge(&pin, line),
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
        self.knows(unit).then(|| self.types.wire(self.context, unit, function, pin))?
    }

    /// The line of a DMA stream; `None` if the HAL's driver takes none.
    fn stream(&self, unit: &str, kind: KindName, stream: &JobStream<'_>) -> Option<String> {
        if !self.knows(unit) {
            return None;
        }
        let channel = self.context.names.channel(stream.stream)?;
        let unit = self.context.peripheral(unit);
        let signal = stream.request.rsplit_once('_').map(|(_, signal)| signal);
        self.types.channel(&Request { unit: &unit, kind, signal }, &channel)
    }

    /// The lines of the link.
    fn link(&mut self) {
        let context = self.context;
        let (job, board) = (context.job, context.job.board);
        let judged = |wire: &str| Judged {
            span: board.name.span,
            what: format!("the link of {} at {wire}", board.name.value),
        };
        if let Some(link) = &job.link {
            if !job.connections.iter().any(|one| one.unit == Some(link.unit)) {
                let unit = context.peripheral(link.unit);
                self.push(format!("unit(p.{unit});"), &judged(link.unit));
            }
            for pad in &link.pads {
                let function = pad.usage.map(|usage| usage.signal.function());
                let pin = self.pins.pin(&pad.pin.name);
                let code = function.and_then(|one| self.typed(link.unit, one, &pin));
                let judged = judged(pad.pin.name.as_str());
                match code {
                    Some(code) => self.push(code, &judged),
                    None => self.unjudged.push(judged.what),
                }
            }
        }
        let usb = job.profile.and_then(|profile| profile.usb(None));
        let usb = usb.filter(|_| board.link.transport == Transport::Usb);
        let Some(usb) = usb.filter(|usb| self.knows(&usb.name)) else { return };
        let unit = context.peripheral(&usb.name);
        self.push(format!("unit(p.{unit});"), &judged(&usb.name));
        for (wire, pin) in [UsbWire::Minus, UsbWire::Plus].into_iter().zip(&usb.pins) {
            if let Some(code) = self.types.usb(&unit, wire, pin.as_str()) {
                self.push(code, &judged(pin.as_str()));
            }
        }
    }
}

fn of_connection(connection: &JobConnection<'_>) -> Judged {
    Judged { span: connection.part.name.span, what: connection.place() }
}
