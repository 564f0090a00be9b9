//! The tables of a serial device in Rust: constants of the runtime's types.

use super::chip::{byte, bytes, coding, init, list};
use super::context::Context;
use crate::part::{ComposePlan, MessageFieldPlan, MessagePlan};

/// The tables of a device: its messages, how it is set up, and what it is sent.
pub(super) fn tables(context: &Context<'_>, plan: &MessagePlan) -> Vec<String> {
    let name = plan.prefix.to_uppercase();
    let mut tables = Vec::new();
    if !plan.init.is_empty() {
        tables
            .push(format!("pub const {name}_INIT: &[InitStep] = {};", flat(&init(&plan.init), 1)));
    }
    if !plan.fields.is_empty() {
        tables.push(format!(
            "pub const {name}_MESSAGE: MessageTable = MessageTable {{\n    start: {},\n    end: {},\n    \
             fields: {},\n    length: {},\n    bytes_max: {},\n    checksum: {},\n    checksum_from: {},\n}};",
            bytes(&plan.start),
            bytes(&plan.end),
            list(plan.fields.iter().map(|one| field(context, one))),
            plan.length,
            plan.bytes_max,
            checksum(plan.checksum),
            plan.checksum_from
        ));
    }
    tables.extend(plan.commands.iter().map(|one| compose(context, one)));
    tables
}

/// What the table of a message that is sent is called.
pub(super) fn compose_name(context: &Context<'_>, plan: &ComposePlan) -> String {
    let device = context.job.devices.get(context.item(&plan.field));
    format!("{}_COMPOSE", device.map_or("", |one| one.ident.as_str()).to_uppercase())
}

fn compose(context: &Context<'_>, plan: &ComposePlan) -> String {
    format!(
        "pub const {}: Compose = Compose {{\n    start: {},\n    end: {},\n    value: {},\n    checksum: {},\n    \
         checksum_from: {},\n}};",
        compose_name(context, plan),
        bytes(&plan.start),
        bytes(&plan.end),
        coding(&plan.value),
        checksum(plan.checksum),
        plan.checksum_from
    )
}

/// The checksum in the runtime's words.
fn checksum(name: &str) -> &'static str {
    match name {
        "UP_CHECKSUM_SUM8" => "MessageChecksum::Sum8",
        "UP_CHECKSUM_XOR8" => "MessageChecksum::Xor8",
        "UP_CHECKSUM_IBUS" => "MessageChecksum::Ibus",
        "UP_CHECKSUM_CRC8_DVB_S2" => "MessageChecksum::Crc8DvbS2",
        "UP_CHECKSUM_NMEA" => "MessageChecksum::Nmea",
        _ => "MessageChecksum::None",
    }
}

fn field(context: &Context<'_>, plan: &MessageFieldPlan) -> String {
    let item = context.item(&plan.field);
    if let Some(value) = &plan.value {
        return format!(
            "MessageField {{ item: {item}, byte: {}, value: {}, ..MessageField::NEW }}",
            plan.byte,
            coding(value)
        );
    }
    let format = match plan.format {
        "UP_FORMAT_DEGREES" => "Degrees",
        "UP_FORMAT_HEX" => "Hex",
        _ => "Decimal",
    };
    // A C string is one of Rust's: the model takes letters and digits.
    let sentence = plan.sentence.as_ref().map_or("None".to_owned(), |one| format!("Some(b{one})"));
    format!(
        "MessageField {{ item: {item}, format: FieldFormat::{format}, sentence: {sentence}, separator: {}, index: {}, \
         decimals: {}, ..MessageField::NEW }}",
        byte(&plan.separator),
        plan.index,
        plan.decimals
    )
}

/// A list that stands so many steps further left.
fn flat(text: &str, steps: usize) -> String {
    text.replace(&format!("\n{}", "    ".repeat(steps)), "\n")
}
