//! Digital inputs with a memory: those whose edges count, and those whose level counts once it has lasted.

use std::collections::BTreeMap;

use sensedsl_diagnostics::Diagnostic;
use sensedsl_model::kind::digital::{Digital, Edge, Pull};
use sensedsl_model::kind::{KindName, Role};
use sensedsl_wire::Direction;

use super::context::{Context, Wired, scalar};
use super::filter;
use super::hal::contract::Drivers;
use super::hal::contract::inputs::{EdgeInput, WatchedBy};
use super::item::{Handler, Item, Task};
use super::missing::{self, Missing, Printed};
use super::section::{Constructor, Field, Section, Start};
use sensedsl_job::JobConnection;

pub(super) fn plan(
    context: &Context<'_>,
    drivers: &dyn Drivers,
    diagnostics: &mut Vec<Diagnostic>,
) -> Section {
    let mut section = Section::default();
    let mut shared: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for wired in context.wired(KindName::Digital) {
        let own = wired.first.connection.kind.digital();
        let Some(own) = own.filter(|own| is_kept(own)) else { continue };
        if wired.device.device.direction == Direction::Actuator {
            continue;
        }
        for wire in &wired.wires {
            let input = Input { wire, own, prio: wired.device.cycle.prio };
            let made = input.plan(context, drivers, &mut shared, &mut section);
            context.report(wire.part, made, diagnostics);
        }
        if own.edge.is_some() {
            poll(context, &wired, own, &mut section);
        }
    }
    for (interrupt, statics) in shared {
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
    format!("{}_STATE", wire.ident.to_uppercase())
}

/// The resistor in the words of all HALs.
pub(super) const fn pull(own: &Digital) -> &'static str {
    match own.pull {
        Pull::Up => "Pull::Up",
        Pull::Down => "Pull::Down",
        Pull::None => "Pull::None",
    }
}

/// An input with a memory.
#[derive(Clone, Copy)]
struct Input<'a> {
    wire: &'a JobConnection<'a>,
    own: &'a Digital,
    prio: i8,
}

impl Input<'_> {
    /// The input with its static. `shared`: the statics by the interrupt that the project has the handler of.
    fn plan(
        self,
        context: &Context<'_>,
        drivers: &dyn Drivers,
        shared: &mut BTreeMap<String, Vec<String>>,
        section: &mut Section,
    ) -> Printed<()> {
        let Self { wire, own, .. } = self;
        let kept = name(wire);
        let (kind, made) = if own.edge.is_some() {
            ("rt::edges::InterruptInput", self.watched(context, drivers, shared, section)?)
        } else {
            section.polls.push(vec![format!("{kept}.sample();")]);
            ("rt::edges::SampledInput", self.sampled(drivers, section)?)
        };
        section.fields.push(Field::of(wire.ident.clone(), wire.place(), made));
        let edge = match own.edge {
            Some(Edge::Rising) => "Rising",
            Some(Edge::Falling) => "Falling",
            Some(Edge::Both) | None => "Both",
        };
        section.items.push(Item::Static {
            doc: wire.place(),
            line: format!(
                "static {kept}: {kind} = rt::contact::Watched::new(sense_rt::ContactConfig {{ \
                 lasting: {}, edge: sense_rt::Edge::{edge} }});",
                own.debounce_us
            ),
        });
        Ok(())
    }

    /// An input whose level the reporter reads in each cycle.
    fn sampled(self, drivers: &dyn Drivers, section: &mut Section) -> Printed<Constructor> {
        let pad = missing::pad(self.wire, Role::In)?;
        section.begins.push(format!("{}.begin(wiring.{});", name(self.wire), self.wire.ident));
        Ok(Constructor {
            type_: "Input<'static>".to_owned(),
            make: format!(
                "Input::new(p.{}, {})",
                drivers.pins().pin(&pad.pin.name),
                pull(self.own)
            ),
        })
    }

    /// An input whose edges interrupt.
    fn watched(
        self,
        context: &Context<'_>,
        drivers: &dyn Drivers,
        shared: &mut BTreeMap<String, Vec<String>>,
        section: &mut Section,
    ) -> Printed<Constructor> {
        let Self { wire, own, prio } = self;
        let (pad, kept) = (missing::pad(wire, Role::In)?, name(wire));
        // A level that must last has to be seen when it comes and when it goes.
        let trigger = match own.edge {
            Some(Edge::Rising) if own.debounce_us == 0 => "Rising",
            Some(Edge::Falling) if own.debounce_us == 0 => "Falling",
            Some(Edge::Rising | Edge::Falling | Edge::Both) | None => "Any",
        };
        let edges = drivers.edges().ok_or_else(|| Missing::unit("edges".to_owned()))?;
        let input = EdgeInput { wire, pad, pull: pull(own), trigger, kept: &kept };
        let watch = edges.watch(context, &input)?;
        section.begins.push(format!("{kept}.begin({});", watch.begin));
        match watch.by {
            WatchedBy::Handler(interrupt) => shared.entry(interrupt).or_default().push(kept),
            WatchedBy::Task(statement) => {
                let ident = &wire.ident;
                let doc = format!("{}: its edges", wire.place());
                let mut task = Task::new(doc, format!("{ident}_edges"));
                task.parameters.push(format!("pin: {}", watch.made.type_));
                task.before.push(statement);
                section.items.push(Item::Task(task));
                let call = format!("{ident}_edges(wiring.{ident})");
                section.starts.push(Start::Task(prio, call));
            }
        }
        Ok(watch.made)
    }
}

/// The handler of an interrupt, which inputs may share.
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
