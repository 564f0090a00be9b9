//! The expected outputs of a board, from an independent reading of its design: nothing here is shared with the
//! generators, their tables or the runtimes.
//!
//! In: a device and the raw values that it has been set to. Out: the signal that each of its wires must carry.

use sensedsl_job::{BoardJob, JobConnection, JobDevice};
use sensedsl_model::design::ConnectionIndex;
use sensedsl_model::kind::digital::Digital;
use sensedsl_model::kind::pwm::Pwm;
use sensedsl_model::kind::stepper::{Mode, Stepper};
use sensedsl_model::kind::{Interface, Role};
use sensedsl_model::protocol::Drive;
use sensedsl_model::words::Words;
use sensedsl_wire::Direction;

use super::track::Motion;
use super::written::{self, Written, write};
use crate::bench::Units;
use crate::parts::{message, words};

/// The value of the longest pulse.
pub(super) const FULL_LEVEL: f64 = 10_000.0;
/// The code that stands for a converter's reference voltage.
pub(super) const FULL_CODE: f64 = 4_095.0;
const REFERENCE_MV: f64 = 3_300.0;
const FRAME_BYTES: u16 = 8;

/// The expected output of one wire.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Expected {
    pub(super) element: usize,
    /// The wire, for people: `Left.in1 at PB4`.
    pub(super) wire: String,
    pub(super) at: ConnectionIndex,
    pub(super) what: Expectation,
}

/// The expected level, pulses, voltage or data.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Expectation {
    Level(Role, bool),
    /// Period and width in nanoseconds; `None` if there must be no pulses.
    Pulses(Option<(u64, u64)>),
    Millivolts(f64),
    Write(Written),
    /// The unit of a serial port, and a message on it.
    Message(u8, Vec<u8>),
    Frame(Sent),
    Motion(Motion),
}

/// A value in a CAN frame.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Sent {
    pub(super) unit: u8,
    pub(super) identifier: u32,
    pub(super) is_extended: bool,
    pub(super) length: u8,
    /// The bits of the frame that belong to the value, and their contents: byte 0 is the lowest.
    pub(super) bits: (u64, u64),
    /// The bits that select one of the frames with the same identifier, and their contents.
    pub(super) select: (u64, u64),
    /// The interval at which it is sent again; 0 if it is not.
    pub(super) resend_ns: u64,
    /// The number of devices whose values are in frames with that identifier: setting any of them sends one.
    pub(super) devices: u64,
}

/// The number of a wire's unit on the bench.
fn number(job: &BoardJob<'_>, wire: &JobConnection<'_>) -> Option<u8> {
    wire.unit.and_then(|name| Units::new(job).number(name))
}

/// The levels that no value ever changes, such as the one on a standby input.
pub(super) fn constants(job: &BoardJob<'_>) -> Vec<Expected> {
    let all = job.connections.iter().filter(|one| one.devices.is_empty());
    let constant = |one: &JobConnection<'_>| {
        let own = one.connection.kind.digital()?;
        let is_driven = one.connection.direction == Direction::Actuator;
        is_driven.then(|| level(one, 0, own, own.initial))
    };
    all.filter_map(constant).collect()
}

/// The expected outputs of a device that was set to these raw values.
pub(super) fn reported(job: &BoardJob<'_>, one: &JobDevice<'_>, raw: &[f64]) -> Vec<Expected> {
    let wires = job.wires_of(one.device);
    let value = |element: usize| raw.get(element).copied().unwrap_or(0.0);
    if let Some(drive) = one.device.coding.drive {
        return bridge(job, one, drive, value(0));
    }
    let each = |wire: &&JobConnection<'_>| {
        let element = usize::from(wire.element());
        match wire.connection.kind.interface() {
            Interface::Digital(own) => Some(level(wire, element, own, value(element) != 0.0)),
            Interface::Pwm(own) => Some(pulses(wire, element, own, value(element))),
            Interface::Dac(_) => {
                let code = value(element).round().clamp(0.0, FULL_CODE);
                // A 12-bit converter divides its reference by 4096.
                let what = Expectation::Millivolts(code / (FULL_CODE + 1.0) * REFERENCE_MV);
                Some(expected(wire, element, what))
            }
            Interface::I2c(_) | Interface::Spi(_) => write(job, wire, one, raw),
            Interface::Uart(own) => {
                let text = one.device.coding.text.as_ref();
                let value = match text {
                    Some(text) => message::told(text, raw),
                    None => words::bytes(&Words::of(one.device)?, raw),
                };
                let of_device = one.device.kind.uart().unwrap_or(own);
                let body = [value, of_device.exchange.behind.clone()].concat();
                let unit = number(job, wire)?;
                let what = Expectation::Message(unit, message::framed(of_device, &body));
                Some(expected(wire, 0, what))
            }
            Interface::Can(_) => frame(job, wire, one, raw),
            Interface::Stepper(own) => Some(motion(wire, element, own, value(element))),
            Interface::Analog(_)
            | Interface::Icu(_)
            | Interface::Encoder(_)
            | Interface::OneWire(_)
            | Interface::Code(_) => None,
        }
    };
    wires.iter().filter_map(each).collect()
}

/// The expected outputs of a device that the host has not set yet; empty if the design does not define them.
pub(super) fn unreported(job: &BoardJob<'_>, one: &JobDevice<'_>, now_ns: u64) -> Vec<Expected> {
    let wires = job.wires_of(one.device);
    if let Some(safe) = one.device.kind.failsafe() {
        return reported(job, one, &vec![safe; one.device.value.value.count()]);
    }
    let each = |wire: &&JobConnection<'_>| {
        let element = usize::from(wire.element());
        match wire.connection.kind.interface() {
            Interface::Digital(own) => Some(level(wire, element, own, own.initial)),
            Interface::Pwm(_) => Some(expected(wire, element, Expectation::Pulses(None))),
            Interface::Dac(_) => Some(expected(wire, element, Expectation::Millivolts(0.0))),
            Interface::I2c(_) | Interface::Spi(_) => written::first(job, wire, one, now_ns),
            Interface::Stepper(_) => {
                Some(expected(wire, element, Expectation::Motion(Motion::At(0))))
            }
            Interface::Uart(_)
            | Interface::Can(_)
            | Interface::Analog(_)
            | Interface::Icu(_)
            | Interface::Encoder(_)
            | Interface::OneWire(_)
            | Interface::Code(_) => None,
        }
    };
    wires.iter().filter_map(each).collect()
}

/// A motor that was told where to go, or how fast.
fn motion(wire: &JobConnection<'_>, element: usize, own: &Stepper, raw: f64) -> Expected {
    let most = f64::from(own.speed);
    let what = match own.mode {
        Mode::Position => {
            let step = raw.round().clamp(f64::from(i32::MIN), f64::from(i32::MAX));
            Motion::At(crate::arith::rounded(step))
        }
        Mode::Velocity => Motion::Goes(raw.round().clamp(-most, most)),
    };
    expected(wire, element, Expectation::Motion(what))
}

/// The motors of a device, which stand when the host is silent.
pub(super) fn stopped(job: &BoardJob<'_>, one: &JobDevice<'_>) -> Vec<Expected> {
    let motors = job.wires_of(one.device).into_iter();
    let motors = motors.filter(|wire| wire.connection.kind.stepper().is_some());
    let stands = |wire: &JobConnection<'_>| {
        let element = usize::from(wire.element());
        expected(wire, element, Expectation::Motion(Motion::Stands))
    };
    motors.map(stands).collect()
}

/// The raw value that a device takes when the host is silent; `None` if it keeps the last one.
pub(super) fn failsafe(one: &JobDevice<'_>) -> Option<f64> {
    one.device.coding.failsafe.or_else(|| one.device.kind.failsafe())
}

pub(super) fn expected(wire: &JobConnection<'_>, element: usize, what: Expectation) -> Expected {
    let pins: Vec<String> = wire.pads.iter().map(|pad| pad.pin.name.to_string()).collect();
    let name = format!("{} at {}", wire.title, pins.join(", "));
    Expected { element, wire: name, at: wire.index, what }
}

fn level(wire: &JobConnection<'_>, element: usize, own: &Digital, is_on: bool) -> Expected {
    expected(wire, element, Expectation::Level(Role::Out, is_on != own.active_low))
}

fn pulses(wire: &JobConnection<'_>, element: usize, own: &Pwm, raw: f64) -> Expected {
    let period_ns = 1e9 / f64::from(own.frequency_hz.max(1));
    let least_ns = own.min_us.map_or(0.0, |us| 1e3 * f64::from(us));
    let most_ns = own.max_us.map_or(period_ns, |us| 1e3 * f64::from(us));
    let share = raw.round().clamp(0.0, FULL_LEVEL) / FULL_LEVEL;
    let width_ns = least_ns + (most_ns - least_ns) * share;
    let [period_ns, width_ns] = [period_ns, width_ns].map(crate::arith::nanoseconds);
    expected(wire, element, Expectation::Pulses(Some((period_ns, width_ns))))
}

/// A motor's bridge: a duty and two direction pins, or a duty for each direction.
fn bridge(job: &BoardJob<'_>, one: &JobDevice<'_>, drive: Drive, raw: f64) -> Vec<Expected> {
    let raw = raw.round();
    let (forward, backward) = (raw.max(0.0), (-raw).max(0.0));
    let inputs = match drive {
        Drive::DirectionPins => vec![raw.abs(), forward, backward],
        Drive::DirectionPin => vec![raw.abs(), backward],
        Drive::TwoPwm => vec![forward, backward],
    };
    let each = |(index, input): (&ConnectionIndex, f64)| {
        let wire = job.wire(*index)?;
        match wire.connection.kind.interface() {
            Interface::Digital(own) => Some(level(wire, 0, own, input != 0.0)),
            Interface::Pwm(own) => Some(pulses(wire, 0, own, input)),
            Interface::Analog(_)
            | Interface::I2c(_)
            | Interface::Icu(_)
            | Interface::Encoder(_)
            | Interface::Uart(_)
            | Interface::Spi(_)
            | Interface::Dac(_)
            | Interface::Can(_)
            | Interface::OneWire(_)
            | Interface::Stepper(_)
            | Interface::Code(_) => None,
        }
    };
    one.device.connections.iter().zip(inputs).filter_map(each).collect()
}

/// A value in a frame, which is as long as the values in it require.
fn frame(
    job: &BoardJob<'_>,
    wire: &JobConnection<'_>,
    one: &JobDevice<'_>,
    raw: &[f64],
) -> Option<Expected> {
    let own = one.device.kind.can()?;
    let words = Words::of(one.device)?;
    let mask = words.in_frame(own.byte);
    let select = own.select();
    let mut length = own.length.map_or(0, u16::from);
    let mut resend_ms = u32::MAX;
    let mut is_selector = false;
    let mut devices = 0;
    for other in job.devices.iter().filter(|other| other.unit == one.unit) {
        let is_set = other.device.direction == Direction::Actuator;
        let Some(can) = other.device.kind.can().filter(|_| is_set) else { continue };
        if (can.frame_id, can.is_extended) != (own.frame_id, own.is_extended) {
            continue;
        }
        devices += 1;
        let others = can.select();
        if select.is_none() && others.is_some_and(|(of, _)| of & mask != 0) {
            is_selector = true;
        }
        if can.resend_ms > 0 && select.is_none() {
            resend_ms = resend_ms.min(can.resend_ms);
        }
        if others.is_none() || select.is_none() || others == select {
            let ends = u16::from(can.byte) + Words::of(other.device)?.wire_bytes();
            length = length.max(can.length.map_or(ends, u16::from));
        }
    }
    let mut data = [0_u8; 8];
    let bytes = words::bytes(&words, raw);
    for (target, byte) in data.iter_mut().skip(usize::from(own.byte)).zip(bytes) {
        *target = byte;
    }
    let own_bits = (mask, u64::from_le_bytes(data) & mask);
    // The last frame may be one that it selects for other devices: its own must be among the earlier ones.
    let select = if is_selector { own_bits } else { select.unwrap_or_default() };
    let sent = Sent {
        unit: number(job, wire)?,
        identifier: own.frame_id,
        is_extended: own.is_extended,
        length: u8::try_from(length.min(FRAME_BYTES)).ok()?,
        bits: own_bits,
        select,
        resend_ns: if resend_ms == u32::MAX { 0 } else { 1_000_000 * u64::from(resend_ms) },
        devices,
    };
    Some(expected(wire, 0, Expectation::Frame(sent)))
}
