//! The tables of a part on a bus in Rust: constants of the runtime's types.

use sensedsl_model::protocol::{Crc, Formula};
use sensedsl_model::words::Code;

use super::context::Context;
use super::item::{Constant, Entry, Table};
use super::missing::Printed;
use sensedsl_job::part::{BusPlan, CommandPlan, InitPlan, ReadingPlan, TransferPlan, ValuePlan};

/// The table of a part on a register bus.
pub(super) fn table(context: &Context<'_>, plan: &BusPlan) -> Printed<Constant> {
    let mut members = Vec::new();
    if !plan.init.is_empty() {
        members.push(("init", Entry::Many(init(&plan.init))));
    }
    if let Some(one) = &plan.identity {
        let (select, expected, mask) = (bytes(&one.select), bytes(&one.expected), bytes(&one.mask));
        let identity =
            format!("Some(Identity {{ select: {select}, expected: {expected}, mask: {mask} }})");
        members.push(("identity", Entry::One(identity)));
    }
    if !plan.calibration.is_empty() {
        let blocks = plan.calibration.iter().map(|block| {
            format!("Calibration {{ select: {}, count: {} }}", bytes(&block.select), block.count)
        });
        members.push(("calibration", Entry::Many(blocks.collect())));
    }
    members.push(("transfers", Entry::Many(plan.transfers.iter().map(transfer).collect())));
    let readings = plan.readings.iter().map(|one| reading(context, one));
    members.push(("readings", Entry::Many(readings.collect::<Printed<_>>()?)));
    if !plan.commands.is_empty() {
        let commands = plan.commands.iter().map(|one| command(context, one));
        members.push(("commands", Entry::Many(commands.collect::<Printed<_>>()?)));
    }
    if !plan.kept.is_empty() {
        members.push(("kept", Entry::One(bytes(&plan.kept))));
    }
    if let Some(one) = plan.formula {
        members.push(("formula", Entry::One(format!("Some({})", formula(one)))));
        let parameters: Vec<String> = plan.parameters.iter().map(ToString::to_string).collect();
        members.push(("parameters", Entry::One(format!("&[{}]", parameters.join(", ")))));
    }
    members.push(("cycle_ms", Entry::One(plan.cycle_ms.to_string())));
    members.push(("address", Entry::One(byte(plan.address))));
    let name = format!("{}_CHIP", plan.prefix.to_uppercase());
    Ok(Constant::Table(Table { name, type_: "ChipTable", members, has_more: true }))
}

/// `0x3b`
pub(super) fn byte(byte: u8) -> String {
    format!("0x{byte:02x}")
}

pub(super) fn bytes(all: &[u8]) -> String {
    let all: Vec<String> = all.iter().copied().map(byte).collect();
    format!("&[{}]", all.join(", "))
}

/// The steps that set a part up.
pub(super) fn init(steps: &[InitPlan]) -> Vec<String> {
    let step = |step: &InitPlan| {
        format!("InitStep {{ bytes: {}, pause_ms: {} }}", bytes(&step.bytes), step.pause_ms)
    };
    steps.iter().map(step).collect()
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
        Formula::Hx711 => "sense_rt::HX711",
    }
}

pub(super) fn coding(plan: &ValuePlan) -> String {
    let code = match plan.code {
        Code::Integer => "Code::Integer",
        Code::Float => "Code::Float",
        Code::Bcd => "Code::Bcd",
        Code::Magnitude => "Code::Magnitude",
        Code::Packed => "Code::Packed",
        Code::Pulses => "Code::Pulses",
        Code::Leds => "Code::Leds",
        Code::Text => "Code::Text",
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
