//! SPI: a bus for each unit, a chip select for each part, and a task for each bus and cycle.

use sensedsl_board::signal::UnitName;
use sensedsl_diagnostics::Diagnostic;
use sensedsl_model::kind::{KindName, Role};
use sensedsl_timing::spi_divider;

use super::chips::{self, Bus, Reach, Served};
use super::context::Context;
use super::hal::contract::Drivers;
use super::hal::contract::buses::Spi;
use super::hal::contract::outputs::{Pins, Speed};
use super::missing::{self, Printed};
use super::section::{Field, Section};
use sensedsl_job::JobConnection;
use sensedsl_job::snake;

pub(super) fn plan(
    context: &Context<'_>,
    drivers: &dyn Drivers,
    diagnostics: &mut Vec<Diagnostic>,
) -> Section {
    let mut section = Section::default();
    let Some(spi) = drivers.spi() else { return section };
    let type_ = |unit: &UnitName| spi.bus_type(unit);
    for one in chips::buses(context, KindName::Spi, type_, diagnostics) {
        let made = bus(context, (spi, drivers.pins()), &one, &mut section);
        context.report(one.first.part, made, diagnostics);
    }
    section
}

/// A chip select, which is high before it is an output.
fn select(pins: &dyn Pins, wire: &JobConnection<'_>) -> Printed<Field> {
    let pin = &missing::pad(wire, Role::Cs)?.pin.name;
    Ok(Field {
        name: format!("{}_select", wire.ident),
        comment: format!("{}, selected by {pin}", wire.title),
        type_: "Output<'static>".to_owned(),
        make: pins.output(pin, "Level::High", Speed::Medium),
    })
}

/// How a task reaches the parts: each by its chip select, in its mode and at its clock.
fn reach(context: &Context<'_>, unit: &str, served: &[Served<'_>]) -> Printed<Reach> {
    let mut reach = Reach::default();
    for Served { plan, wire } in served {
        let spi = missing::kind(wire.connection.kind.spi())?;
        let select = match wire.pad(Role::Cs) {
            Some(_) => {
                let select = format!("{}_select", wire.ident);
                reach.parameters.push(format!("{select}: Output<'static>"));
                reach.arguments.push(format!("wiring.{select}"));
                format!("Some({select})")
            }
            None => "None".to_owned(),
        };
        reach.lines.push(format!(
            "let mut {}_line = rt::spi::SpiLine {{ bus, select: {select}, config: rt::spi::config({}, {}) }};",
            plan.prefix,
            spi.mode,
            clock_hz(context, unit, wire).unwrap_or(spi.clock_hz)
        ));
    }
    Ok(reach)
}

/// The bus with its chip selects and the tasks that serve its parts.
fn bus(
    context: &Context<'_>,
    drivers: (&dyn Spi, &dyn Pins),
    bus: &Bus<'_>,
    section: &mut Section,
) -> Printed<()> {
    let ((spi, pins), unit) = (drivers, bus.unit.as_str());
    let made = spi.unit(context, &bus.unit, bus.first, section)?;
    let comment = format!("{unit} at {}: {}", places(bus.first), bus.titles());
    bus.share(Field::of(snake(unit), comment, made), section);
    for one in bus.all.iter().filter(|one| one.pad(Role::Cs).is_some()) {
        section.fields.push(select(pins, one)?);
    }
    let hz = bus.all.iter().filter_map(|one| clock_hz(context, unit, one)).min().unwrap_or(1);
    chips::tasks(context, bus, hz, |served| reach(context, unit, served), section)
}

/// `PA5 (SCK), PA7 (MOSI) and PA6 (MISO)`, as far as there are wires.
fn places(wire: &JobConnection<'_>) -> String {
    let named = [(Role::Sck, "SCK"), (Role::Mosi, "MOSI"), (Role::Miso, "MISO")];
    let place = |(role, name)| Some(format!("{} ({name})", wire.pad(role)?.pin.name));
    let all: Vec<String> = named.into_iter().filter_map(place).collect();
    match all.as_slice() {
        [others @ .., last] if !others.is_empty() => format!("{} and {last}", others.join(", ")),
        _ => all.concat(),
    }
}

/// The fastest clock of a unit that a part can follow, or the one that a strip needs. The HAL is asked for exactly this
/// one, as it takes the nearest.
fn clock_hz(context: &Context<'_>, unit: &str, wire: &JobConnection<'_>) -> Option<u32> {
    let unit_hz = context.unit_hz(unit)?;
    let of_strip = context.job.bus_of(wire).and_then(|plan| plan.clock_hz);
    let asked_hz = of_strip.or_else(|| Some(wire.connection.kind.spi()?.clock_hz))?;
    // A clock that is too slow for the unit has been reported with the timing.
    Some(unit_hz / spi_divider(context.profile, unit_hz, asked_hz)?.max(1))
}
