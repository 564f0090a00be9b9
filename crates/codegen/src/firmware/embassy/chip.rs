//! The tables of a chip in Rust: constants of the runtime's types.

use super::context::Context;
use crate::part::{BusPlan, CommandPlan, InitPlan, ReadingPlan, TransferPlan, ValuePlan};

/// The table of a part on a register bus.
pub(super) fn table(context: &Context<'_>, plan: &BusPlan) -> String {
    let name = plan.prefix.to_uppercase();
    let mut text = format!("pub const {name}_CHIP: ChipTable = ChipTable {{\n");
    let mut line = |what: &str, value: String| {
        text.push_str(&format!("    {what}: {value},\n"));
    };
    if !plan.init.is_empty() {
        line("init", init(&plan.init));
    }
    if let Some(one) = &plan.identity {
        let (select, expected, mask) = (bytes(&one.select), bytes(&one.expected), bytes(&one.mask));
        line(
            "identity",
            format!("Some(Identity {{ select: {select}, expected: {expected}, mask: {mask} }})"),
        );
    }
    if !plan.calibration.is_empty() {
        let blocks = plan.calibration.iter().map(|block| {
            format!("Calibration {{ select: {}, count: {} }}", bytes(&block.select), block.count)
        });
        line("calibration", list(blocks));
    }
    line("transfers", list(plan.transfers.iter().map(transfer)));
    line("readings", list(plan.readings.iter().map(|one| reading(context, one))));
    if !plan.commands.is_empty() {
        line("commands", list(plan.commands.iter().map(|one| command(context, one))));
    }
    if let Some(formula) = plan.formula.and_then(|one| one.strip_prefix("up_formula_")) {
        line("formula", format!("Some(sense_rt::{})", formula.to_uppercase()));
        let parameters: Vec<String> = plan.parameters.iter().map(ToString::to_string).collect();
        line("parameters", format!("&[{}]", parameters.join(", ")));
    }
    line("cycle_ms", plan.cycle_ms.to_string());
    line("address", byte(&plan.address));
    text.push_str("    ..ChipTable::NEW\n};");
    text
}

pub(super) fn list(entries: impl Iterator<Item = String>) -> String {
    let entries: String = entries.map(|entry| format!("        {entry},\n")).collect();
    format!("&[\n{entries}    ]")
}

/// A byte of a plan, which is spelled as C has it.
pub(super) fn byte(c: &str) -> String {
    c.trim_end_matches('U').to_owned()
}

pub(super) fn bytes(all: &[String]) -> String {
    let all: Vec<String> = all.iter().map(|one| byte(one)).collect();
    format!("&[{}]", all.join(", "))
}

/// How a part is set up.
pub(super) fn init(steps: &[InitPlan]) -> String {
    list(steps.iter().map(|step| {
        format!("InitStep {{ bytes: {}, pause_ms: {} }}", bytes(&step.bytes), step.pause_ms)
    }))
}

fn transfer(plan: &TransferPlan) -> String {
    format!(
        "Transfer {{ trigger: {}, select: {}, cycle_ms: {}, wait_ms: {}, length: {}, exchange: {} }}",
        bytes(&plan.trigger),
        bytes(&plan.select),
        plan.cycle_ms,
        plan.wait_ms,
        plan.length,
        plan.is_exchange
    )
}

fn reading(context: &Context<'_>, plan: &ReadingPlan) -> String {
    let output = plan.output.map_or("None".to_owned(), |output| format!("Some({output})"));
    let value = plan.value.as_ref().map_or("Coding::NEW".to_owned(), coding);
    format!(
        "Reading {{ item: {}, offset: {}, transfer: {}, output: {output}, value: {value} }}",
        context.item(&plan.field),
        plan.offset,
        plan.transfer
    )
}

fn command(context: &Context<'_>, plan: &CommandPlan) -> String {
    format!(
        "Command {{ prefix: {}, item: {}, value: {} }}",
        bytes(&plan.prefix),
        context.item(&plan.field),
        coding(&plan.value)
    )
}

pub(super) fn coding(plan: &ValuePlan) -> String {
    let code = match plan.code {
        "UP_CODE_FLOAT" => "Code::Float",
        "UP_CODE_BCD" => "Code::Bcd",
        "UP_CODE_PACKED" => "Code::Packed",
        _ => "Code::Integer",
    };
    let crc = if plan.crc == "UP_CRC_SENSIRION" { "Crc::Sensirion" } else { "Crc::None" };
    format!(
        "Coding {{ elements: &{:?}, words: {}, code: {code}, crc: {crc}, word_bytes: {}, low: {}, bits: {}, \
         is_signed: {}, is_little_endian: {} }}",
        plan.elements,
        plan.words,
        plan.word_bytes,
        plan.low,
        plan.bits,
        plan.is_signed,
        plan.is_little_endian
    )
}
