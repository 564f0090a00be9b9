//! Slices of the PWM unit as inputs: the hardware counts edges, or ticks while the pin is active.

use sensedsl_model::kind::Role;
use sensedsl_model::kind::icu::{Edge, Icu, Mode};

use crate::context::{Context, Wired};
use crate::icu::{poll, seen};
use crate::inputs::poll_counts;
use crate::item::{Item, Task};
use crate::lack::{self, Missing, Printed};
use crate::section::{Field, Keep, Section, Start};
use sensedsl_job::JobConnection;

/// The fractional divider of a slice has eight bits and four behind the point.
const SIXTEENTHS: std::ops::RangeInclusive<u32> = 16..=0xFFF;

/// A device with its slices.
pub(crate) fn device(
    context: &Context<'_>,
    wired: &Wired<'_>,
    icu: &Icu,
    section: &mut Section,
) -> Printed<()> {
    if icu.mode == Mode::Count {
        return count(context, wired, icu, section);
    }
    for wire in &wired.wires {
        gate(context, wire, icu, wired.device.cycle.prio, section)?;
    }
    poll(context, wired, icu, section);
    Ok(())
}

/// A slice that measures widths, with the task that waits for the ends of pulses.
fn gate(
    context: &Context<'_>,
    wire: &JobConnection<'_>,
    icu: &Icu,
    prio: i8,
    section: &mut Section,
) -> Printed<()> {
    let (unit, pad) = (lack::unit(wire)?, lack::pad(wire, Role::In)?);
    let sixteenths = sixteenths(context, unit, icu.tick_hz)?;
    let ident = &wire.ident;
    section.fields.push(Field {
        name: ident.clone(),
        comment: wire.place(),
        type_: "crate::rt::gate::Gate".to_owned(),
        make: format!(
            "crate::rt::gate::Gate::new(p.{}, p.{}, {sixteenths}, {})",
            context.peripheral(unit),
            context.pin(&pad.pin.name),
            icu.edge != Edge::Falling
        ),
    });
    let upper = ident.to_uppercase();
    section.items.push(Item::Line(seen(&upper)));
    let mut task = Task::new(wire.place(), format!("{ident}_edges"));
    task.parameters.push("gate: rt::gate::Gate".to_owned());
    task.before.push(format!("rt::gate::measure(gate, &{upper}_SEEN).await;"));
    section.items.push(Item::Task(task));
    section.starts.push(Start::Task(prio, format!("{ident}_edges(wiring.{ident})")));
    Ok(())
}

/// Sixteenths of clocks in a tick, which must be whole.
fn sixteenths(context: &Context<'_>, unit: &str, tick_hz: u32) -> Printed<u32> {
    let clock_hz = timer_hz(context, unit)?;
    let whole = (clock_hz.checked_mul(16))
        .filter(|clocks| tick_hz > 0 && clocks.is_multiple_of(tick_hz))
        .map(|clocks| clocks / tick_hz)
        .or_else(|| {
            (tick_hz > 0 && clock_hz.is_multiple_of(tick_hz)).then(|| clock_hz / tick_hz * 16)
        });
    whole.filter(|whole| SIXTEENTHS.contains(whole)).ok_or_else(|| {
        Missing::unit(format!("a resolution of {tick_hz} Hz, made of {clock_hz} Hz by at most 255"))
    })
}

/// The clock of a slice.
pub(super) fn timer_hz(context: &Context<'_>, unit: &str) -> Printed<u32> {
    let clock = context.profile.timer(unit).map(|timer| timer.clock.as_str());
    let hz = clock.and_then(|clock| context.profile.clocks_hz.get(clock)).copied();
    hz.ok_or_else(|| Missing::name(format!("the clock of {unit}")))
}

/// Slices that count edges, which the reporter looks at.
fn count(
    context: &Context<'_>,
    wired: &Wired<'_>,
    icu: &Icu,
    section: &mut Section,
) -> Printed<()> {
    let edge = match icu.edge {
        Edge::Rising | Edge::Both => "RisingEdge",
        Edge::Falling => "FallingEdge",
    };
    let mut counts = Vec::new();
    for wire in &wired.wires {
        let (unit, pad) = (lack::unit(wire)?, lack::pad(wire, Role::In)?);
        let type_ = "rt::gate::Edges";
        section.fields.push(Field {
            name: wire.ident.clone(),
            comment: wire.place(),
            type_: format!("crate::{type_}"),
            make: format!(
                "crate::{type_}::new(p.{}, p.{}, hal::pwm::InputMode::{edge})",
                context.peripheral(unit),
                context.pin(&pad.pin.name)
            ),
        });
        section.keeps.push(Keep {
            name: format!("{}_slice", wire.ident),
            type_: type_.to_owned(),
            from: format!("wiring.{}", wire.ident),
        });
        counts.push(format!("{}_slice.count()", wire.ident));
    }
    poll_counts(context, wired, &counts, section);
    Ok(())
}
