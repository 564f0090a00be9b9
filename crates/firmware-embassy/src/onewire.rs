//! Wires that both ends pull low: a pin for each, and a task for each wire and cycle.

use sensedsl_board::signal::UnitName;
use sensedsl_diagnostics::Diagnostic;
use sensedsl_model::kind::onewire::{OneWire, OneWireProtocol};

use super::chip;
use super::chips::{self, Bus, Reach, Served};
use super::context::Context;
use super::hal::contract::Drivers;
use super::hal::contract::outputs::Pins;
use super::missing::{self, Printed};
use super::section::{Field, Section};
use sensedsl_job::kinds::onewire::{Wire, wires};
use sensedsl_job::snake;

/// The runtime's type of a pin.
const PIN: &str = "rt::wire::OneWirePin";

/// A part has no clock: nothing waits for its bits.
const CLOCK_HZ: u32 = 1_000_000;

pub(super) fn plan(
    context: &Context<'_>,
    drivers: &dyn Drivers,
    diagnostics: &mut Vec<Diagnostic>,
) -> Section {
    let mut section = Section::default();
    let Some(own) = drivers.onewire() else { return section };
    for wire in wires(context.job) {
        let Some(first) = wire.all.first() else { continue };
        section.features.extend(own.feature());
        let made = bus(context, drivers.pins(), &wire, &mut section);
        context.report(first.part, made, diagnostics);
    }
    section
}

fn bus(
    context: &Context<'_>,
    pins: &dyn Pins,
    wire: &Wire<'_>,
    section: &mut Section,
) -> Printed<()> {
    let pin = &wire.pad.pin.name;
    let (name, titles) = (pin.to_string(), wire.titles());
    let type_ = format!("rt::onewire::OneWireBus<{PIN}>");
    let Some(bus) = Bus::of_wire(UnitName::new(&name), type_, &wire.all) else { return Ok(()) };
    let field = Field {
        name: snake(&name),
        comment: format!("The wire at {name}: {titles}"),
        type_: format!("crate::{PIN}"),
        make: format!("crate::rt::wire::pin(p.{})", pins.pin(pin)),
    };
    bus.share(field, section);
    chips::tasks(context, &bus, CLOCK_HZ, reach, section)
}

/// How a task reaches the parts of a wire.
fn reach(served: &[Served<'_>]) -> Printed<Reach> {
    let mut reach = Reach::default();
    for Served { plan, wire } in served {
        let own = missing::kind(wire.connection.kind.onewire())?;
        reach.lines.push(format!(
            "let mut {}_line = rt::onewire::OneWireLine {{ wire: bus, part: {} }};",
            plan.prefix,
            part(own)
        ));
    }
    Ok(reach)
}

fn part(own: &OneWire) -> String {
    if own.protocol == OneWireProtocol::Dht {
        return format!("rt::onewire::Part::Burst {{ pulse_us: {} }}", own.pulse_us);
    }
    let rom =
        own.rom.map(|rom| format!("Some({})", chip::bytes(&rom.bytes).trim_start_matches('&')));
    let trigger = own.trigger.first().map(|first| format!("Some({})", chip::byte(*first)));
    let none = || "None".to_owned();
    let (rom, trigger) = (rom.unwrap_or_else(none), trigger.unwrap_or_else(none));
    format!("rt::onewire::Part::W1 {{ rom: {rom}, trigger: {trigger} }}")
}
