//! SPI: a bus for each unit, a chip select for each part, and a task for each bus and cycle.

use std::collections::BTreeMap;

use sensedsl_diagnostics::Diagnostic;
use sensedsl_model::kind::spi::Spi;
use sensedsl_model::kind::{KindName, Role};
use sensedsl_timing::spi_divider;

use super::chips::{self, Bus, Reach, Served};
use super::context::Context;
use super::section::{Field, Section, Start};
use crate::job::JobConnection;
use crate::print::snake;

pub(super) fn plan(context: &Context<'_>, _: &mut Vec<Diagnostic>) -> Section {
    let mut section = Section::default();
    let mut buses: BTreeMap<&str, Vec<&JobConnection<'_>>> = BTreeMap::new();
    for one in context.job.connections(KindName::Spi) {
        let Some(unit) = one.unit else { continue };
        buses.entry(unit).or_default().push(one);
    }
    for (unit, on_bus) in buses {
        let Some(field) = bus(context, unit, &on_bus, &mut section) else { continue };
        let name = field.name.clone();
        section.fields.push(field);
        for one in &on_bus {
            section.fields.extend(select(one));
        }
        section.items.push(format!("static {unit}_BUS: StaticCell<SpiBus> = StaticCell::new();"));
        section.starts.push(Start::Make(format!(
            "let {name}: &'static SpiBus = {unit}_BUS.init(Mutex::new(wiring.{name}));"
        )));
        section.runtime.insert("spi.rs");
        let all = on_bus.iter().filter_map(|one| one.connection.kind.spi());
        let hz = all.filter_map(|spi| clock_hz(context, unit, spi)).min().unwrap_or(1);
        let bus = Bus { unit, type_: "SpiBus", on_bus: &on_bus, hz };
        chips::tasks(context, &bus, |served| reach(context, unit, served), &mut section);
    }
    section
}

/// A chip select, which is high before it is an output.
fn select(wire: &JobConnection<'_>) -> Option<Field> {
    let pin = &wire.pad(Role::Cs)?.pin.name;
    Some(Field {
        name: format!("{}_select", wire.ident),
        comment: format!("{}, selected by {pin}", wire.title),
        type_: "Output<'static>".to_owned(),
        make: format!("Output::new(p.{pin}, Level::High, Speed::Medium)"),
    })
}

/// Every part is reached by its chip select, in its mode and at its clock.
fn reach(context: &Context<'_>, unit: &str, served: &[Served<'_>]) -> Reach {
    let mut reach =
        Reach { parameters: String::new(), arguments: String::new(), lines: String::new() };
    for Served { plan, wire } in served {
        let Some(spi) = wire.connection.kind.spi() else { continue };
        let select = format!("{}_select", wire.ident);
        reach.parameters.push_str(&format!(", {select}: Output<'static>"));
        reach.arguments.push_str(&format!(", wiring.{select}"));
        reach.lines.push_str(&format!(
            "    let mut {}_line = rt::spi::SpiLine {{ bus, select: {select}, config: rt::spi::config({}, {}) }};\n",
            plan.prefix,
            spi.mode,
            clock_hz(context, unit, spi).unwrap_or(spi.clock_hz)
        ));
    }
    reach
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
    let (tx, rx) = (section.stream(context, first, "_TX")?, section.stream(context, first, "_RX")?);
    let pin = |role| Some(&first.pad(role)?.pin.name);
    let (sck, mosi, miso) = (pin(Role::Sck)?, pin(Role::Mosi)?, pin(Role::Miso)?);
    let who: Vec<&str> = on_bus.iter().map(|one| one.title.as_str()).collect();
    Some(Field {
        name: snake(unit),
        comment: format!(
            "{unit} at {sck} (SCK), {mosi} (MOSI) and {miso} (MISO): {}",
            who.join(", ")
        ),
        type_: "hal::spi::Spi<'static, hal::mode::Async, hal::spi::mode::Master>".to_owned(),
        make: format!(
            "hal::spi::Spi::new(p.{hal}, p.{sck}, p.{mosi}, p.{miso}, p.{tx}, p.{rx}, Irqs, Default::default())"
        ),
    })
}

/// The fastest clock of a unit that a part can follow. The HAL is asked for exactly that, because it takes the nearest.
fn clock_hz(context: &Context<'_>, unit: &str, spi: &Spi) -> Option<u32> {
    let unit_hz = context.unit_hz(unit)?;
    // What is too slow for the unit has been told with the timing.
    Some(unit_hz / spi_divider(context.profile, unit_hz, spi.clock_hz)?.max(1))
}
