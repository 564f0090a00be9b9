//! CAN: a task for each bus, which takes frames as they come; the reporter sends what the host has set.

use sensedsl_board::signal::UnitName;
use sensedsl_diagnostics::Diagnostic;
use sensedsl_model::kind::{KindName, Role};
use sensedsl_timing::can_bit;

use super::chip::coding;
use super::context::Context;
use super::filter;
use super::item::{Constant, Item, Task, beat};
use super::lack::{self, Missing, Printed};
use super::section::{Field, Keep, Section, Start, Watched};
use sensedsl_job::kinds::can::{BANKS, Bus, Frame, Identifier, Value, buses};
use sensedsl_job::snake;

/// Controllers with banks of filters are alone, or two of these; the third of a chip has banks of its own.
const FIRST: &str = "CAN1";
const SECOND: &str = "CAN2";

pub(super) fn plan(context: &Context<'_>, diagnostics: &mut Vec<Diagnostic>) -> Section {
    let mut section = Section::default();
    for wire in context.connections(KindName::Can) {
        context.tell(wire.part, lack::unit(wire).map(drop), diagnostics);
    }
    for bus in buses(context.job, context.connections(KindName::Can), diagnostics) {
        let made = plan_bus(context, &bus, &mut section);
        context.tell(bus.first.part, made, diagnostics);
    }
    section
}

/// An identifier in the HAL's words. None is greater than its bits, which the model has seen to.
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

fn plan_bus(context: &Context<'_>, bus: &Bus<'_>, section: &mut Section) -> Printed<()> {
    let (name, hal) = (snake(bus.unit), context.peripheral(bus.unit));
    let (rx, tx) = (lack::pad(bus.first, Role::Rx)?, lack::pad(bus.first, Role::Tx)?);
    let (rx, tx) = (&rx.pin.name, &tx.pin.name);
    let has_banks = context.names.has_can_banks();
    let handlers: &[(&str, &str)] = if has_banks {
        &[("TX", "Tx"), ("RX0", "Rx0"), ("RX1", "Rx1"), ("SCE", "Sce")]
    } else {
        &[("IT0", "IT0"), ("IT1", "IT1")]
    };
    for (signal, handler) in handlers {
        let interrupt = context.interrupt(bus.unit, signal)?;
        section.bind(interrupt, format!("hal::can::{handler}InterruptHandler<{hal}>"));
    }
    let maker = if has_banks { "Can" } else { "CanConfigurator" };
    // As the pins spell the unit: `CAN`, where there is one.
    let moved = context.generics(lack::unit(bus.first)?, &["_"]);
    let who: Vec<&str> = bus.wires.iter().map(|one| one.title.as_str()).collect();
    section.fields.push(Field {
        name: name.clone(),
        comment: format!("{} at {rx} (RX) and {tx} (TX): {}", bus.unit, who.join(", ")),
        type_: format!("hal::can::{maker}<'static>"),
        make: format!("hal::can::{maker}::new{moved}(p.{hal}, p.{rx}, p.{tx}, Irqs)"),
    });
    section.features.insert(if has_banks { "can-banks" } else { "can-fd" });
    start(context, bus, &name, section)?;
    tables(bus, section);
    listen(context, bus, &name, section);
    say(bus, &name, section);
    Ok(())
}

/// What turns the bus on, and parts it into its halves.
fn start(context: &Context<'_>, bus: &Bus<'_>, name: &str, section: &mut Section) -> Printed<()> {
    let (upper, hal) = (bus.unit.to_uppercase(), context.peripheral(bus.unit));
    let memory = format!("static {upper}_KEPT: rt::can::Memory = rt::can::Memory::new();");
    section.items.push(Item::Line(memory));
    let (banks, wanted) = if context.names.has_can_banks() {
        (banks(context, bus, section)?, bus.wanted())
    } else {
        (String::new(), bus.wanted_in_memory())
    };
    // Where the identifiers are too many for the hardware it lets all through, and the task looks.
    let wanted: Vec<String> = wanted.unwrap_or_default().into_iter().map(identifier).collect();
    section.starts.push(Start::Make(format!(
        "let ({name}_tx, {name}_rx) = \
         rt::can::start(wiring.{name}, hal::pac::{hal}, {banks}&{upper}_KEPT, {}, &[{}]);",
        bit(context, bus)?,
        wanted.join(", ")
    )));
    Ok(())
}

/// Where the filters of a controller are: the second of two has those of the first, whose clock they need.
fn banks(context: &Context<'_>, bus: &Bus<'_>, section: &mut Section) -> Printed<String> {
    let own = |first: &str, number: usize| {
        format!("&rt::can::Banks {{ registers: hal::pac::{first}, first: {number} }}, ")
    };
    if bus.unit != SECOND {
        return Ok(own(&context.peripheral(bus.unit), 0));
    }
    let first = context.peripheral(FIRST);
    if context.profile.unit(FIRST).is_none() {
        return Err(Missing::name(format!("{FIRST}, which has the filters of {SECOND},")));
    }
    let mut units = context.job.connections.iter().filter_map(|one| one.unit);
    if !units.any(|unit| UnitName::new(unit) == UnitName::new(FIRST)) {
        section.starts.push(Start::Make(format!("hal::rcc::enable_and_reset::<{first}>();")));
    }
    Ok(own(&first, BANKS))
}

/// What the bits of a bus are made of.
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

/// The bits of a frame that count, and what they are.
fn select((mask, bits): (u64, u64)) -> String {
    format!("({mask:#x}, {bits:#x})")
}

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
        format!("let reported_ms = &mut [None; tables::{upper}_VALUES.len()];"),
        "let value = &mut [0; SCHEMA.value_bytes_max()];".to_owned(),
        format!(
            "let mut bus = rt::can::Bus {{ receiver, schema: &SCHEMA, values: tables::{upper}_VALUES, \
             sent: &{sent:?}, reported_ms, value }};"
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

/// A frame as it is at the start.
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

/// The reporter has the bus: a frame that finds no room is sent in a later cycle.
fn say(bus: &Bus<'_>, name: &str, section: &mut Section) {
    let upper = bus.unit.to_uppercase();
    if bus.frames.is_empty() {
        // Dropping this half would turn the bus off.
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
