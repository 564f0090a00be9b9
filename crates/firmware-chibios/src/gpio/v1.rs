//! `GPIOv1`: a register field moves all signals of a peripheral from one block of pins to another.

use std::collections::BTreeMap;

use sensedsl_board::remap::Blocks;
use sensedsl_board::signal::UnitName;
use sensedsl_diagnostics::Diagnostic;
use sensedsl_diagnostics::codes::e0506_hardware_limit;

use crate::context::Context;
use crate::section::Section;
use sensedsl_files::{block, templates};

templates! {
    s: Plan;
    Remaps = "gpio/v1.c.txt";
}

struct Plan {
    /// The titles for people: `USART1 in block 1`.
    titles: Vec<String>,
    /// The fields of each register in use.
    registers: Vec<Register>,
}

/// `AFIO->MAPR`
struct Register {
    name: String,
    fields: Vec<Field>,
    /// True if the debug port has its field in this register, too.
    has_debug: bool,
}

/// `AFIO_MAPR_USART1_REMAP` and its value.
struct Field {
    name: String,
    block: u8,
}

/// The register with the field of the debug port, which does not read back as written.
const DEBUG: &str = "MAPR";

/// Pins that the debug port holds until it is limited to two wires.
const OF_DEBUG: [&str; 3] = ["PA15", "PB3", "PB4"];

pub(super) fn plan(context: &Context<'_>, diagnostics: &mut Vec<Diagnostic>) -> Section {
    let mut fields: BTreeMap<String, Vec<Field>> = BTreeMap::new();
    let mut titles = Vec::new();
    for (unit, blocks) in blocks(context) {
        let block = blocks.first();
        // Board tables may call the only unit of a kind by its name without a number.
        let name = context.profile.unit(unit.as_str()).map_or(unit.as_str(), |unit| &unit.name);
        let Some(field) = context.names.remap(name) else {
            diagnostics.extend((block > 0).then(|| unknown(context, &unit, block)));
            continue;
        };
        let register = field.split('_').nth(1).unwrap_or(DEBUG).to_owned();
        titles.push(format!("{unit} in block {block}"));
        fields.entry(register).or_default().push(Field { name: field, block });
    }
    let uses_debug = context.job.all_pads().any(|pad| OF_DEBUG.contains(&pad.pin.name.as_str()));
    if uses_debug {
        fields.entry(DEBUG.to_owned()).or_default();
        titles.push("the debug port on two wires".to_owned());
    }
    let registers = fields.into_iter().map(|(name, fields)| Register {
        has_debug: name == DEBUG,
        name,
        fields,
    });
    let plan = Plan { titles, registers: registers.collect() };
    let mut section = Section { pads: super::released(context), ..Section::default() };
    if !plan.registers.is_empty() {
        section.tables = block(&Remaps { s: &plan });
        section.starts.push("choose_pins();".to_owned());
    }
    section
}

/// The blocks that all signals of a peripheral have in common; the wiring ensures that there is one.
fn blocks(context: &Context<'_>) -> BTreeMap<UnitName, Blocks> {
    let mut all: BTreeMap<UnitName, Blocks> = BTreeMap::new();
    for usage in context.job.all_pads().filter_map(|pad| pad.usage) {
        let Some(own) = usage.blocks else { continue };
        for unit in usage.signal.function().units() {
            let common = all.get(&unit).map_or(Some(own), |blocks| blocks.and(own));
            all.extend(common.map(|common| (unit, common)));
        }
    }
    all
}

fn unknown(context: &Context<'_>, unit: &UnitName, block: u8) -> Diagnostic {
    let span = context.job.board.name.span;
    let message =
        format!("{unit} is on the pins of its block {block}, and how to move it there is unknown");
    let help = "fix its wires to pins of block 0, or to another unit";
    e0506_hardware_limit::hardware_limit(span, &message, help)
}
