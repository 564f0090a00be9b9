//! I²C: a bus for each unit, and a task for each bus and cycle that serves its chips.

use std::collections::BTreeMap;

use sensedsl_diagnostics::Diagnostic;
use sensedsl_model::kind::{KindName, Role};

use super::chips::{self, Bus, Reach, Served};
use super::context::Context;
use super::section::{Field, Section, Start};
use crate::job::JobConnection;
use crate::print::snake;

pub(super) fn plan(context: &Context<'_>, _: &mut Vec<Diagnostic>) -> Section {
    let mut section = Section::default();
    let mut buses: BTreeMap<&str, Vec<&JobConnection<'_>>> = BTreeMap::new();
    for one in context.job.connections(KindName::I2c) {
        let Some(unit) = one.unit else { continue };
        buses.entry(unit).or_default().push(one);
    }
    for (unit, on_bus) in buses {
        let Some(field) = bus(context, unit, &on_bus, &mut section) else { continue };
        let name = field.name.clone();
        section.fields.push(field);
        section.items.push(format!("static {unit}_BUS: StaticCell<I2cBus> = StaticCell::new();"));
        section.starts.push(Start::Make(format!(
            "let {name}: &'static I2cBus = {unit}_BUS.init(Mutex::new(wiring.{name}));"
        )));
        section.runtime.insert("i2c.rs");
        let bus = Bus { unit, type_: "I2cBus", on_bus: &on_bus, hz: hz(&on_bus) };
        chips::tasks(context, &bus, reach, &mut section);
    }
    section
}

/// Every part is reached by its address.
fn reach(served: &[Served<'_>]) -> Reach {
    let line = |one: &Served<'_>| {
        format!("    let mut {}_line = rt::i2c::I2cLine(bus);\n", one.plan.prefix)
    };
    Reach {
        parameters: String::new(),
        arguments: String::new(),
        lines: served.iter().map(line).collect(),
    }
}

/// The clock that all parts of a bus take.
fn hz(on_bus: &[&JobConnection<'_>]) -> u32 {
    let all = on_bus.iter().filter_map(|one| one.connection.kind.i2c()).map(|i2c| i2c.speed_hz);
    all.min().unwrap_or(100_000).max(1)
}

/// The bus, in the words of the HAL.
fn bus(
    context: &Context<'_>,
    unit: &str,
    on_bus: &[&JobConnection<'_>],
    section: &mut Section,
) -> Option<Field> {
    let first = on_bus.first()?;
    let hal = context.peripheral(unit);
    let (scl, sda) = (first.pad(Role::Scl)?, first.pad(Role::Sda)?);
    let (tx, rx) = (section.stream(context, first, "_TX")?, section.stream(context, first, "_RX")?);
    for (signal, handler) in [("EV", "EventInterruptHandler"), ("ER", "ErrorInterruptHandler")] {
        // A unit with one interrupt for both has it under either name.
        let interrupt = context.names.interrupt(unit, signal)?;
        section.bind(interrupt, format!("hal::i2c::{handler}<{hal}>"));
    }
    let who: Vec<&str> = on_bus.iter().map(|one| one.title.as_str()).collect();
    Some(Field {
        name: snake(unit),
        comment: format!("{unit} at {} and {}: {}", scl.pin.name, sda.pin.name, who.join(", ")),
        type_: "hal::i2c::I2c<'static, hal::mode::Async, hal::i2c::Master>".to_owned(),
        make: format!(
            "hal::i2c::I2c::new(p.{hal}, p.{}, p.{}, p.{tx}, p.{rx}, Irqs, bus({}))",
            scl.pin.name,
            sda.pin.name,
            hz(on_bus)
        ),
    })
}
