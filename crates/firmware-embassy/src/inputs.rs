//! Digital inputs and encoders: a task for each cycle reads the inputs, and the reporter the encoders.

use sensedsl_diagnostics::Diagnostic;
use sensedsl_model::kind::{KindName, Role};
use sensedsl_wire::Direction;

use super::context::{Context, Wired, scalar};
use super::hal::contract::Drivers;
use super::hal::contract::inputs::Encoder;
use super::hal::contract::outputs::Pins;
use super::item::{Item, Task};
use super::missing::{self, Printed};
use super::section::{Field, Section, Start, Watched};
use super::{contacts, counters, filter};
use sensedsl_job::Cycle;

pub(super) fn plan(
    context: &Context<'_>,
    drivers: &dyn Drivers,
    diagnostics: &mut Vec<Diagnostic>,
) -> Section {
    let mut section = Section::default();
    for ((_, cycle), devices) in context.classes(KindName::Digital) {
        let has_edges = |one: &Wired<'_>| {
            one.first.connection.kind.digital().is_some_and(|own| own.edge.is_some())
        };
        // The reporter has those with edges.
        let is_read =
            |one: &&Wired<'_>| one.device.device.direction == Direction::Sensor && !has_edges(one);
        let sensors: Vec<&Wired<'_>> = devices.iter().filter(is_read).collect();
        if let Some(first) = sensors.first() {
            let made = digital(context, drivers.pins(), (cycle, &sensors), &mut section);
            context.report(first.first.part, made, diagnostics);
        }
    }
    if let Some(driver) = drivers.encoder() {
        for wired in context.wired(KindName::Encoder) {
            let made = encoder(context, driver, &wired, &mut section);
            context.report(wired.first.part, made, diagnostics);
        }
    }
    section
}

/// The sensors of one cycle with the task that reads them.
fn digital(
    context: &Context<'_>,
    pins: &dyn Pins,
    (cycle, devices): (Cycle, &[&Wired<'_>]),
    section: &mut Section,
) -> Printed<()> {
    let ident = cycle.ident("gpio");
    let constant = ident.to_uppercase();
    let mut task = Task::in_turn(cycle.title("gpio"), ident.clone(), cycle);
    let (mut arguments, mut statements) = (Vec::new(), Vec::new());
    for wired in devices {
        let filter = filter::pass(context, wired.index, section, &mut task.before);
        let value = wired.device.device.value.value;
        let mut levels = Vec::new();
        for wire in &wired.wires {
            let (pad, own) =
                (missing::pad(wire, Role::In)?, missing::kind(wire.connection.kind.digital())?);
            if contacts::is_kept(own) {
                let not = if own.active_low { "!" } else { "" };
                levels.push(format!("{not}{}.level()", contacts::name(wire)));
                continue;
            }
            section.fields.push(Field {
                name: wire.ident.clone(),
                comment: wire.place(),
                type_: "Input<'static>".to_owned(),
                make: format!("Input::new(p.{}, {})", pins.pin(&pad.pin.name), contacts::pull(own)),
            });
            task.parameters.push(format!("{}: Input<'static>", wire.ident));
            arguments.push(format!("wiring.{}", wire.ident));
            let call = if own.active_low { "is_low" } else { "is_high" };
            levels.push(format!("{}.{call}()", wire.ident));
        }
        statements.extend([
            format!("let mut value = [0; {}];", value.size_bytes()),
            format!(
                "for (at, level) in [{}].into_iter().enumerate() {{ \
                 {}.store_at(u64::from(level), &mut value, at); }}",
                levels.join(", "),
                scalar(value.scalar)
            ),
            format!(
                "BOARD.report({filter}, tables::{}, Outcome::Fresh, &mut value);",
                wired.device.ident.to_uppercase()
            ),
        ]);
    }
    task.ticks(cycle.delay_ms, statements, &constant);
    section.items.push(Item::Task(task));
    let call = format!("{ident}({})", arguments.join(", "));
    section.starts.push(Start::Task(cycle.prio, call));
    let device = devices.first().map_or(0, |one| one.device.device.id.value);
    section.watched.push(Watched::new(constant, cycle, device));
    Ok(())
}

/// An encoder: its timers count in hardware.
fn encoder(
    context: &Context<'_>,
    encoder: &dyn Encoder,
    wired: &Wired<'_>,
    section: &mut Section,
) -> Printed<()> {
    let mut counts = Vec::new();
    for wire in &wired.wires {
        let counter = encoder.counter(context, wire, section)?;
        counts.push(counters::keep(wire, counter, section));
    }
    counters::poll(context, wired, &counts, section);
    Ok(())
}
