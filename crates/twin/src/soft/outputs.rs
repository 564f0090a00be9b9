//! The way of the host's values to pins, messages and frames: the runtime determines the outputs, the bench takes them.

use std::collections::BTreeMap;

use sense_rt::{
    Bridge, BridgeState, Coding, Compose, Item, LEVEL_FULL, Scalar, Schema, pulse_level,
};
use sensedsl_job::kinds::{can, serial};
use sensedsl_job::{BoardJob, JobConnection, JobDevice};
use sensedsl_model::design::ConnectionIndex;
use sensedsl_model::kind::{Interface, Role};
use sensedsl_model::words::Words;
use sensedsl_wire::Direction;

use super::motors::Motors;
use crate::bench::{Bench, Units};
use crate::tables;
use sensedsl_surroundings::{CanFrame, Surroundings as _};

const FULL_CODE: u64 = 4_095;
const FULL_MV: f64 = 3_300.0 / 4_096.0;

/// All actuators except those on a bus with registers.
#[derive(Clone)]
pub(super) struct Outputs {
    /// The outputs, by place in the schema.
    all: BTreeMap<usize, Output>,
    frames: Vec<Frame>,
    /// The levels that no value changes.
    levels: Vec<(ConnectionIndex, bool)>,
    /// The values that are set when the host is silent, by place in the schema.
    safe: BTreeMap<usize, Vec<u8>>,
    pub(super) motors: Motors,
}

/// The destination of a value.
#[derive(Clone)]
struct Output {
    item: Item,
    /// The value set at the start; `None` if its wires stay at rest until somebody sets it.
    first: Option<Vec<u8>>,
    sink: Sink,
}

#[derive(Clone)]
enum Sink {
    Pins(Vec<Pin>),
    Bridge(Bridge, BridgeState, Vec<Pin>),
    Message(u8, Compose),
    /// A value may be in each of the contents of a multiplexed frame.
    Frames(Vec<FrameField>),
}

/// The frame that has a value, the byte at which it starts there, and its coding.
#[derive(Clone)]
struct FrameField {
    place: usize,
    byte: usize,
    coding: Coding,
    /// The bits that it has in the frame, byte 0 the lowest.
    mask: u64,
    is_quiet: bool,
}

/// One wire.
#[derive(Clone)]
struct Pin {
    at: ConnectionIndex,
    element: usize,
    what: Drives,
}

#[derive(Clone, Copy)]
enum Drives {
    Level { is_active_low: bool, is_on: bool },
    Pulses { period_ns: u64, least_ns: u64, most_ns: u64 },
    Volts,
}

#[derive(Clone)]
struct Frame {
    unit: u8,
    frame: CanFrame,
    /// The interval at which it is sent again once it was commanded; 0 for never.
    resend_ns: u64,
    /// The time at which it was last sent, once it was commanded.
    sent_ns: Option<u64>,
}

impl Outputs {
    pub(super) fn new(job: &BoardJob<'_>, schema: &'static Schema) -> Self {
        let mut frames = Vec::new();
        let mut all = BTreeMap::new();
        let mut safe = BTreeMap::new();
        let sent = on_can(job, &mut frames);
        for ((index, one), item) in job.devices.iter().enumerate().zip(schema.items) {
            if one.device.direction != Direction::Actuator {
                continue;
            }
            let count = one.device.value.value.count();
            let bytes = |value: f64| tables::value(item.scalar, value).repeat(count);
            let first = one.device.kind.failsafe().map(bytes);
            let own = one.device.coding.failsafe.map(bytes);
            safe.extend(own.or_else(|| first.clone()).map(|value| (index, value)));
            let of_can = sent.get(&index).cloned();
            if let Some(sink) = of_can.or_else(|| sink(job, one)) {
                all.insert(index, Output { item: *item, first, sink });
            }
        }
        let bare = job.connections.iter().filter(|one| one.devices.is_empty());
        let level = |one: &JobConnection<'_>| {
            let own = one.connection.kind.digital()?;
            let is_driven = one.connection.direction == Direction::Actuator;
            is_driven.then_some((one.index, own.initial != own.active_low))
        };
        Self {
            all,
            frames,
            levels: bare.filter_map(level).collect(),
            safe,
            motors: Motors::new(job),
        }
    }

    /// The board starts.
    pub(super) fn start(&mut self, bench: &mut Bench, now_ns: u64) {
        for (at, level) in &self.levels {
            bench.drive_at(*at, Role::Out, Some(*level), now_ns);
        }
        self.motors.start(bench, now_ns);
        let mut first = Vec::new();
        for (index, output) in &self.all {
            output.rest(bench, now_ns);
            first.extend(output.first.clone().map(|value| (*index, value)));
        }
        for (index, value) in first {
            self.set(index, &value, bench, now_ns);
        }
    }

    /// Sends the frames that must be repeated.
    pub(super) fn repeat(&mut self, bench: &mut Bench, now_ns: u64) {
        for Frame { unit, frame, resend_ns, sent_ns } in &mut self.frames {
            let due = sent_ns.filter(|_| *resend_ns > 0).map(|sent| sent + *resend_ns);
            if due.is_some_and(|due| due <= now_ns) {
                bench.can_out(*unit, *frame, now_ns);
                *sent_ns = due;
            }
        }
    }

    /// The host is silent: a frame is not repeated until a failsafe or the host sets it again, and motors stop.
    pub(super) fn hush(&mut self) {
        self.frames.iter_mut().for_each(|frame| frame.sent_ns = None);
        self.motors.stop();
    }

    /// The values that are set when the host is silent.
    pub(super) fn safe(&self) -> impl Iterator<Item = (usize, &[u8])> {
        self.safe.iter().map(|(index, value)| (*index, value.as_slice()))
    }

    /// The host has set a device.
    pub(super) fn set(&mut self, index: usize, value: &[u8], bench: &mut Bench, now_ns: u64) {
        self.motors.set(index, value, bench, now_ns);
        let Some(Output { item, sink, .. }) = self.all.get_mut(&index) else { return };
        let size = item.scalar.bytes();
        let element = |place: usize| value.get(place * size..).unwrap_or_default();
        match sink {
            Sink::Pins(pins) => {
                for pin in pins {
                    pin.set(item.scalar, element(pin.element), bench, now_ns);
                }
            }
            Sink::Bridge(bridge, state, pins) => {
                for write in bridge.drive(state, item.scalar, value).as_slice() {
                    if let Some(pin) = pins.get(usize::from(write.output)) {
                        pin.set(Scalar::Uint32, &write.value.to_be_bytes(), bench, now_ns);
                    }
                }
            }
            Sink::Message(unit, compose) => {
                let mut message = vec![0; compose.bytes(item)];
                let count = compose.write(item, value, &mut message);
                for byte in message.iter().take(count) {
                    bench.uart_out(*unit, *byte, now_ns);
                }
            }
            Sink::Frames(own) => {
                for one in own {
                    let Some(frame) = self.frames.get_mut(one.place) else { continue };
                    if one.put(item, value, frame) {
                        bench.can_out(frame.unit, frame.frame, now_ns);
                        frame.sent_ns = Some(now_ns);
                    }
                }
            }
        }
    }
}

impl Output {
    /// Puts its wires into the state that they have before anybody sets it.
    fn rest(&self, bench: &mut Bench, now_ns: u64) {
        let (Sink::Pins(pins) | Sink::Bridge(_, _, pins)) = &self.sink else { return };
        for pin in pins {
            match pin.what {
                Drives::Level { is_active_low, is_on } => {
                    bench.drive_at(pin.at, Role::Out, Some(is_on != is_active_low), now_ns);
                }
                Drives::Pulses { period_ns, .. } => bench.recorder().pulses(pin.at, period_ns, 0),
                Drives::Volts => bench.recorder().millivolts(pin.at, 0.0),
            }
        }
    }
}

impl FrameField {
    /// Writes the value, and returns whether the frame must be sent now.
    fn put(&self, item: &Item, value: &[u8], to: &mut Frame) -> bool {
        let mut coded = [0; 8];
        let room = coded.get_mut(self.byte..).unwrap_or_default();
        if self.coding.encode(item, value, room) == 0 {
            return false;
        }
        let before = u64::from_le_bytes(to.frame.data) & !self.mask;
        to.frame.data = (before | u64::from_le_bytes(coded) & self.mask).to_le_bytes();
        !self.is_quiet
    }
}

impl Pin {
    fn set(&self, scalar: Scalar, element: &[u8], bench: &mut Bench, now_ns: u64) {
        match self.what {
            Drives::Level { is_active_low, .. } => {
                let (magnitude, _) = sense_rt::load_magnitude(scalar, element);
                let level = (magnitude != 0) != is_active_low;
                bench.drive_at(self.at, Role::Out, Some(level), now_ns);
            }
            Drives::Pulses { period_ns, least_ns, most_ns } => {
                let level = u64::from(pulse_level(scalar, element));
                let span_ns = most_ns.saturating_sub(least_ns);
                let width_ns = least_ns + span_ns * level / u64::from(LEVEL_FULL);
                bench.recorder().pulses(self.at, period_ns, width_ns);
            }
            Drives::Volts => {
                let (code, is_negative) = sense_rt::load_magnitude(scalar, element);
                let code = if is_negative { 0 } else { code.min(FULL_CODE) };
                bench.recorder().millivolts(self.at, crate::arith::number(code) * FULL_MV);
            }
        }
    }
}

fn sink(job: &BoardJob<'_>, one: &JobDevice<'_>) -> Option<Sink> {
    let tables = job.parts.iter().find(|part| part.index == one.device.part).map(|part| &part.plan);
    let own = job.wires_of(one.device);
    if one.device.kind.uart().is_some() {
        // What a part is told in a dialogue goes out when the line is free.
        if own.iter().any(|wire| serial::is_dialogue(job, wire)) {
            return None;
        }
        let plan = tables?.message.as_ref()?.commands.iter().find(|of| of.field == one.name())?;
        let unit = one.unit.and_then(|name| Units::new(job).number(name))?;
        return Some(Sink::Message(unit, tables::compose(plan)));
    }
    let pins: Vec<Pin> = own.iter().filter_map(|wire| pin(wire)).collect();
    let bridge = tables.and_then(|all| all.bridges.iter().find(|plan| plan.field == one.name()));
    match bridge {
        Some(plan) => Some(Sink::Bridge(tables::bridge(plan), BridgeState::NEW, pins)),
        None if pins.is_empty() => None,
        None => Some(Sink::Pins(pins)),
    }
}

fn pin(wire: &JobConnection<'_>) -> Option<Pin> {
    let what = match wire.connection.kind.interface() {
        Interface::Digital(own) => {
            Drives::Level { is_active_low: own.active_low, is_on: own.initial }
        }
        Interface::Pwm(own) => {
            let period_ns = 1_000_000_000 / u64::from(own.frequency_hz.max(1));
            let ns = |us: u32| 1_000 * u64::from(us);
            let (least_ns, most_ns) = (own.min_us.map_or(0, ns), own.max_us.map_or(period_ns, ns));
            Drives::Pulses { period_ns, least_ns, most_ns }
        }
        Interface::Dac(_) => Drives::Volts,
        Interface::Analog(_)
        | Interface::I2c(_)
        | Interface::Icu(_)
        | Interface::Encoder(_)
        | Interface::Uart(_)
        | Interface::Spi(_)
        | Interface::OneWire(_)
        | Interface::Can(_)
        | Interface::Stepper(_)
        | Interface::Code(_) => return None,
    };
    Some(Pin { at: wire.index, element: usize::from(wire.element()), what })
}

/// The values in CAN frames, by place in the schema.
fn on_can(job: &BoardJob<'_>, frames: &mut Vec<Frame>) -> BTreeMap<usize, Sink> {
    let mut all: BTreeMap<usize, Vec<FrameField>> = BTreeMap::new();
    let units = Units::new(job);
    for bus in can::buses(job, job.connections.iter(), &mut Vec::new()) {
        // The unit goes by the board's name for it: a profile may use another one.
        let unit = bus.first.unit.and_then(|name| units.number(name)).unwrap_or(0);
        for repeated in &bus.frames {
            for value in &repeated.values {
                let coding = tables::coding(&value.how);
                let words = Words::of(value.device.device);
                let mask = words.map_or(0, |words| words.in_frame(value.byte));
                let (place, byte, is_quiet) = (frames.len(), value.byte.into(), value.is_quiet);
                let in_frame = FrameField { place, byte, coding, mask, is_quiet };
                all.entry(value.index).or_default().push(in_frame);
            }
            let length = u8::try_from(repeated.bytes).unwrap_or(8);
            let (id, extended) = (repeated.identifier, repeated.is_extended);
            let frame = CanFrame {
                id,
                extended,
                remote: false,
                length,
                data: repeated.start.to_le_bytes(),
            };
            let resend_ns = 1_000_000 * u64::from(repeated.resend_ms);
            frames.push(Frame { unit, frame, resend_ns, sent_ns: None });
        }
    }
    all.into_iter().map(|(index, own)| (index, Sink::Frames(own))).collect()
}
