//! The tables of a serial device in Rust: constants of the runtime's types.

use sensedsl_model::kind::uart::MessageChecksum;
use sensedsl_model::protocol::Format;

use super::chip::{byte, bytes, coding, init, list};
use super::context::Context;
use super::lack::Printed;
use sensedsl_job::part::{ComposePlan, FieldCoding, MessageFieldPlan, MessagePlan};

/// The tables of a device: its messages, how it is set up, and what it is sent.
pub(super) fn tables(context: &Context<'_>, plan: &MessagePlan) -> Printed<Vec<String>> {
    let name = plan.prefix.to_uppercase();
    let mut tables = Vec::new();
    if !plan.init.is_empty() {
        tables
            .push(format!("pub const {name}_INIT: &[InitStep] = {};", flat(&init(&plan.init), 1)));
    }
    let fields = plan.fields.iter().map(|one| field(context, one)).collect::<Printed<Vec<_>>>()?;
    if !fields.is_empty() {
        tables.push(format!(
            "pub const {name}_MESSAGE: MessageTable = MessageTable {{\n    start: {},\n    end: {},\n    \
             fields: {},\n    length: {},\n    bytes_max: {},\n    checksum: {},\n    checksum_from: {},\n}};",
            bytes(&plan.start),
            bytes(&plan.end),
            list(fields.into_iter()),
            plan.length,
            plan.bytes_max,
            checksum(plan.checksum),
            plan.checksum_from
        ));
    }
    for command in &plan.commands {
        tables.push(compose(context, command)?);
    }
    Ok(tables)
}

/// What the table of a message that is sent is called.
pub(super) fn compose_name(context: &Context<'_>, plan: &ComposePlan) -> Printed<String> {
    let device = context.job.devices.get(context.item(&plan.field)?);
    Ok(format!("{}_COMPOSE", device.map_or("", |one| one.ident.as_str()).to_uppercase()))
}

fn compose(context: &Context<'_>, plan: &ComposePlan) -> Printed<String> {
    Ok(format!(
        "pub const {}: Compose = Compose {{\n    start: {},\n    end: {},\n    value: {},\n    checksum: {},\n    \
         checksum_from: {},\n}};",
        compose_name(context, plan)?,
        bytes(&plan.start),
        bytes(&plan.end),
        coding(&plan.value),
        checksum(plan.checksum),
        plan.checksum_from
    ))
}

/// The checksum in the runtime's words.
const fn checksum(checksum: MessageChecksum) -> &'static str {
    match checksum {
        MessageChecksum::None => "MessageChecksum::None",
        MessageChecksum::Sum8 => "MessageChecksum::Sum8",
        MessageChecksum::Xor8 => "MessageChecksum::Xor8",
        MessageChecksum::Ibus => "MessageChecksum::Ibus",
        MessageChecksum::Crc8DvbS2 => "MessageChecksum::Crc8DvbS2",
        MessageChecksum::Nmea => "MessageChecksum::Nmea",
    }
}

fn field(context: &Context<'_>, plan: &MessageFieldPlan) -> Printed<String> {
    let item = context.item(&plan.field)?;
    let text = match &plan.how {
        FieldCoding::Binary { byte, value } => {
            return Ok(format!(
                "MessageField {{ item: {item}, byte: {byte}, value: {}, ..MessageField::NEW }}",
                coding(value)
            ));
        }
        FieldCoding::Text(text) => text,
    };
    let format = match text.format {
        Format::Decimal => "Decimal",
        Format::Degrees => "Degrees",
        Format::Hex => "Hex",
    };
    let sentence = text.sentence.as_deref();
    let sentence = sentence
        .map_or("None".to_owned(), |one| format!("Some(b\"{}\")", one.as_bytes().escape_ascii()));
    Ok(format!(
        "MessageField {{ item: {item}, format: FieldFormat::{format}, sentence: {sentence}, separator: {}, index: {}, \
         decimals: {}, ..MessageField::NEW }}",
        byte(text.separator.unwrap_or(0)),
        text.field,
        text.decimals
    ))
}

/// The list with its indent reduced by `steps`.
fn flat(text: &str, steps: usize) -> String {
    text.replace(&format!("\n{}", "    ".repeat(steps)), "\n")
}
