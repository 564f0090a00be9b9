//! Pulses that make rangefinders measure: a task for each cycle and length.

use sensedsl_diagnostics::Diagnostic;
use sensedsl_model::kind::Role;

use super::context::Context;
use super::hal::contract::Drivers;
use super::hal::contract::outputs::{Pins, Speed};
use super::item::{Item, Task};
use super::missing::{self, Printed};
use super::section::{Field, Section, Start, Watched};
use sensedsl_job::kinds::pulse::{Pulses, pulses};

pub(super) fn plan(
    context: &Context<'_>,
    drivers: &dyn Drivers,
    diagnostics: &mut Vec<Diagnostic>,
) -> Section {
    let mut section = Section::default();
    for one in pulses(context.job) {
        let made = task(drivers.pins(), &one, &mut section);
        if let Some(first) = one.lines.first() {
            context.report(first.wire.part, made, diagnostics);
        }
    }
    section
}

fn task(pins: &dyn Pins, pulses: &Pulses<'_>, section: &mut Section) -> Printed<()> {
    let Pulses { cycle, pulse_us, id, lines } = pulses;
    let ident = format!("{}_{pulse_us}us", cycle.ident("pulse"));
    let constant = ident.to_uppercase();
    let mut task = Task::in_turn(cycle.title("pulse"), ident.clone(), *cycle);
    let (mut arguments, mut statements) = (Vec::new(), Vec::new());
    for line in lines {
        let pad = missing::pad(line.wire, Role::Trigger)?;
        let ident = format!("{}_trigger", line.wire.ident);
        section.fields.push(Field {
            name: ident.clone(),
            comment: format!("{}: the pulse that makes it measure", line.wire.title),
            type_: "Output<'static>".to_owned(),
            make: pins.output(&pad.pin.name, "Level::Low", Speed::Low),
        });
        task.parameters.push(format!("mut {ident}: Output<'static>"));
        arguments.push(format!("wiring.{ident}"));
        statements.push(format!("rt::capture::pulse(&mut {ident}, {pulse_us}).await;"));
        if line.apart_ms > 0 {
            statements.push(format!("Timer::after_millis({}).await;", line.apart_ms));
        }
    }
    task.ticks(cycle.delay_ms, statements, &constant);
    section.items.push(Item::Task(task));
    let call = format!("{ident}({})", arguments.join(", "));
    section.starts.push(Start::Task(cycle.prio, call));
    section.watched.push(Watched::new(constant, *cycle, *id));
    Ok(())
}
