//! I²C: a bus for each unit, and a task for each bus and cycle that serves its chips.

use sensedsl_board::signal::UnitName;
use sensedsl_diagnostics::Diagnostic;
use sensedsl_model::kind::{KindName, Role};

use super::chips::{self, Bus, Reach, Served};
use super::context::Context;
use super::hal::contract::Drivers;
use super::hal::contract::buses::I2c;
use super::missing::{self, Printed};
use super::section::{Field, Section};
use sensedsl_job::snake;

pub(super) fn plan(
    context: &Context<'_>,
    drivers: &dyn Drivers,
    diagnostics: &mut Vec<Diagnostic>,
) -> Section {
    let mut section = Section::default();
    let Some(i2c) = drivers.i2c() else { return section };
    let type_ = |unit: &UnitName| i2c.bus_type(unit);
    for one in chips::buses(context, KindName::I2c, type_, diagnostics) {
        let made = bus(context, i2c, &one, &mut section);
        context.report(one.first.part, made, diagnostics);
    }
    section
}

/// How a task reaches the parts: each by its address. A line has the registers of the unit as well, with which the
/// runtime ends a transfer that does not end by itself.
fn reach(registers: &str, served: &[Served<'_>]) -> Reach {
    let line = format!("rt::i2c::I2cLine(bus, {registers})");
    let lines = served.iter().map(|one| format!("let mut {}_line = {line};", one.plan.prefix));
    Reach { lines: lines.collect(), ..Reach::default() }
}

/// The clock that all parts of a bus can follow and the unit can make. Of a clock beyond what the unit can make, a HAL
/// may make settings that no register describes.
fn hz(context: &Context<'_>, bus: &Bus<'_>) -> u32 {
    let all = bus.all.iter().filter_map(|one| one.connection.kind.i2c()).map(|i2c| i2c.speed_hz);
    all.min().unwrap_or(100_000).clamp(1, context.profile.i2c.speed_max_hz.max(1))
}

/// The bus with the tasks that serve its chips.
fn bus(context: &Context<'_>, i2c: &dyn I2c, bus: &Bus<'_>, section: &mut Section) -> Printed<()> {
    let (unit, hz) = (bus.unit.as_str(), hz(context, bus));
    let (scl, sda) = (missing::pad(bus.first, Role::Scl)?, missing::pad(bus.first, Role::Sda)?);
    let made = i2c.unit(context, &bus.unit, bus.first, hz, section)?;
    let comment = format!("{unit} at {} and {}: {}", scl.pin.name, sda.pin.name, bus.titles());
    bus.share(Field::of(snake(unit), comment, made), section);
    let registers = i2c.registers(context, unit);
    chips::tasks(context, bus, hz, |served| Ok(reach(&registers, served)), section)
}
