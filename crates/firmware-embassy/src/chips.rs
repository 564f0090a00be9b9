//! Parts on register buses, both I²C and SPI: which task serves which part.

use std::collections::BTreeMap;

use sensedsl_board::signal::UnitName;
use sensedsl_diagnostics::Diagnostic;
use sensedsl_model::kind::KindName;

use super::context::Context;
use super::item::{Item, Task, beat};
use super::missing::{self, Missing, Printed};
use super::section::{Field, Section, Start, Watched};
use super::{chip, filter};
use sensedsl_job::part::BusPlan;
use sensedsl_job::snake;
use sensedsl_job::{Cycle, JobConnection, by_unit};

/// The time that a part may take to answer, besides the time of the bits.
const TIMEOUT_BASE_MS: u32 = 10;

/// A bus with the connections on it.
pub(super) struct Bus<'a> {
    pub(super) unit: UnitName,
    /// The runtime's type of it.
    type_: String,
    /// One of the connections on it: all have the wires of the bus.
    pub(super) first: &'a JobConnection<'a>,
    pub(super) all: Vec<&'a JobConnection<'a>>,
}

/// The buses of a kind; `type_` is the runtime's type of one.
pub(super) fn buses<'a>(
    context: &Context<'a>,
    kind: KindName,
    type_: impl Fn(&UnitName) -> String,
    diagnostics: &mut Vec<Diagnostic>,
) -> Vec<Bus<'a>> {
    for wire in context.connections(kind) {
        context.report(wire.part, missing::unit(wire).map(drop), diagnostics);
    }
    let buses = by_unit(context.connections(kind)).into_iter();
    let bus = |(unit, all): (UnitName, Vec<&'a JobConnection<'a>>)| {
        Some(Bus { type_: type_(&unit), unit, first: all.first()?, all })
    };
    buses.filter_map(bus).collect()
}

impl<'a> Bus<'a> {
    /// A wire, named after its pin, with the parts on it.
    pub(super) fn of_wire(
        unit: UnitName,
        type_: String,
        all: &[&'a JobConnection<'a>],
    ) -> Option<Self> {
        Some(Self { unit, type_, first: all.first()?, all: all.to_vec() })
    }
}

impl Bus<'_> {
    /// The names of the connections, for a comment.
    pub(super) fn titles(&self) -> String {
        let titles: Vec<&str> = self.all.iter().map(|one| one.title.as_str()).collect();
        titles.join(", ")
    }

    /// Hands the bus over to its tasks, which take turns.
    pub(super) fn share(&self, field: Field, section: &mut Section) {
        let Self { unit, type_, .. } = self;
        section.items.push(Item::Line(format!(
            "static {unit}_BUS: StaticCell<{type_}> = StaticCell::new();"
        )));
        section.starts.push(Start::Make(format!(
            "let {0}: &'static {type_} = {unit}_BUS.init(Mutex::new(wiring.{0}));",
            field.name
        )));
        section.fields.push(field);
    }
}

/// A part that a task serves.
pub(super) struct Served<'a> {
    pub(super) plan: BusPlan,
    pub(super) wire: &'a JobConnection<'a>,
}

/// How a task of a bus reaches its parts.
#[derive(Default)]
pub(super) struct Reach {
    /// Parameters of the task besides the bus.
    pub(super) parameters: Vec<String>,
    /// The arguments for them.
    pub(super) arguments: Vec<String>,
    /// Statements that make `{part}_line` for each part.
    pub(super) lines: Vec<String>,
}

/// The tasks of a bus: one for each cycle. `hz` is the clock of the slowest part.
pub(super) fn tasks(
    context: &Context<'_>,
    bus: &Bus<'_>,
    hz: u32,
    reach: impl Fn(&[Served<'_>]) -> Printed<Reach>,
    section: &mut Section,
) -> Printed<()> {
    for (cycle, served) in cycles(context, bus)? {
        task(context, bus, hz, cycle, &served, reach(&served)?, section)?;
    }
    Ok(())
}

/// The parts of each cycle, in the design's order.
fn cycles<'a>(context: &Context<'_>, bus: &Bus<'a>) -> Printed<BTreeMap<Cycle, Vec<Served<'a>>>> {
    let mut cycles: BTreeMap<Cycle, Vec<Served<'a>>> = BTreeMap::new();
    for wire in &bus.all {
        let plan = context.job.bus_of(wire).ok_or_else(|| Missing::table("registers"))?.clone();
        cycles.entry(wire.cycle).or_default().push(Served { plan, wire });
    }
    Ok(cycles)
}

/// The task that serves the parts of one cycle.
fn task(
    context: &Context<'_>,
    bus: &Bus<'_>,
    hz: u32,
    cycle: Cycle,
    served: &[Served<'_>],
    reach: Reach,
    section: &mut Section,
) -> Printed<()> {
    let ident = cycle.ident(bus.unit.as_str());
    let constant = ident.to_uppercase();
    let bytes = served.iter().map(|one| one.plan.work_bytes + 4).max().unwrap_or(4);
    let bits_ms =
        u32::try_from(bytes).unwrap_or(u32::MAX).saturating_mul(2 * 9 * 1_000) / hz.max(1);
    let title = cycle.title(bus.unit.as_str());
    let mut task = Task::in_turn(title, ident.clone(), cycle);
    task.parameters.push(format!("bus: &'static {}", bus.type_));
    task.parameters.extend(reach.parameters);
    task.before = reach.lines;
    for Served { plan, .. } in served {
        section.tables.push(chip::table(context, plan)?);
        task.before.extend(state(plan));
    }
    let is_own = |index: usize| served.iter().any(|one| one.wire.devices.contains(&index));
    let (filters, pass) = filter::of_items(context, is_own, section);
    task.before.extend(filters);
    task.before
        .push(format!("let timeout = Duration::from_millis({});", TIMEOUT_BASE_MS + bits_ms));
    task.cycle = vec![
        format!("let mut idle_ms = {};", cycle.delay_ms),
        format!(
            "let mut report = |index: usize, outcome, value: &mut [u8]| BOARD.report({pass}, index, outcome, value);"
        ),
    ];
    for Served { plan, .. } in served {
        task.cycle.extend(turn(&plan.prefix, !plan.commands.is_empty()));
    }
    task.cycle.push(beat(&constant));
    task.cycle.push("rt::bus::rest(idle_ms).await;".to_owned());
    section.items.push(Item::Task(task));
    let arguments = std::iter::once(snake(bus.unit.as_str())).chain(reach.arguments);
    let call = format!("{ident}({})", arguments.collect::<Vec<_>>().join(", "));
    section.starts.push(Start::Task(cycle.prio, call));
    let device = served.first().map_or(0, |one| context.id_of(one.wire));
    section.watched.push(Watched::new(constant, cycle, device));
    Ok(())
}

/// The variables of a task for a part.
fn state(plan: &BusPlan) -> Vec<String> {
    let (ident, table) = (&plan.prefix, plan.prefix.to_uppercase());
    let mut statements = vec![format!(
        "let mut {ident}: Chip<[u8; tables::{table}_CHIP.chip_bytes(&SCHEMA)]> = \
         Chip::new(&tables::{table}_CHIP, &SCHEMA);"
    )];
    if !plan.commands.is_empty() {
        let count = plan.commands.len();
        statements.push(format!("let mut {ident}_written = [Written::NEW; {count}];"));
    }
    statements
}

/// What a task does with a part in each cycle.
fn turn(ident: &str, has_commands: bool) -> Vec<String> {
    let mut statements = vec![format!(
        "idle_ms = idle_ms.min(rt::bus::serve(&mut {ident}_line, &mut {ident}, timeout, &mut report).await);"
    )];
    if has_commands {
        statements.push("let value = &mut [0; SCHEMA.value_bytes_max()];".to_owned());
        statements.push(format!(
            "rt::bus::write(&mut {ident}_line, &mut {ident}, &mut {ident}_written, timeout, &BOARD, value).await;"
        ));
    }
    statements
}
