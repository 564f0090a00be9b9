//! The tables of a serial device in Rust: constants of the runtime's types.

use sensedsl_model::kind::uart::MessageChecksum;
use sensedsl_model::protocol::Format;

use super::chip::{byte, bytes, coding, init};
use super::context::Context;
use super::item::{Constant, Entry, Table};
use super::missing::Printed;
use sensedsl_job::part::{ComposePlan, ExchangePlan, FieldCoding, MessageFieldPlan, MessagePlan};

/// The tables of a device: its messages, how it is set up, and what is sent to it.
pub(super) fn tables(context: &Context<'_>, plan: &MessagePlan) -> Printed<Vec<Constant>> {
    let name = plan.prefix.to_uppercase();
    let mut tables = Vec::new();
    if !plan.init.is_empty() {
        let declaration = format!("{name}_INIT: &[InitStep]");
        tables.push(Constant::List { doc: "", declaration, entries: init(&plan.init) });
    }
    let fields = fields(context, &plan.fields)?;
    if !fields.is_empty() {
        let members = vec![
            ("start", Entry::One(bytes(&plan.start))),
            ("end", Entry::One(bytes(&plan.end))),
            ("fields", Entry::Many(fields)),
            ("length", Entry::One(plan.length.to_string())),
            ("bytes_max", Entry::One(plan.bytes_max.to_string())),
            ("checksum", Entry::One(checksum(plan.checksum).to_owned())),
            ("checksum_from", Entry::One(plan.checksum_from.to_string())),
        ];
        let name = format!("{name}_MESSAGE");
        let table = Table { name, type_: "MessageTable", members, has_more: false };
        tables.push(Constant::Table(table));
    }
    for command in &plan.commands {
        tables.push(Constant::Table(compose(context, command)?));
    }
    for exchange in &plan.exchanges {
        tables.push(Constant::Table(answer(context, exchange)?));
    }
    if !plan.exchanges.is_empty() {
        let declaration = format!("{name}_EXCHANGES: &[sense_rt::Exchange]");
        let entries = plan.exchanges.iter().map(asked).collect();
        tables.push(Constant::List { doc: "", declaration, entries });
    }
    Ok(tables)
}

fn fields(context: &Context<'_>, all: &[MessageFieldPlan]) -> Printed<Vec<String>> {
    all.iter().map(|one| field(context, one)).collect()
}

/// The message that answers a request.
fn answer(context: &Context<'_>, plan: &ExchangePlan) -> Printed<Table> {
    let members = vec![
        ("start", Entry::One(bytes(&plan.start))),
        ("end", Entry::One(bytes(&plan.end))),
        ("fields", Entry::Many(fields(context, &plan.fields)?)),
        ("length", Entry::One(plan.length.to_string())),
        ("bytes_max", Entry::One(plan.bytes_max.to_string())),
        ("checksum", Entry::One(checksum(plan.checksum).to_owned())),
        ("checksum_from", Entry::One(plan.checksum_from.to_string())),
    ];
    let name = plan.prefix.to_uppercase();
    Ok(Table { name, type_: "MessageTable", members, has_more: false })
}

/// A request, and the name of its answer's table.
fn asked(plan: &ExchangePlan) -> String {
    format!(
        "sense_rt::Exchange {{ request: {}, answer: &{}, is_primed: {}, wait_ms: {} }}",
        bytes(&plan.request),
        plan.prefix.to_uppercase(),
        plan.is_primed,
        plan.wait_ms
    )
}

/// The name of the table for a message that is sent.
pub(super) fn compose_name(context: &Context<'_>, plan: &ComposePlan) -> Printed<String> {
    let device = context.job.devices.get(context.item(&plan.field)?);
    Ok(format!("{}_COMPOSE", device.map_or("", |one| one.ident.as_str()).to_uppercase()))
}

fn compose(context: &Context<'_>, plan: &ComposePlan) -> Printed<Table> {
    let mut members = vec![
        ("start", bytes(&plan.start)),
        ("behind", bytes(&plan.behind)),
        ("end", bytes(&plan.end)),
        ("value", coding(&plan.value)),
        ("checksum", checksum(plan.checksum).to_owned()),
        ("checksum_from", plan.checksum_from.to_string()),
    ];
    if let Some(text) = &plan.text {
        members.push(("format", format!("FieldFormat::{}", format_of(text.format))));
        members.push(("separator", byte(text.separator.unwrap_or(0))));
        members.push(("decimals", text.decimals.to_string()));
    }
    Ok(Table {
        name: compose_name(context, plan)?,
        type_: "Compose",
        members: members.into_iter().map(|(name, value)| (name, Entry::One(value))).collect(),
        has_more: plan.text.is_none(),
    })
}

const fn format_of(format: Format) -> &'static str {
    match format {
        Format::Decimal => "Decimal",
        Format::Degrees => "Degrees",
        Format::Hex => "Hex",
    }
}

/// The checksum in the runtime's words.
const fn checksum(checksum: MessageChecksum) -> &'static str {
    match checksum {
        MessageChecksum::None => "MessageChecksum::None",
        MessageChecksum::Sum8 => "MessageChecksum::Sum8",
        MessageChecksum::Xor8 => "MessageChecksum::Xor8",
        MessageChecksum::Ibus => "MessageChecksum::Ibus",
        MessageChecksum::Crc8DvbS2 => "MessageChecksum::Crc8DvbS2",
        MessageChecksum::Crc8Ld06 => "MessageChecksum::Crc8Ld06",
        MessageChecksum::Sum16 => "MessageChecksum::Sum16",
        MessageChecksum::Nmea => "MessageChecksum::Nmea",
        MessageChecksum::Sum7 => "MessageChecksum::Sum7",
        MessageChecksum::NotSum8 => "MessageChecksum::NotSum8",
        MessageChecksum::NegSum8 => "MessageChecksum::NegSum8",
        MessageChecksum::NegSum16 => "MessageChecksum::NegSum16",
        MessageChecksum::Crc16Umts => "MessageChecksum::Crc16Umts",
        MessageChecksum::Crc16Xmodem => "MessageChecksum::Crc16Xmodem",
        MessageChecksum::Slamtec => "MessageChecksum::Slamtec",
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
    let format = format_of(text.format);
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
