//! CAN: a task for each bus, which takes frames as they come; the reporter sends what the host has set.

use std::collections::BTreeMap;

use sensedsl_board::signal::UnitName;
use sensedsl_diagnostics::Diagnostic;
use sensedsl_diagnostics::codes::e0506_hardware_limit;
use sensedsl_model::kind::{KindName, Role};
use sensedsl_model::words::Words;
use sensedsl_wire::Direction;

use super::chip::{coding, list};
use super::context::Context;
use super::filter;
use super::lack::{self, Lack, Made};
use super::section::{Field, Keep, Section, Start, Watched};
use crate::job::{Cycle, JobConnection, JobDevice};
use crate::part::ValuePlan;
use crate::print::snake;

/// The greatest identifier of eleven bits; a greater one has 29.
const STANDARD_MAX: u32 = 0x7FF;

/// Bytes of a frame.
const FRAME_BYTES: u16 = 8;

/// Banks of filters that a bus has.
const BANKS: usize = 14;

/// A bus.
struct Bus<'a> {
    unit: String,
    bitrate_hz: u32,
    cycle: Cycle,
    /// One of its wires: all have the pads of the bus.
    first: &'a JobConnection<'a>,
    wires: Vec<&'a JobConnection<'a>>,
    values: Vec<Value>,
    frames: Vec<Frame>,
}

/// A value in a frame.
struct Value {
    index: usize,
    identifier: u32,
    byte: u8,
    /// One behind its last byte.
    end: u16,
    cycle_ms: u32,
    how: ValuePlan,
}

/// A frame that is sent.
struct Frame {
    identifier: u32,
    bytes: u16,
    values: Vec<Value>,
}

pub(super) fn plan(context: &Context<'_>, diagnostics: &mut Vec<Diagnostic>) -> Section {
    let mut section = Section::default();
    let mut buses: BTreeMap<UnitName, Bus<'_>> = BTreeMap::new();
    for wire in context.connections(KindName::Can) {
        let made = gather(context, wire, &mut buses, diagnostics);
        context.tell(wire.part, made, diagnostics);
    }
    for bus in buses.values() {
        let made = bus.plan(context, &mut section);
        context.tell(bus.first.part, made, diagnostics);
    }
    section
}

/// Puts what goes over a wire to the rest of its bus.
fn gather<'a>(
    context: &Context<'_>,
    wire: &'a JobConnection<'a>,
    buses: &mut BTreeMap<UnitName, Bus<'a>>,
    diagnostics: &mut Vec<Diagnostic>,
) -> Made<()> {
    let (unit, can) = (lack::unit(wire)?, lack::kind(wire.connection.kind.can())?);
    let bus = buses.entry(UnitName::new(unit)).or_insert_with(|| Bus {
        unit: context.profile.unit(unit).map_or(unit, |unit| &unit.name).to_owned(),
        bitrate_hz: can.bitrate_hz,
        cycle: wire.cycle,
        first: wire,
        wires: Vec::new(),
        values: Vec::new(),
        frames: Vec::new(),
    });
    bus.cycle.delay_ms = bus.cycle.delay_ms.min(wire.cycle.delay_ms);
    bus.cycle.prio = bus.cycle.prio.max(wire.cycle.prio);
    bus.wires.push(wire);
    let devices = wire.devices.iter().map(|index| (*index, context.job.devices.get(*index)));
    for (index, device) in devices.filter_map(|(index, device)| Some((index, device?))) {
        bus.add(index, device, diagnostics)?;
    }
    Ok(())
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

impl Bus<'_> {
    /// A value that comes in or goes out.
    fn add(
        &mut self,
        index: usize,
        one: &JobDevice<'_>,
        diagnostics: &mut Vec<Diagnostic>,
    ) -> Made<()> {
        let can = lack::kind(one.device.kind.can())?;
        let words = Words::of(one.device).ok_or_else(|| Lack::table("a coding of the value"))?;
        let byte = u16::from(can.byte);
        let value = Value {
            index,
            identifier: can.frame_id,
            byte: can.byte,
            end: byte.saturating_add(words.wire_bytes()),
            cycle_ms: one.cycle.delay_ms,
            how: ValuePlan::new(&words),
        };
        if value.end > FRAME_BYTES {
            let name = &one.device.name;
            let message = format!(
                "{} ends {} bytes into its frame, which has {FRAME_BYTES}",
                name.value, value.end
            );
            let help = "let it begin earlier (`byte`), or take a smaller type";
            diagnostics.push(e0506_hardware_limit::hardware_limit(name.span, &message, help));
        } else if one.device.direction == Direction::Sensor {
            self.values.push(value);
        } else if let Some(frame) =
            self.frames.iter_mut().find(|frame| frame.identifier == value.identifier)
        {
            frame.bytes = frame.bytes.max(value.end);
            frame.values.push(value);
        } else {
            let (identifier, bytes) = (value.identifier, value.end);
            self.frames.push(Frame { identifier, bytes, values: vec![value] });
        }
        Ok(())
    }

    fn plan(&self, context: &Context<'_>, section: &mut Section) -> Made<()> {
        let (name, hal) = (snake(&self.unit), context.peripheral(&self.unit));
        // As the pins spell the unit: `CAN`, where there is one.
        let moved = context.generics(lack::unit(self.first)?, &["_"]);
        let (rx, tx) = (lack::pad(self.first, Role::Rx)?, lack::pad(self.first, Role::Tx)?);
        let (rx, tx) = (&rx.pin.name, &tx.pin.name);
        let handlers = ["TX", "RX0", "RX1", "SCE"];
        for (signal, handler) in handlers.into_iter().zip(["Tx", "Rx0", "Rx1", "Sce"]) {
            let interrupt = context.interrupt(&self.unit, signal)?;
            section.bind(interrupt, format!("hal::can::{handler}InterruptHandler<{hal}>"));
        }
        let who: Vec<&str> = self.wires.iter().map(|one| one.title.as_str()).collect();
        section.fields.push(Field {
            name: name.clone(),
            comment: format!("{} at {rx} (RX) and {tx} (TX): {}", self.unit, who.join(", ")),
            type_: "hal::can::Can<'static>".to_owned(),
            make: format!("hal::can::Can::new{moved}(p.{hal}, p.{rx}, p.{tx}, Irqs)"),
        });
        section.runtime.insert("can.rs");
        let upper = self.unit.to_uppercase();
        section.items.push(format!(
            "static {upper}_BUS: StaticCell<hal::can::Can<'static>> = StaticCell::new();\n\
             static {upper}_WAITING: StaticCell<rt::can::Waiting> = StaticCell::new();"
        ));
        section.starts.push(Start::Make(format!(
            "let ({name}_tx, {name}_rx) = rt::can::start(\n        {upper}_BUS.init(wiring.{name}),\n        \
             hal::pac::{hal},\n        {upper}_WAITING.init(rt::can::Waiting::new()),\n        {},\n        &[{}],\n    );",
            self.bitrate_hz,
            self.filters().join(", ")
        )));
        self.tables(section);
        self.listen(context, &name, section);
        self.say(&name, section);
        Ok(())
    }

    /// The identifiers that the hardware lets through; where they are too many it lets all through, and the task looks.
    fn filters(&self) -> Vec<String> {
        let mut wanted: Vec<u32> = self.values.iter().map(|one| one.identifier).collect();
        wanted.sort_unstable();
        wanted.dedup();
        if wanted.len() > 2 * BANKS {
            return Vec::new();
        }
        wanted.into_iter().map(identifier).collect()
    }

    fn tables(&self, section: &mut Section) {
        let value = |one: &Value| {
            format!(
                "(MessageField {{ item: {}, byte: {}, value: {}, ..MessageField::NEW }}, {}, {})",
                one.index,
                one.byte,
                coding(&one.how),
                identifier(one.identifier),
                one.cycle_ms
            )
        };
        let upper = self.unit.to_uppercase();
        section.tables.push(format!(
            "/// Values in frames: where, in which frame, and how often they are told.\n\
             pub const {upper}_VALUES: &[crate::rt::can::Value] = {};",
            list(self.values.iter().map(value)).replace("\n    ", "\n")
        ));
        for one in self.frames.iter().flat_map(|frame| &frame.values) {
            section.tables.push(format!(
                "pub const {upper}_SENT_{}: Coding = {};",
                one.index,
                coding(&one.how)
            ));
        }
    }

    fn listen(&self, context: &Context<'_>, name: &str, section: &mut Section) {
        let upper = self.unit.to_uppercase();
        let is_own = |part| self.wires.iter().any(|one| one.connection.part == part);
        let (filters, pass) = filter::of_parts(context, is_own, section);
        let constant = format!("{upper}_LISTEN");
        let sent: Vec<usize> =
            self.frames.iter().flat_map(|frame| &frame.values).map(|one| one.index).collect();
        section.items.push(format!(
            "/// {}: frames that come.\n#[embassy_executor::task]\nasync fn {name}_listen(come: rt::can::Come) {{\n\
             {filters}    let mut bus = rt::can::Bus {{\n        come,\n        schema: &SCHEMA,\n        \
             values: tables::{upper}_VALUES,\n        sent: &{sent:?},\n        \
             told_ms: &mut [None; tables::{upper}_VALUES.len()],\n        value: &mut [0; SCHEMA.value_bytes_max()],\n    }};\n    \
             loop {{\n        let until = Instant::now() + Duration::from_millis({});\n        \
             bus.hear(until, &mut |index: usize, outcome, value: &mut [u8]| \
             BOARD.tell({pass}, index, outcome, value)).await;\n        \
             WATCH.beat(tables::{constant}, now_ms());\n    }}\n}}",
            self.unit, self.cycle.delay_ms
        ));
        let call = format!("{name}_listen({name}_rx)");
        section.starts.push(Start::Task(self.cycle.prio, call));
        let device = context.id_of(self.first);
        section.watched.push(Watched::new(constant, self.cycle, device));
    }

    /// The reporter has the bus: a frame that finds no room is sent in a later cycle.
    fn say(&self, name: &str, section: &mut Section) {
        let upper = self.unit.to_uppercase();
        if self.frames.is_empty() {
            // Whoever holds the half keeps the bus on.
            section.keeps.push(keep(&format!("_{name}_tx"), name));
            return;
        }
        let frames: String = self
            .frames
            .iter()
            .map(|frame| {
                format!("rt::can::Sent::new({}, {}), ", identifier(frame.identifier), frame.bytes)
            })
            .collect();
        section.items.push(format!(
            "static {upper}_FRAMES: rt::can::Frames<{}> = rt::can::frames([{frames}]);",
            self.frames.len()
        ));
        for (at, frame) in self.frames.iter().enumerate() {
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
}
