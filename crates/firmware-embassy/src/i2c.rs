//! I²C: a bus for each unit, and a task for each bus and cycle that serves its chips.

use sensedsl_board::signal::UnitName;
use sensedsl_diagnostics::Diagnostic;
use sensedsl_model::kind::{KindName, Role};

use super::chips::{self, Bus, Reach, Served};
use super::context::Context;
use super::hal::Hal;
use super::lack::{self, Printed};
use super::rp;
use super::section::{Field, Section};
use sensedsl_job::snake;

pub(super) fn plan(context: &Context<'_>, diagnostics: &mut Vec<Diagnostic>) -> Section {
    let mut section = Section::default();
    let type_ = |unit: &UnitName| match context.names.hal {
        Hal::Stm32 => "rt::i2c::I2cBus".to_owned(),
        Hal::Rp => rp::buses::i2c_type(unit),
    };
    for one in chips::buses(context, KindName::I2c, type_, diagnostics) {
        let made = bus(context, &one, &mut section);
        context.tell(one.first.part, made, diagnostics);
    }
    section
}

/// Every part is reached by its address. The registers stand beside it, which stop what does not end.
fn reach(context: &Context<'_>, unit: &str, served: &[Served<'_>]) -> Reach {
    let line = format!("rt::i2c::I2cLine(bus, hal::pac::{})", context.peripheral(unit));
    let lines = served.iter().map(|one| format!("let mut {}_line = {line};", one.plan.prefix));
    Reach { lines: lines.collect(), ..Reach::default() }
}

/// The clock that all parts of a bus take, and that the unit of this family makes: the HAL takes any and makes of one
/// beyond it what no register describes.
fn hz(context: &Context<'_>, bus: &Bus<'_>) -> u32 {
    let all = bus.all.iter().filter_map(|one| one.connection.kind.i2c()).map(|i2c| i2c.speed_hz);
    all.min().unwrap_or(100_000).clamp(1, context.profile.i2c.speed_max_hz.max(1))
}

/// The bus, in the words of the HAL, and the tasks that serve its chips.
fn bus(context: &Context<'_>, bus: &Bus<'_>, section: &mut Section) -> Printed<()> {
    let field = match context.names.hal {
        Hal::Stm32 => unit(context, bus, section)?,
        Hal::Rp => rp::buses::i2c(context, bus, hz(context, bus), section)?,
    };
    bus.share(field, section);
    chips::tasks(
        context,
        bus,
        hz(context, bus),
        |served| Ok(reach(context, bus.unit.as_str(), served)),
        section,
    )
}

/// The unit in the HAL's words.
fn unit(context: &Context<'_>, bus: &Bus<'_>, section: &mut Section) -> Printed<Field> {
    let (unit, first) = (bus.unit.as_str(), bus.first);
    let hal = context.peripheral(unit);
    let (scl, sda) = (lack::pad(first, Role::Scl)?, lack::pad(first, Role::Sda)?);
    let (tx, rx) = (section.stream(context, first, "_TX")?, section.stream(context, first, "_RX")?);
    for (signal, handler) in [("EV", "EventInterruptHandler"), ("ER", "ErrorInterruptHandler")] {
        // A unit with one interrupt for both has it under either name.
        let interrupt = context.interrupt(unit, signal)?;
        section.bind(interrupt, format!("hal::i2c::{handler}<{hal}>"));
    }
    section.features.insert(if context.names.has_old_buses() { "i2c-v1" } else { "i2c-v2" });
    if context.names.has_pulls() {
        section.features.insert("gpio-v2");
    }
    Ok(Field {
        name: snake(unit),
        comment: format!("{unit} at {} and {}: {}", scl.pin.name, sda.pin.name, bus.titles()),
        type_: "hal::i2c::I2c<'static, hal::mode::Async, hal::i2c::Master>".to_owned(),
        make: format!(
            "hal::i2c::I2c::new{}(p.{hal}, p.{}, p.{}, p.{tx}, p.{rx}, Irqs, crate::rt::i2c::config({}))",
            context.generics(unit, &["_"; 3]),
            scl.pin.name,
            sda.pin.name,
            hz(context, bus)
        ),
    })
}
