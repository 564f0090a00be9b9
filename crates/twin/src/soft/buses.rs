//! Chips on I2C and SPI, serial parts, stations on CAN: the runtime determines the transfers, the bench answers them.

use sense_rt::{
    Chip, ChipTable, Item, MessageField, MessageStream, MessageTable, Outcome, Schema, Step, Turn,
    onewire,
};
use sensedsl_job::kinds::serial;
use sensedsl_job::{BoardJob, Cycle};
use sensedsl_model::design::ConnectionIndex;
use sensedsl_model::kind::{Interface, Role};
use sensedsl_wire::Direction;

use super::core::{Core, begins, wrapped};
use crate::bench::{Bench, Units};
use crate::tables::{self, kept};
use sensedsl_surroundings::{I2cEvent, I2cReply, Surroundings as _};

/// The most transfers that a chip makes in a millisecond, so that no loop is endless.
const TRANSFERS_MAX: usize = 1_000;

/// A chip and the way to reach it.
pub(super) struct Bus {
    table: &'static ChipTable,
    schema: &'static Schema,
    chip: Box<Chip<[u8; 16_384]>>,
    way: Way,
    start_ms: u32,
    /// The time of its next step.
    wakes_ms: u64,
    /// The values that the host has set and the chip has not received yet.
    owed: Vec<Option<Vec<u8>>>,
    starts: u32,
    set: Vec<Option<Vec<u8>>>,
}

impl Bus {
    /// The same chip in its state at the start of the board.
    pub(super) fn anew(&self) -> Self {
        let commands = self.table.commands.len();
        Self {
            chip: Box::new(Chip::new(self.table, self.schema)),
            wakes_ms: u64::from(self.start_ms),
            owed: vec![None; commands],
            set: vec![None; commands],
            starts: 0,
            ..*self
        }
    }

    /// The host has set a device.
    pub(super) fn set(&mut self, index: usize, value: &[u8]) {
        let commands = self.table.commands.iter().zip(self.set.iter_mut().zip(&mut self.owed));
        for (_, (set, owed)) in commands.filter(|(one, _)| usize::from(one.item) == index) {
            *set = Some(value.to_vec());
            *owed = Some(value.to_vec());
        }
    }

    pub(super) fn step(&mut self, core: &mut Core, bench: &mut Bench, since_ms: u64, now_ns: u64) {
        if since_ms < self.wakes_ms {
            return;
        }
        for _ in 0..TRANSFERS_MAX {
            let way = self.way;
            let outcome = match self.chip.next(wrapped(since_ms)) {
                Step::Write(bytes) => transfer(bench, way, bytes, &mut [], now_ns),
                Step::WriteRead(bytes, answer) => transfer(bench, way, bytes, answer, now_ns),
                Step::Exchange(bytes, answer) => exchange(bench, way, bytes, answer, now_ns),
                Step::Wait(ms) => {
                    self.wakes_ms = since_ms + u64::from(ms.max(1));
                    break;
                }
            };
            self.chip.done(outcome, &mut |item, outcome, value| core.record(item, outcome, value));
            if outcome != Outcome::Fresh {
                // It is started again in the next cycle.
                self.wakes_ms = since_ms + u64::from(self.table.cycle_ms.max(1));
                break;
            }
        }
        self.command(bench, now_ns);
    }

    /// Writes the values that the host has set; all of them again after the chip was restarted.
    fn command(&mut self, bench: &mut Bench, now_ns: u64) {
        if self.chip.counts().starts != self.starts {
            self.starts = self.chip.counts().starts;
            self.owed.clone_from(&self.set);
        }
        let way = self.way;
        for (command, owed) in self.table.commands.iter().zip(&mut self.owed) {
            let Some(value) = owed.as_deref() else { continue };
            let outcome = match self.chip.write(command, value) {
                Ok(Step::Write(bytes)) => transfer(bench, way, bytes, &mut [], now_ns),
                Ok(_) => Outcome::Invalid,
                Err(_) => continue,
            };
            self.chip.done(outcome, &mut |_, _, _| {});
            if outcome == Outcome::Fresh {
                *owed = None;
            }
        }
    }
}

/// How a chip is reached.
#[derive(Clone, Copy)]
enum Way {
    /// By its address on a unit.
    I2c { address: u8, unit: u8 },
    /// By the connection that has its chip select, on a unit.
    Spi { unit: u8, connection: ConnectionIndex },
    /// By whatever is on its wires; how many picoseconds a bit lasts, if it has no clock.
    Strip { unit: u8, bit_ps: Option<u64> },
    /// Over its wire, which it may share.
    Wire(ConnectionIndex),
}

/// A transfer: bytes out, then bytes in.
fn transfer(bench: &mut Bench, way: Way, out: &[u8], answer: &mut [u8], now_ns: u64) -> Outcome {
    let (address, unit) = match way {
        Way::I2c { address, unit } => (address, unit),
        Way::Wire(connection) => return on_wire(bench, connection, out, answer, now_ns),
        Way::Strip { unit, bit_ps } => {
            for (byte, place) in out.iter().zip(0..) {
                match bit_ps {
                    Some(bit_ps) => {
                        let from_ps = 1_000 * now_ns + 8 * bit_ps * place;
                        bench.levels_out(unit, *byte, from_ps, bit_ps);
                    }
                    None => _ = bench.spi(unit, *byte, now_ns),
                }
            }
            return Outcome::Fresh;
        }
        Way::Spi { unit, connection } => {
            bench.drive_at(connection, Role::Cs, Some(false), now_ns);
            for byte in out {
                bench.spi(unit, *byte, now_ns);
            }
            for place in answer {
                *place = bench.spi(unit, 0, now_ns);
            }
            bench.drive_at(connection, Role::Cs, Some(true), now_ns);
            return Outcome::Fresh;
        }
    };
    let outcome = i2c(bench, unit, address, out, answer, now_ns);
    if !matches!(outcome, Outcome::TimedOut) {
        bench.i2c(unit, I2cEvent::Stop, now_ns);
    }
    outcome
}

fn i2c(
    bench: &mut Bench,
    unit: u8,
    address: u8,
    out: &[u8],
    answer: &mut [u8],
    now_ns: u64,
) -> Outcome {
    let refused = |reply: I2cReply| match reply {
        I2cReply::Ack | I2cReply::Byte(_) => None,
        I2cReply::Nack => Some(Outcome::NotAcknowledged),
        I2cReply::Stuck => Some(Outcome::BusError),
        I2cReply::Silent => Some(Outcome::TimedOut),
    };
    if !out.is_empty() || answer.is_empty() {
        let started = bench.i2c(unit, I2cEvent::Start { address, read: false }, now_ns);
        if let Some(outcome) = refused(started) {
            return outcome;
        }
        for byte in out {
            if let Some(outcome) = refused(bench.i2c(unit, I2cEvent::Write(*byte), now_ns)) {
                return outcome;
            }
        }
    }
    if answer.is_empty() {
        return Outcome::Fresh;
    }
    let started = bench.i2c(unit, I2cEvent::Start { address, read: true }, now_ns);
    if let Some(outcome) = refused(started) {
        return outcome;
    }
    let last = answer.len() - 1;
    for (index, place) in answer.iter_mut().enumerate() {
        match bench.i2c(unit, I2cEvent::Read { ack: index < last }, now_ns) {
            I2cReply::Byte(byte) => *place = byte,
            other @ (I2cReply::Ack | I2cReply::Nack | I2cReply::Stuck | I2cReply::Silent) => {
                return refused(other).unwrap_or(Outcome::BusError);
            }
        }
    }
    Outcome::Fresh
}

/// A transfer on one wire, whose checksums the board tests.
fn on_wire(
    bench: &mut Bench,
    connection: ConnectionIndex,
    out: &[u8],
    answer: &mut [u8],
    now_ns: u64,
) -> Outcome {
    let Some(bytes) = bench.line_transfer(connection, out, now_ns) else {
        return Outcome::NotAcknowledged;
    };
    if answer.is_empty() {
        return Outcome::Fresh;
    }
    // A part that has not heard the command leaves the wire alone.
    let bytes = bytes.into_iter().chain(std::iter::repeat(0xFF));
    answer.iter_mut().zip(bytes).for_each(|(place, byte)| *place = byte);
    if let [a, b, c, d, sum] = *answer {
        let is_right = a.wrapping_add(b).wrapping_add(c).wrapping_add(d) == sum;
        return if is_right { Outcome::Fresh } else { Outcome::WrongCrc };
    }
    onewire::check(answer)
}

/// A transfer with as many bytes in as out.
fn exchange(bench: &mut Bench, way: Way, out: &[u8], answer: &mut [u8], now_ns: u64) -> Outcome {
    let Way::Spi { unit, connection } = way else { return Outcome::Invalid };
    bench.drive_at(connection, Role::Cs, Some(false), now_ns);
    for (byte, place) in out.iter().zip(answer) {
        *place = bench.spi(unit, *byte, now_ns);
    }
    bench.drive_at(connection, Role::Cs, Some(true), now_ns);
    Outcome::Fresh
}

/// The chips of a board.
pub(super) fn buses(job: &BoardJob<'_>, schema: &'static Schema) -> Vec<Bus> {
    let units = Units::new(job);
    let mut all = Vec::new();
    for one in &job.connections {
        let unit = one.unit.and_then(|name| units.number(name)).unwrap_or(0);
        let way = match one.connection.kind.interface() {
            Interface::I2c(own) => Way::I2c { address: own.address, unit },
            Interface::Spi(own) if own.encoding.is_strip() => {
                let hz = job.bus_of(one).and_then(|plan| plan.clock_hz);
                let bit_ps = hz.map(|hz| 1_000_000_000_000 / u64::from(hz.max(1)));
                Way::Strip { unit, bit_ps }
            }
            Interface::Spi(_) => Way::Spi { unit, connection: one.index },
            Interface::OneWire(_) => Way::Wire(one.index),
            Interface::Analog(_)
            | Interface::Icu(_)
            | Interface::Encoder(_)
            | Interface::Digital(_)
            | Interface::Uart(_)
            | Interface::Pwm(_)
            | Interface::Dac(_)
            | Interface::Can(_)
            | Interface::Stepper(_)
            | Interface::Code(_) => continue,
        };
        let Some(plan) = job.bus_of(one) else {
            continue;
        };
        let table: &'static ChipTable = kept(tables::chip(plan, |name| place(job, name)));
        let commands = table.commands.len();
        all.push(Bus {
            table,
            schema,
            chip: Box::new(Chip::new(table, schema)),
            way,
            start_ms: one.cycle.start_ms,
            wakes_ms: u64::from(one.cycle.start_ms),
            owed: vec![None; commands],
            set: vec![None; commands],
            starts: 0,
        });
    }
    all
}

/// A serial part.
pub(super) struct Port {
    table: &'static MessageTable,
    schema: &'static Schema,
    stream: Box<MessageStream<[u8; 16_384]>>,
    unit: u8,
    cycle: Cycle,
    /// The items reported in this cycle.
    reported: Vec<usize>,
    /// The length of a silence that no message contains, and how long the line has been silent.
    pause_ms: u64,
    idle_ms: u64,
}

impl Port {
    /// The same part in its state at the start of the board.
    pub(super) fn anew(&self) -> Self {
        let stream = Box::new(MessageStream::new(self.table, self.schema));
        Self { stream, reported: Vec::new(), idle_ms: 0, ..*self }
    }

    pub(super) fn step(&mut self, core: &mut Core, bench: &mut Bench, since_ms: u64, now_ns: u64) {
        if begins(since_ms, self.cycle) {
            self.reported.clear();
        }
        self.idle_ms += 1;
        while let Some(byte) = bench.uart_in(self.unit, now_ns) {
            self.idle_ms = 0;
            let reported = &mut self.reported;
            self.stream.feed(&[byte], &mut |item, outcome, value| {
                // Only the first value of each item in a cycle counts.
                if !reported.contains(&item) {
                    if outcome == Outcome::Fresh {
                        reported.push(item);
                    }
                    core.record(item, outcome, value);
                }
            });
        }
        if self.idle_ms == self.pause_ms {
            self.stream.gap();
        }
    }
}

/// The place of a device in the schema.
fn place(job: &BoardJob<'_>, name: &str) -> u16 {
    let place = job.devices.iter().position(|one| one.name() == name);
    place.and_then(|place| u16::try_from(place).ok()).unwrap_or(u16::MAX)
}

/// The serial parts of a board.
pub(super) fn ports(job: &BoardJob<'_>, schema: &'static Schema) -> Vec<Port> {
    let units = Units::new(job);
    let mut all = Vec::new();
    for one in &job.connections {
        let (Some(uart), Some(tables)) = (one.connection.kind.uart(), job.tables_of(one)) else {
            continue;
        };
        let Some(plan) = tables.message.as_ref() else { continue };
        if serial::is_dialogue(job, one) {
            continue;
        }
        let table: &'static MessageTable = kept(tables::message(plan, |name| place(job, name)));
        all.push(Port {
            table,
            schema,
            stream: Box::new(MessageStream::new(table, schema)),
            unit: one.unit.and_then(|name| units.number(name)).unwrap_or(0),
            cycle: one.cycle,
            reported: Vec::new(),
            pause_ms: 2 + 30_000 / u64::from(uart.baud.max(1)),
            idle_ms: 0,
        });
    }
    all
}

/// The frames that the board takes from a CAN bus.
#[derive(Clone)]
pub(super) struct CanPeers {
    unit: u8,
    received: Vec<Heard>,
}

#[derive(Clone)]
struct Heard {
    frame_id: (u32, bool),
    /// The frame has this value only if these bits of it (the mask) are so (the value).
    select: (u64, u64),
    item: usize,
    what: Item,
    field: MessageField,
    cycle_ms: u32,
    turn: Turn,
}

impl CanPeers {
    pub(super) fn step(&mut self, core: &mut Core, bench: &mut Bench, since_ms: u64, now_ns: u64) {
        let now_ms = wrapped(since_ms);
        while let Some(frame) = bench.can_in(self.unit, now_ns) {
            let data = frame.data.get(..usize::from(frame.length)).unwrap_or_default();
            let bits = data.iter().rev().fold(0, |bits, byte| bits << 8 | u64::from(*byte));
            let takers = self.received.iter_mut().filter(|one| {
                let (mask, select) = one.select;
                one.frame_id == (frame.id, frame.extended) && bits & mask == select
            });
            for received in takers {
                let mut value = vec![0; received.what.bytes()];
                let outcome = received.field.read(&received.what, data, &mut value);
                let outcome = outcome.unwrap_or(Outcome::Invalid);
                if outcome != Outcome::Fresh || received.turn.is_next(received.cycle_ms, now_ms) {
                    core.record(received.item, outcome, &mut value);
                }
            }
        }
    }
}

/// The CAN buses of a board.
pub(super) fn stations(job: &BoardJob<'_>) -> Vec<CanPeers> {
    let units = Units::new(job);
    let mut all: Vec<CanPeers> = Vec::new();
    let schema = tables::schema(job);
    let devices = job.devices.iter().zip(schema.items).enumerate();
    for (item, (one, what)) in devices {
        let (Some(can), Direction::Sensor) = (one.device.kind.can(), one.device.direction) else {
            continue;
        };
        let Some(field) = tables::in_frame(item, one.device) else { continue };
        let unit = one.unit.and_then(|name| units.number(name)).unwrap_or(0);
        let received = Heard {
            frame_id: (can.frame_id, can.is_extended),
            select: can.select().unwrap_or_default(),
            item,
            what: *what,
            field,
            cycle_ms: one.cycle.delay_ms,
            turn: Turn::NEW,
        };
        match all.iter_mut().find(|bus| bus.unit == unit) {
            Some(bus) => bus.received.push(received),
            None => all.push(CanPeers { unit, received: vec![received] }),
        }
    }
    all
}
