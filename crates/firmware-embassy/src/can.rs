//! CAN: a task for each bus that takes frames as they come; the reporter sends what the host has set.

use sensedsl_diagnostics::Diagnostic;
use sensedsl_model::kind::{KindName, Role};
use sensedsl_timing::can_bit;

use super::chip::coding;
use super::context::Context;
use super::filter;
use super::hal::contract::Drivers;
use super::hal::contract::buses::Can;
use super::item::{Constant, Item, Task, beat};
use super::missing::{self, Missing, Printed};
use super::section::{Field, Keep, Section, Start, Watched};
use sensedsl_job::kinds::can::{Bus, Frame, Identifier, Value, buses};
use sensedsl_job::snake;

pub(super) fn plan(
    context: &Context<'_>,
    drivers: &dyn Drivers,
    diagnostics: &mut Vec<Diagnostic>,
) -> Section {
    let mut section = Section::default();
    let Some(can) = drivers.can() else { return section };
    for wire in context.connections(KindName::Can) {
        context.report(wire.part, missing::unit(wire).map(drop), diagnostics);
    }
    for bus in buses(context.job, context.connections(KindName::Can), diagnostics) {
        let made = plan_bus(context, can, &bus, &mut section);
        context.report(bus.first.part, made, diagnostics);
    }
    section
}

/// An identifier in the runtime's words. The model has seen to it that it fits into its bits.
fn identifier((identifier, is_extended): Identifier) -> String {
    if is_extended {
        format!("crate::rt::can::extended({identifier:#X})")
    } else {
        format!("crate::rt::can::standard({identifier:#X})")
    }
}

/// The half of a bus that sends.
fn keep(parameter: &str, name: &str) -> Keep {
    Keep {
        name: parameter.to_owned(),
        type_: "rt::can::Sender".to_owned(),
        from: format!("{name}_tx"),
    }
}

/// A bus with its tables and its two halves.
fn plan_bus(
    context: &Context<'_>,
    can: &dyn Can,
    bus: &Bus<'_>,
    section: &mut Section,
) -> Printed<()> {
    let name = snake(bus.unit);
    let (rx, tx) = (missing::pad(bus.first, Role::Rx)?, missing::pad(bus.first, Role::Tx)?);
    let made = can.controller(context, bus, section)?;
    let who: Vec<&str> = bus.wires.iter().map(|one| one.title.as_str()).collect();
    let (rx, tx, who) = (&rx.pin.name, &tx.pin.name, who.join(", "));
    let comment = format!("{} at {rx} (RX) and {tx} (TX): {who}", bus.unit);
    section.fields.push(Field::of(name.clone(), comment, made));
    start(context, can, bus, &name, section)?;
    tables(bus, section);
    listen(context, bus, &name, section);
    say(bus, &name, section);
    Ok(())
}

/// The statement that turns the bus on and splits it into its halves.
fn start(
    context: &Context<'_>,
    can: &dyn Can,
    bus: &Bus<'_>,
    name: &str,
    section: &mut Section,
) -> Printed<()> {
    let (upper, hal) = (bus.unit.to_uppercase(), context.peripheral(bus.unit));
    let memory = format!("static {upper}_STATE: rt::can::Memory = rt::can::Memory::new();");
    section.items.push(Item::Line(memory));
    let filters = can.filters(context, bus, section)?;
    let wanted: Vec<String> =
        filters.wanted.unwrap_or_default().into_iter().map(identifier).collect();
    section.starts.push(Start::Make(format!(
        "let ({name}_tx, {name}_rx) = \
         rt::can::start(wiring.{name}, hal::pac::{hal}, {}&{upper}_STATE, {}, &[{}]);",
        filters.place,
        bit(context, bus)?,
        wanted.join(", ")
    )));
    Ok(())
}

/// The timing of a bit.
fn bit(context: &Context<'_>, bus: &Bus<'_>) -> Printed<String> {
    let hz = context.unit_hz(bus.unit);
    let hz = hz.ok_or_else(|| Missing::name(format!("the clock of {}", bus.unit)))?;
    let dividers = context.profile.can_dividers.as_ref();
    let bit = dividers.and_then(|dividers| can_bit(dividers, hz, bus.bitrate_hz));
    let bit = bit.ok_or_else(|| Missing::name(format!("dividers of {}", bus.unit)))?;
    Ok(format!(
        "rt::can::Bit {{ divider: {}, before: {}, after: {}, jump: {} }}",
        bit.divider,
        bit.before,
        bit.behind,
        bit.jump()
    ))
}

/// A mask for the bits that select a frame, and their values.
fn select((mask, bits): (u64, u64)) -> String {
    format!("({mask:#x}, {bits:#x})")
}

/// The tables of the values: those that are received, and those that are sent.
fn tables(bus: &Bus<'_>, section: &mut Section) {
    let value = |one: &Value| {
        format!(
            "(MessageField {{ item: {}, byte: {}, value: {}, ..MessageField::NEW }}, {}, {}, {})",
            one.index,
            one.byte,
            coding(&one.how),
            identifier(one.identifier()),
            one.device.cycle.delay_ms,
            select(one.select.unwrap_or_default())
        )
    };
    let upper = bus.unit.to_uppercase();
    section.tables.push(Constant::List {
        doc: "Values in frames: where, in which frame, and how often they are reported",
        declaration: format!("{upper}_VALUES: &[crate::rt::can::Value]"),
        entries: bus.values.iter().map(value).collect(),
    });
    for one in bus.frames.iter().flat_map(|frame| &frame.values).filter(|one| !one.is_quiet) {
        section.tables.push(Constant::Line(format!(
            "pub const {upper}_SENT_{}: Coding = {};",
            one.index,
            coding(&one.how)
        )));
    }
}

/// The task that takes the frames of a bus.
fn listen(context: &Context<'_>, bus: &Bus<'_>, name: &str, section: &mut Section) {
    let upper = bus.unit.to_uppercase();
    let is_own = |index: usize| bus.wires.iter().any(|one| one.devices.contains(&index));
    let (filters, pass) = filter::of_items(context, is_own, section);
    let constant = format!("{upper}_LISTEN");
    let sent = bus.frames.iter().flat_map(|frame| &frame.values).filter(|one| !one.is_quiet);
    let sent: Vec<usize> = sent.map(|one| one.index).collect();
    let mut task = Task::new(format!("{}: frames that come", bus.unit), format!("{name}_listen"));
    task.parameters.push("receiver: rt::can::Receiver".to_owned());
    task.before = filters;
    task.before.extend([
        format!("let turns = &mut [rt::can::Turn::NEW; tables::{upper}_VALUES.len()];"),
        "let value = &mut [0; SCHEMA.value_bytes_max()];".to_owned(),
        format!(
            "let mut bus = rt::can::Bus {{ receiver, schema: &SCHEMA, values: tables::{upper}_VALUES, \
             sent: &{sent:?}, turns, value }};"
        ),
    ]);
    task.cycle = vec![
        format!("let until = Instant::now() + Duration::from_millis({});", bus.cycle.delay_ms),
        format!(
            "let mut report = |index: usize, outcome, value: &mut [u8]| BOARD.report({pass}, index, outcome, value);"
        ),
        "bus.receive(until, &mut report).await;".to_owned(),
        beat(&constant),
    ];
    section.items.push(Item::Task(task));
    let call = format!("{name}_listen({name}_rx)");
    section.starts.push(Start::Task(bus.cycle.prio, call));
    let device = context.id_of(bus.first);
    section.watched.push(Watched::new(constant, bus.cycle, device));
}

/// Where a value is in its frame.
fn place(one: &Value<'_>) -> String {
    let masked = if one.mask == 0 { String::new() } else { format!(".masked({:#x})", one.mask) };
    let quiet = if one.is_quiet { ".quiet()" } else { "" };
    format!("rt::can::Place::new({}){masked}{quiet}", one.byte)
}

/// A frame as it is before the host sets anything.
fn sent(frame: &Frame<'_>) -> String {
    let new = format!("rt::can::Sent::new({}, {})", identifier(frame.identifier()), frame.bytes);
    let repeated = match frame.resend_ms {
        0 => String::new(),
        every_ms => format!(".repeated({every_ms})"),
    };
    let selected = match frame.start {
        0 => String::new(),
        _ => format!(".selected({:?})", frame.start_bytes()),
    };
    format!("{new}{repeated}{selected}, ")
}

/// The reporter has the half that sends: a frame for which there is no room is sent in a later cycle.
fn say(bus: &Bus<'_>, name: &str, section: &mut Section) {
    let upper = bus.unit.to_uppercase();
    if bus.frames.is_empty() {
        // To drop this half would turn the bus off.
        section.keeps.push(keep(&format!("_{name}_tx"), name));
        return;
    }
    let frames: String = bus.frames.iter().map(sent).collect();
    section.items.push(Item::Line(format!(
        "static {upper}_FRAMES: rt::can::Frames<{}> = rt::can::frames([{frames}]);",
        bus.frames.len()
    )));
    for (at, frame) in bus.frames.iter().enumerate() {
        for one in &frame.values {
            section.sets.entry(one.index).or_default().push(format!(
                "rt::can::set(&{upper}_FRAMES, {at}, &tables::{upper}_SENT_{}, &SCHEMA, {}, value, {}, &BOARD);",
                one.index, one.index, place(one)
            ));
        }
    }
    if bus.frames.iter().any(|frame| frame.resend_ms > 0) {
        section.hushes.push(format!("rt::can::stop_repeats(&{upper}_FRAMES);"));
    }
    section.keeps.push(keep(&format!("mut {name}_tx"), name));
    section.polls.push(vec![format!("rt::can::send(&mut {name}_tx, &{upper}_FRAMES);")]);
}
