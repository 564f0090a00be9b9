//! The tables of a chip in Rust: constants of the runtime's types.

use sensedsl_model::protocol::{Crc, Formula};
use sensedsl_model::words::Code;

use super::context::Context;
use super::lack::Printed;
use sensedsl_job::part::{BusPlan, CommandPlan, InitPlan, ReadingPlan, TransferPlan, ValuePlan};

/// The table of a part on a register bus.
pub(super) fn table(context: &Context<'_>, plan: &BusPlan) -> Printed<String> {
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
    let readings = plan.readings.iter().map(|one| reading(context, one));
    line("readings", list(readings.collect::<Printed<Vec<String>>>()?.into_iter()));
    if !plan.commands.is_empty() {
        let commands = plan.commands.iter().map(|one| command(context, one));
        line("commands", list(commands.collect::<Printed<Vec<String>>>()?.into_iter()));
    }
    if !plan.kept.is_empty() {
        line("kept", bytes(&plan.kept));
    }
    if let Some(one) = plan.formula {
        line("formula", format!("Some({})", formula(one)));
        let parameters: Vec<String> = plan.parameters.iter().map(ToString::to_string).collect();
        line("parameters", format!("&[{}]", parameters.join(", ")));
    }
    line("cycle_ms", plan.cycle_ms.to_string());
    line("address", byte(plan.address));
    text.push_str("    ..ChipTable::NEW\n};");
    Ok(text)
}

pub(super) fn list(entries: impl Iterator<Item = String>) -> String {
    let entries: String = entries.map(|entry| format!("        {entry},\n")).collect();
    format!("&[\n{entries}    ]")
}

/// `0x3b`
pub(super) fn byte(byte: u8) -> String {
    format!("0x{byte:02x}")
}

pub(super) fn bytes(all: &[u8]) -> String {
    let all: Vec<String> = all.iter().copied().map(byte).collect();
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

fn reading(context: &Context<'_>, plan: &ReadingPlan) -> Printed<String> {
    let output = plan.output.map_or("None".to_owned(), |output| format!("Some({output})"));
    let value = plan.value.as_ref().map_or("Coding::NEW".to_owned(), coding);
    Ok(format!(
        "Reading {{ item: {}, offset: {}, transfer: {}, output: {output}, value: {value} }}",
        context.item(&plan.field)?,
        plan.offset,
        plan.transfer
    ))
}

fn command(context: &Context<'_>, plan: &CommandPlan) -> Printed<String> {
    let own = plan.own.as_ref().map_or("..Command::NEW".to_owned(), |own| {
        format!("own: {}, kept: {}", bytes(&own.bits), own.kept)
    });
    Ok(format!(
        "Command {{ prefix: {}, item: {}, value: {}, {own} }}",
        bytes(&plan.prefix),
        context.item(&plan.field)?,
        coding(&plan.value)
    ))
}

/// The runtime's formula.
pub(super) const fn formula(formula: Formula) -> &'static str {
    match formula {
        Formula::Bmp280 => "sense_rt::BMP280",
        Formula::Bme280 => "sense_rt::BME280",
        Formula::Ntc => "sense_rt::NTC",
        Formula::Tsl2561 => "sense_rt::TSL2561",
    }
}

pub(super) fn coding(plan: &ValuePlan) -> String {
    let code = match plan.code {
        Code::Integer => "Code::Integer",
        Code::Float => "Code::Float",
        Code::Bcd => "Code::Bcd",
        Code::Packed => "Code::Packed",
    };
    let crc = match plan.crc {
        None => "Crc::None",
        Some(Crc::Sensirion) => "Crc::Sensirion",
    };
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
