//! All versions: a line that is pulled low or released, and an interrupt for the bursts on it.

use sensedsl_diagnostics::Diagnostic;
use sensedsl_model::kind::onewire::{OneWire, OneWireProtocol};

use crate::chips;
use crate::context::{Context, PadPlan};
use crate::names::Setting;
use crate::section::Section;
use sensedsl_files::{block, templates};
use sensedsl_job::kinds::onewire::{Wire, wires};
use sensedsl_job::snake;

templates! {
    w: Port;
    Tables = "onewire/v1.c.txt";
}

/// One wire.
struct Port {
    ident: String,
    name: String,
    line: String,
    parts: Vec<PartPlan>,
    threads: String,
}

/// A part on it.
struct PartPlan {
    title: String,
    /// The address of a 1-Wire part, as people write it and in the order of the wire.
    rom: Option<(String, String)>,
    pulse_us: u32,
    trigger: Option<String>,
}

pub(super) fn plan(context: &Context<'_>, diagnostics: &mut Vec<Diagnostic>) -> Section {
    let mut section = Section::default();
    let mut has_bursts = false;
    for wire in wires(context.job) {
        let mode = open_drain(context);
        let Some(pad) = context.pad(wire.pad, mode, diagnostics) else { continue };
        let line = pad.line.clone();
        // The wire is released before the pin becomes an output.
        section.pads.push(PadPlan { is_high: true, ..pad });
        let name = wire.pad.pin.name.to_string();
        let threads = chips::threads(context, &name, &wire.all);
        section.work.extend(threads.iter().map(chips::Thread::work));
        has_bursts |= parts(&wire).any(|(_, own)| own.protocol == OneWireProtocol::Dht);
        let parts = parts(&wire).map(|(title, own)| PartPlan::new(title, own)).collect();
        let (ident, threads) = (snake(&name), chips::tables(&threads));
        section.starts.push(format!("up_onewire_start(&{ident}_port);"));
        section.tables.push_str(if section.tables.is_empty() { "" } else { "\n\n" });
        let port = Port { ident, name, line, parts, threads };
        section.tables.push_str(block(&Tables { w: &port }).trim_start());
    }
    if has_bursts {
        section.hal = vec![Setting::new("PAL_USE_CALLBACKS", "TRUE")];
    }
    section
}

/// The parts on a wire, with their names.
fn parts<'w>(wire: &'w Wire<'w>) -> impl Iterator<Item = (&'w str, &'w OneWire)> {
    wire.all.iter().filter_map(|one| Some((one.title.as_str(), one.connection.kind.onewire()?)))
}

/// An output that only pulls low, with the resistor of the MCU, which keeps a loose wire high.
fn open_drain(context: &Context<'_>) -> &'static str {
    if context.names.drivers.gpio == "GPIOv1" {
        "PAL_MODE_OUTPUT_OPENDRAIN"
    } else {
        "PAL_MODE_OUTPUT_OPENDRAIN | PAL_STM32_PUPDR_PULLUP"
    }
}

impl PartPlan {
    fn new(title: &str, own: &OneWire) -> Self {
        let bytes = |rom: [u8; 8]| sensedsl_firmware_c::words::bytes(&rom);
        Self {
            title: title.to_owned(),
            rom: own.rom.map(|rom| (rom.shown(), bytes(rom.bytes))),
            pulse_us: if own.protocol == OneWireProtocol::Dht { own.pulse_us } else { 0 },
            trigger: own.trigger.first().map(sensedsl_firmware_c::words::byte),
        }
    }
}
