//! Parts on register buses, as I²C and SPI have them alike: which task serves which part.

use std::collections::BTreeMap;

use sensedsl_model::design::PartIndex;

use super::context::{Context, late};
use super::section::{Section, Start, Watched};
use super::{chip, filter};
use crate::job::{Cycle, JobConnection};
use crate::part::BusPlan;
use crate::print::snake;

/// Time for a part to think, beside the bits.
const TIMEOUT_BASE_MS: u32 = 10;

/// A bus with what is on it.
pub(super) struct Bus<'a> {
    pub(super) unit: &'a str,
    /// The runtime's type of it.
    pub(super) type_: &'static str,
    pub(super) on_bus: &'a [&'a JobConnection<'a>],
    /// Bits a second of the slowest part.
    pub(super) hz: u32,
}

/// A part that a task serves.
pub(super) struct Served<'a> {
    pub(super) plan: BusPlan,
    pub(super) wire: &'a JobConnection<'a>,
}

/// How a task of a bus reaches its parts.
pub(super) struct Reach {
    /// Parameters of the task beside the bus.
    pub(super) parameters: String,
    /// What they are called with.
    pub(super) arguments: String,
    /// Statements that make `NAME_line` for each part.
    pub(super) lines: String,
}

/// The tasks of a bus: one for each cycle.
pub(super) fn tasks(
    context: &Context<'_>,
    bus: &Bus<'_>,
    reach: impl Fn(&[Served<'_>]) -> Reach,
    section: &mut Section,
) {
    for (cycle, served) in cycles(context, bus) {
        task(context, bus, cycle, &served, &reach(&served), section);
    }
}

/// The parts of each cycle, in the design's order.
fn cycles<'a>(context: &Context<'_>, bus: &Bus<'a>) -> BTreeMap<Cycle, Vec<Served<'a>>> {
    let mut known: Vec<PartIndex> = Vec::new();
    let mut cycles: BTreeMap<Cycle, Vec<Served<'a>>> = BTreeMap::new();
    for wire in bus.on_bus {
        let plan = context.job.tables_of(wire).and_then(|plan| plan.bus.clone());
        let Some(plan) = plan.filter(|_| !known.contains(&wire.connection.part)) else { continue };
        known.push(wire.connection.part);
        cycles.entry(wire.cycle).or_default().push(Served { plan, wire });
    }
    cycles
}

fn task(
    context: &Context<'_>,
    bus: &Bus<'_>,
    cycle: Cycle,
    served: &[Served<'_>],
    reach: &Reach,
    section: &mut Section,
) {
    let ident = cycle.ident(bus.unit);
    let constant = ident.to_uppercase();
    let bytes = served.iter().map(|one| one.plan.work_bytes + 4).max().unwrap_or(4);
    let bits_ms =
        u32::try_from(bytes).unwrap_or(u32::MAX).saturating_mul(2 * 9 * 1_000) / bus.hz.max(1);
    let mut text = format!(
        "/// {}.\n#[embassy_executor::task]\nasync fn {ident}(bus: &'static {}{}) {{\n{}",
        cycle.title(bus.unit),
        bus.type_,
        reach.parameters,
        late(cycle)
    );
    text.push_str(&reach.lines);
    for Served { plan, .. } in served {
        section.tables.push(chip::table(context, plan));
        text.push_str(&state(plan));
    }
    let is_own = |part: PartIndex| served.iter().any(|one| one.wire.connection.part == part);
    let (filters, pass) = filter::of_parts(context, is_own, section);
    text.push_str(&filters);
    text.push_str(&format!(
        "    let timeout = Duration::from_millis({});\n    loop {{\n        let mut idle_ms = {};\n        \
         let mut tell = |index: usize, outcome, value: &mut [u8]| BOARD.tell({pass}, index, outcome, value);\n",
        TIMEOUT_BASE_MS + bits_ms,
        cycle.delay_ms
    ));
    for Served { plan, .. } in served {
        text.push_str(&turn(&plan.prefix, !plan.commands.is_empty()));
    }
    text.push_str(&format!(
        "        WATCH.beat(tables::{constant}, now_ms());\n        \
         Timer::after_millis(u64::from(idle_ms.max(1))).await;\n    }}\n}}"
    ));
    section.items.push(text);
    let call = format!("{ident}({}{})", snake(bus.unit), reach.arguments);
    section.starts.push(Start::Task(cycle.prio, call));
    let device = served.first().map_or(0, |one| context.id_of(one.wire));
    section.watched.push(Watched::new(constant, cycle, device));
    section.runtime.insert("bus.rs");
}

/// What a task keeps of a part.
fn state(plan: &BusPlan) -> String {
    let (ident, table) = (&plan.prefix, plan.prefix.to_uppercase());
    let mut text = format!(
        "    let mut {ident}: Chip<[u8; tables::{table}_CHIP.chip_bytes(&SCHEMA)]> = \
         Chip::new(&tables::{table}_CHIP, &SCHEMA);\n"
    );
    if !plan.commands.is_empty() {
        text.push_str(&format!(
            "    let mut {ident}_written = [Written::NEW; {}];\n",
            plan.commands.len()
        ));
    }
    text
}

/// What a task does with a part in each cycle.
fn turn(ident: &str, has_commands: bool) -> String {
    let mut text = format!(
        "        idle_ms = idle_ms.min(rt::bus::serve(&mut {ident}_line, &mut {ident}, timeout, &mut tell).await);\n"
    );
    if has_commands {
        text.push_str(&format!(
            "        let value = &mut [0; SCHEMA.value_bytes_max()];\n        \
             rt::bus::write(&mut {ident}_line, &mut {ident}, &mut {ident}_written, timeout, &BOARD, value).await;\n"
        ));
    }
    text
}
