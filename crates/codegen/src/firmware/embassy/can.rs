//! CAN: a task for each bus, which takes frames as they come; the reporter sends what the host has set.

use sensedsl_diagnostics::Diagnostic;
use sensedsl_model::kind::{KindName, Role};

use super::chip::{coding, list};
use super::context::Context;
use super::filter;
use super::lack::{self, Made};
use super::section::{Field, Keep, Section, Start, Watched};
use crate::kinds::can::{Bus, STANDARD_MAX, Value, buses};
use crate::print::snake;

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
fn identifier(identifier: u32) -> String {
    if identifier > STANDARD_MAX {
        format!("crate::rt::can::extended({identifier:#X})")
    } else {
        format!("crate::rt::can::standard({identifier:#X})")
    }
}

/// The half of a bus that sends.
fn keep(parameter: &str, name: &str) -> Keep {
    Keep {
        name: parameter.to_owned(),
        type_: "hal::can::CanTx<'static>".to_owned(),
        from: format!("{name}_tx"),
    }
}

fn plan_bus(context: &Context<'_>, bus: &Bus<'_>, section: &mut Section) -> Made<()> {
    let (name, hal) = (snake(bus.unit), context.peripheral(bus.unit));
    // As the pins spell the unit: `CAN`, where there is one.
    let moved = context.generics(lack::unit(bus.first)?, &["_"]);
    let (rx, tx) = (lack::pad(bus.first, Role::Rx)?, lack::pad(bus.first, Role::Tx)?);
    let (rx, tx) = (&rx.pin.name, &tx.pin.name);
    let handlers = ["TX", "RX0", "RX1", "SCE"];
    for (signal, handler) in handlers.into_iter().zip(["Tx", "Rx0", "Rx1", "Sce"]) {
        let interrupt = context.interrupt(bus.unit, signal)?;
        section.bind(interrupt, format!("hal::can::{handler}InterruptHandler<{hal}>"));
    }
    let who: Vec<&str> = bus.wires.iter().map(|one| one.title.as_str()).collect();
    section.fields.push(Field {
        name: name.clone(),
        comment: format!("{} at {rx} (RX) and {tx} (TX): {}", bus.unit, who.join(", ")),
        type_: "hal::can::Can<'static>".to_owned(),
        make: format!("hal::can::Can::new{moved}(p.{hal}, p.{rx}, p.{tx}, Irqs)"),
    });
    section.runtime.insert("can.rs");
    let upper = bus.unit.to_uppercase();
    section.items.push(format!(
        "static {upper}_BUS: StaticCell<hal::can::Can<'static>> = StaticCell::new();\n\
         static {upper}_WAITING: StaticCell<rt::can::Waiting> = StaticCell::new();"
    ));
    section.starts.push(Start::Make(format!(
        "let ({name}_tx, {name}_rx) = rt::can::start(\n        {upper}_BUS.init(wiring.{name}),\n        \
         hal::pac::{hal},\n        {upper}_WAITING.init(rt::can::Waiting::new()),\n        {},\n        &[{}],\n    );",
        bus.bitrate_hz,
        filters(bus).join(", ")
    )));
    tables(bus, section);
    listen(context, bus, &name, section);
    say(bus, &name, section);
    Ok(())
}

/// The identifiers that the hardware lets through; where they are too many it lets all through, and the task looks.
fn filters(bus: &Bus<'_>) -> Vec<String> {
    bus.wanted().unwrap_or_default().into_iter().map(identifier).collect()
}

fn tables(bus: &Bus<'_>, section: &mut Section) {
    let value = |one: &Value| {
        format!(
            "(MessageField {{ item: {}, byte: {}, value: {}, ..MessageField::NEW }}, {}, {})",
            one.index,
            one.byte,
            coding(&one.how),
            identifier(one.identifier),
            one.device.cycle.delay_ms
        )
    };
    let upper = bus.unit.to_uppercase();
    section.tables.push(format!(
        "/// Values in frames: where, in which frame, and how often they are told.\n\
         pub const {upper}_VALUES: &[crate::rt::can::Value] = {};",
        list(bus.values.iter().map(value)).replace("\n    ", "\n")
    ));
    for one in bus.frames.iter().flat_map(|frame| &frame.values) {
        section.tables.push(format!(
            "pub const {upper}_SENT_{}: Coding = {};",
            one.index,
            coding(&one.how)
        ));
    }
}

fn listen(context: &Context<'_>, bus: &Bus<'_>, name: &str, section: &mut Section) {
    let upper = bus.unit.to_uppercase();
    let is_own = |part| bus.wires.iter().any(|one| one.connection.part == part);
    let (filters, pass) = filter::of_parts(context, is_own, section);
    let constant = format!("{upper}_LISTEN");
    let sent: Vec<usize> =
        bus.frames.iter().flat_map(|frame| &frame.values).map(|one| one.index).collect();
    section.items.push(format!(
        "/// {}: frames that come.\n#[embassy_executor::task]\nasync fn {name}_listen(come: rt::can::Come) {{\n\
         {filters}    let mut bus = rt::can::Bus {{\n        come,\n        schema: &SCHEMA,\n        \
         values: tables::{upper}_VALUES,\n        sent: &{sent:?},\n        \
         told_ms: &mut [None; tables::{upper}_VALUES.len()],\n        value: &mut [0; SCHEMA.value_bytes_max()],\n    }};\n    \
         loop {{\n        let until = Instant::now() + Duration::from_millis({});\n        \
         bus.hear(until, &mut |index: usize, outcome, value: &mut [u8]| \
         BOARD.tell({pass}, index, outcome, value)).await;\n        \
         WATCH.beat(tables::{constant}, now_ms());\n    }}\n}}",
        bus.unit, bus.cycle.delay_ms
    ));
    let call = format!("{name}_listen({name}_rx)");
    section.starts.push(Start::Task(bus.cycle.prio, call));
    let device = context.id_of(bus.first);
    section.watched.push(Watched::new(constant, bus.cycle, device));
}

/// The reporter has the bus: a frame that finds no room is sent in a later cycle.
fn say(bus: &Bus<'_>, name: &str, section: &mut Section) {
    let upper = bus.unit.to_uppercase();
    if bus.frames.is_empty() {
        // Dropping this half would turn the bus off.
        section.keeps.push(keep(&format!("_{name}_tx"), name));
        return;
    }
    let frames: String = bus
        .frames
        .iter()
        .map(|frame| {
            format!("rt::can::Sent::new({}, {}), ", identifier(frame.identifier), frame.bytes)
        })
        .collect();
    section.items.push(format!(
        "static {upper}_FRAMES: rt::can::Frames<{}> = rt::can::frames([{frames}]);",
        bus.frames.len()
    ));
    for (at, frame) in bus.frames.iter().enumerate() {
        for one in &frame.values {
            section.sets.entry(one.index).or_default().push(format!(
                "rt::can::set(&{upper}_FRAMES, {at}, &tables::{upper}_SENT_{}, &SCHEMA, {}, value, {}, &BOARD);",
                one.index, one.index, one.byte
            ));
        }
    }
    section.keeps.push(keep(&format!("mut {name}_tx"), name));
    section.polls.push(format!("rt::can::send(&mut {name}_tx, &{upper}_FRAMES);"));
}
