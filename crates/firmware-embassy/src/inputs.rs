//! Digital inputs and encoders: a task for each cycle looks at them.

use sensedsl_diagnostics::Diagnostic;
use sensedsl_model::kind::{KindName, Role};
use sensedsl_wire::Direction;

use super::context::{Context, Wired, scalar};
use super::item::{Item, Task};
use super::lack::{self, Printed};
use super::section::{Field, Keep, Section, Start, Watched};
use super::{contacts, filter};
use sensedsl_job::{Cycle, JobConnection};

pub(super) fn plan(context: &Context<'_>, diagnostics: &mut Vec<Diagnostic>) -> Section {
    let mut section = Section::default();
    for ((_, cycle), devices) in context.classes(KindName::Digital) {
        let has_edges = |one: &Wired<'_>| {
            one.first.connection.kind.digital().is_some_and(|own| own.edge.is_some())
        };
        // Those with edges are the reporter's.
        let is_read =
            |one: &&Wired<'_>| one.device.device.direction == Direction::Sensor && !has_edges(one);
        let sensors: Vec<&Wired<'_>> = devices.iter().filter(is_read).collect();
        if let Some(first) = sensors.first() {
            let made = digital(context, cycle, &sensors, &mut section);
            context.tell(first.first.part, made, diagnostics);
        }
    }
    for wired in context.wired(KindName::Encoder) {
        let made = encoder(context, &wired, &mut section);
        context.tell(wired.first.part, made, diagnostics);
    }
    section
}

fn digital(
    context: &Context<'_>,
    cycle: Cycle,
    devices: &[&Wired<'_>],
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
                (lack::pad(wire, Role::In)?, lack::kind(wire.connection.kind.digital())?);
            if contacts::is_kept(own) {
                let not = if own.active_low { "!" } else { "" };
                levels.push(format!("{not}{}.level()", contacts::name(wire)));
                continue;
            }
            section.fields.push(Field {
                name: wire.ident.clone(),
                comment: wire.place(),
                type_: "Input<'static>".to_owned(),
                make: format!(
                    "Input::new(p.{}, {})",
                    context.pin(&pad.pin.name),
                    contacts::pull(own)
                ),
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

/// An encoder: its timers count in hardware, and the reporter looks at them.
fn encoder(context: &Context<'_>, wired: &Wired<'_>, section: &mut Section) -> Printed<()> {
    let mut counts = Vec::new();
    for wire in &wired.wires {
        counter(context, wire, section)?;
        counts.push(format!("{}_qei.count()", wire.ident));
    }
    poll_counts(context, wired, &counts, section);
    Ok(())
}

/// The reporter looks at counters of 16 bits so often that no wrap is lost. `counts`: an expression for each wire.
pub(super) fn poll_counts(
    context: &Context<'_>,
    wired: &Wired<'_>,
    counts: &[String],
    section: &mut Section,
) {
    let filter = filter::polled(context, wired.index, section);
    let (ident, value) = (&wired.device.ident, wired.device.device.value.value);
    section.states.push(format!("let mut {ident}_counters = [Counter::NEW; {}];", counts.len()));
    section.states.push(format!("let mut {ident}_repeat = Repeat::NEW;"));
    let mut poll = vec![format!("let before = {ident}_counters.map(|counter| counter.total());")];
    let steps = counts.iter().enumerate();
    poll.extend(steps.map(|(at, count)| format!("{ident}_counters[{at}].step({count});")));
    poll.push(format!("let counts = {ident}_counters.map(|counter| counter.total());"));
    let store = format!(
        "store_count({}, i64::from(count), value.get_mut(at * {}..).unwrap_or_default());",
        scalar(value.scalar),
        value.scalar.size_bytes()
    );
    poll.push(format!("if {ident}_repeat.is_due(counts != before, 1_000, now_ms()) {{"));
    poll.push(format!("    let mut value = [0; {}];", value.size_bytes()));
    poll.push(format!("    for (at, count) in counts.into_iter().enumerate() {{ {store} }}"));
    poll.push(format!(
        "    BOARD.report({filter}, tables::{}, Outcome::Fresh, &mut value);",
        wired.device.ident.to_uppercase()
    ));
    poll.push("}".to_owned());
    section.polls.push(poll);
}

/// The timer of two tracks, which the reporter keeps.
fn counter(context: &Context<'_>, wire: &JobConnection<'_>, section: &mut Section) -> Printed<()> {
    let unit = lack::unit(wire)?;
    let (a, b) = (lack::pad(wire, Role::A)?, lack::pad(wire, Role::B)?);
    let hal = context.peripheral(unit);
    // The HAL takes either order of the channels.
    let type_of = |channel| format!("hal::timer::Ch{channel}");
    let (first, second) = (type_of(lack::channel(a)?), type_of(lack::channel(b)?));
    let type_ = format!("hal::timer::qei::Qei<'static, {hal}>");
    section.fields.push(Field {
        name: wire.ident.clone(),
        comment: wire.place(),
        type_: type_.clone(),
        make: format!(
            "hal::timer::qei::Qei::new{}(p.{hal}, p.{}, p.{}, Default::default())",
            context.generics(unit, &[&first, &second]),
            a.pin.name,
            b.pin.name
        ),
    });
    let from = format!("wiring.{}", wire.ident);
    section.keeps.push(Keep { name: format!("{}_qei", wire.ident), type_, from });
    Ok(())
}
