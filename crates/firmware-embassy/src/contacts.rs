//! Digital inputs with a memory: those whose edges interrupt, and those whose level counts when it has lasted.

use std::collections::BTreeMap;

use sensedsl_diagnostics::Diagnostic;
use sensedsl_model::kind::digital::{Digital, Edge, Pull};
use sensedsl_model::kind::{KindName, Role};
use sensedsl_wire::Direction;

use super::context::{Context, Wired, scalar};
use super::hal::Hal;
use super::item::{Handler, Item};
use super::lack::{self, Printed};
use super::section::{Field, Section};
use super::{filter, rp};
use sensedsl_job::{JobConnection, Pad};

pub(super) fn plan(context: &Context<'_>, diagnostics: &mut Vec<Diagnostic>) -> Section {
    let mut section = Section::default();
    let mut lines: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for wired in context.wired(KindName::Digital) {
        let own = wired.first.connection.kind.digital();
        let Some(own) = own.filter(|own| is_kept(own)) else { continue };
        if wired.device.device.direction == Direction::Actuator {
            continue;
        }
        for wire in &wired.wires {
            let prio = wired.device.cycle.prio;
            let made = input(context, wire, (own, prio), &mut lines, &mut section);
            context.tell(wire.part, made, diagnostics);
        }
        if own.edge.is_some() {
            poll(context, &wired, own, &mut section);
        }
    }
    for (interrupt, statics) in lines {
        handler(&interrupt, &statics, &mut section);
    }
    section
}

/// Whether more is wanted of an input than its level now.
pub(super) fn is_kept(own: &Digital) -> bool {
    own.edge.is_some() || own.debounce_us > 0
}

/// The static of an input.
pub(super) fn name(wire: &JobConnection<'_>) -> String {
    format!("{}_KEPT", wire.ident.to_uppercase())
}

/// The resistor in the HAL's words.
pub(super) const fn pull(own: &Digital) -> &'static str {
    match own.pull {
        Pull::Up => "Pull::Up",
        Pull::Down => "Pull::Down",
        Pull::None => "Pull::None",
    }
}

fn input(
    context: &Context<'_>,
    wire: &JobConnection<'_>,
    (own, prio): (&Digital, i8),
    lines: &mut BTreeMap<String, Vec<String>>,
    section: &mut Section,
) -> Printed<()> {
    let pad = lack::pad(wire, Role::In)?;
    let kept = name(wire);
    let edge = match own.edge {
        Some(Edge::Rising) => "Rising",
        Some(Edge::Falling) => "Falling",
        Some(Edge::Both) | None => "Both",
    };
    let (kind, type_, make) = if own.edge.is_some() {
        // A level that is to last must be seen to come and to go.
        let trigger = match own.edge {
            Some(Edge::Rising) if own.debounce_us == 0 => "Rising",
            Some(Edge::Falling) if own.debounce_us == 0 => "Falling",
            Some(Edge::Rising | Edge::Falling | Edge::Both) | None => "Any",
        };
        match context.names.hal {
            Hal::Stm32 => awaited(context, (wire, pad), own, trigger, (lines, section))?,
            Hal::Rp => rp::edges::input(context, wire, (pad, own), prio, trigger, section),
        }
    } else {
        let make = format!("Input::new(p.{}, {})", context.pin(&pad.pin.name), pull(own));
        section.begins.push(format!("{kept}.begin(wiring.{});", wire.ident));
        ("rt::edges::SampledInput", "Input<'static>".to_owned(), make)
    };
    section.fields.push(Field { name: wire.ident.clone(), comment: wire.place(), type_, make });
    section.items.push(Item::Static {
        doc: wire.place(),
        line: format!(
            "static {kept}: {kind} = rt::contact::Watched::new(sense_rt::ContactConfig {{ \
             lasting: {}, edge: sense_rt::Edge::{edge} }});",
            own.debounce_us
        ),
    });
    if own.edge.is_none() {
        section.polls.push(vec![format!("{kept}.sample();")]);
    }
    Ok(())
}

/// An input whose edges interrupt on a line: the static's kind, the type of what the wiring hands over, and what that is
/// made of.
fn awaited(
    context: &Context<'_>,
    (wire, pad): (&JobConnection<'_>, &Pad<'_>),
    own: &Digital,
    trigger: &str,
    (lines, section): (&mut BTreeMap<String, Vec<String>>, &mut Section),
) -> Printed<(&'static str, String, String)> {
    let (pin, kept) = (&pad.pin.name, name(wire));
    let line = pin.number().ok_or_else(|| lack::Missing::wire("a pin of a port".to_owned()))?;
    let line = format!("EXTI{line}");
    let interrupt = context.interrupt(&line, "GLOBAL")?.to_owned();
    section.begins.push(format!("{kept}.begin(wiring.{});", wire.ident));
    lines.entry(interrupt).or_default().push(kept);
    Ok((
        "rt::edges::InterruptInput",
        "hal::exti::ExtiInput<'static, hal::mode::Blocking>".to_owned(),
        format!(
            "hal::exti::ExtiInput::new_blocking(p.{pin}, p.{line}, {}, hal::exti::TriggerEdge::{trigger})",
            pull(own)
        ),
    ))
}

/// The handler of an interrupt, which lines may share.
fn handler(interrupt: &str, statics: &[String], section: &mut Section) {
    let name = format!("{interrupt}_EDGES");
    section.bind(interrupt, format!("crate::{name}"));
    section.items.push(Item::Handler(Handler {
        doc: "Edges on the lines of this interrupt".to_owned(),
        name,
        named_as: "the interrupt",
        interrupt: interrupt.to_owned(),
        calls: statics.iter().map(|one| format!("{one}.on_interrupt();")).collect(),
    }));
    section.begins.push("// Its handler is there.".to_owned());
    section.begins.push(format!("unsafe {{ interrupt::{interrupt}.enable() }};"));
}

/// The reporter takes what the interrupts have seen.
fn poll(context: &Context<'_>, wired: &Wired<'_>, own: &Digital, section: &mut Section) {
    let filter = filter::polled(context, wired.index, section);
    let (ident, value) = (&wired.device.ident, wired.device.device.value.value);
    let size = value.scalar.size_bytes();
    let count = wired.wires.len();
    section.states.push(format!("let mut {ident}_told = [rt::contact::Reported::NEW; {count}];"));
    section.states.push(format!("let mut {ident}_repeat = Repeat::NEW;"));
    let bytes = value.size_bytes();
    let mut poll = vec![format!("let (mut value, mut is_news) = ([0; {bytes}], false);")];
    poll.extend(wired.wires.iter().enumerate().map(|(at, wire)| {
        format!(
            "is_news |= {}.take(&mut {ident}_told[{at}], {}, {}, &mut value[{}..]);",
            name(wire),
            scalar(value.scalar),
            own.active_low,
            at * size
        )
    }));
    poll.push(format!(
        "if {ident}_repeat.is_due(is_news, {}, now_ms()) {{ \
         BOARD.report({filter}, tables::{}, Outcome::Fresh, &mut value); }}",
        wired.device.cycle.delay_ms,
        wired.device.ident.to_uppercase()
    ));
    section.polls.push(poll);
}
