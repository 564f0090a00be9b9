//! The expected outputs of a board, from an independent reading of its design: nothing here is shared with the
//! generators, their tables or the runtimes.
//!
//! In: a device and the raw values that it has been set to. Out: the signal that each of its wires must carry.

use sensedsl_job::{BoardJob, JobConnection, JobDevice};
use sensedsl_model::design::ConnectionIndex;
use sensedsl_model::kind::digital::Digital;
use sensedsl_model::kind::pwm::Pwm;
use sensedsl_model::kind::{Kind, Role};
use sensedsl_model::protocol::Drive;
use sensedsl_model::words::Words;
use sensedsl_wire::Direction;

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
    pub(super) what: What,
}

/// The expected level, pulses, voltage or data.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum What {
    Level(Role, bool),
    /// Period and width in nanoseconds; `None` if there must be no pulses.
    Pulses(Option<(u64, u64)>),
    Millivolts(f64),
    Write(Written),
    /// The unit of a serial port, and a message on it.
    Message(u8, Vec<u8>),
    Frame(Sent),
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

/// A device's wires with their places in the wiring.
pub(super) fn wires<'j, 'a>(
    job: &'j BoardJob<'a>,
    one: &JobDevice<'a>,
) -> Vec<(ConnectionIndex, &'j JobConnection<'a>)> {
    job.wires_of(one.device).into_iter().map(|wire| (wire.index, wire)).collect()
}

/// The number of a wire's unit on the bench.
fn number(job: &BoardJob<'_>, wire: &JobConnection<'_>) -> Option<u8> {
    wire.unit.and_then(|name| Units::new(job).number(name))
}

/// The levels that no value ever changes, such as the one on a standby input.
pub(super) fn constants(job: &BoardJob<'_>) -> Vec<Expected> {
    let all = job.connections.iter().filter(|one| one.devices.is_empty());
    let constant = |one: &JobConnection<'_>| {
        let Kind::Digital(own) = &one.connection.kind else { return None };
        let is_driven = one.connection.direction == Direction::Actuator;
        is_driven.then(|| level(one.index, one, 0, own, own.initial))
    };
    all.filter_map(constant).collect()
}

/// The expected outputs of a device that was set to these raw values.
pub(super) fn told(job: &BoardJob<'_>, one: &JobDevice<'_>, raw: &[f64]) -> Vec<Expected> {
    let wires = wires(job, one);
    let value = |element: usize| raw.get(element).copied().unwrap_or(0.0);
    if let Some(drive) = one.device.coding.drive {
        return bridge(drive, &wires, value(0));
    }
    let each = |(at, wire): &(ConnectionIndex, &JobConnection<'_>)| {
        let element = usize::from(wire.element());
        match &wire.connection.kind {
            Kind::Digital(own) => Some(level(*at, wire, element, own, value(element) != 0.0)),
            Kind::Pwm(own) => Some(pulses(*at, wire, element, own, value(element))),
            Kind::Dac(_) => {
                let code = value(element).round().clamp(0.0, FULL_CODE);
                // A 12-bit converter divides its reference by 4096.
                let what = What::Millivolts(code / (FULL_CODE + 1.0) * REFERENCE_MV);
                Some(expected(*at, wire, element, what))
            }
            Kind::I2c(_) | Kind::Spi(_) => write(job, (*at, wire), one, raw),
            Kind::Uart(own) => {
                let body = words::bytes(&Words::of(one.device)?, raw);
                let unit = number(job, wire)?;
                let what = What::Message(unit, message::framed(own, &body));
                Some(expected(*at, wire, 0, what))
            }
            Kind::Can(_) => frame(job, (*at, wire), one, raw),
            Kind::Analog(_) | Kind::Icu(_) | Kind::Encoder(_) => None,
        }
    };
    wires.iter().filter_map(each).collect()
}

/// The expected outputs of a device that the host has not set yet; empty if the design does not define them.
pub(super) fn untold(job: &BoardJob<'_>, one: &JobDevice<'_>, now_ns: u64) -> Vec<Expected> {
    let wires = wires(job, one);
    let safe = start(one);
    if let Some(safe) = safe {
        return told(job, one, &vec![safe; one.device.value.value.count()]);
    }
    let each = |(at, wire): &(ConnectionIndex, &JobConnection<'_>)| {
        let element = usize::from(wire.element());
        match &wire.connection.kind {
            Kind::Digital(own) => Some(level(*at, wire, element, own, own.initial)),
            Kind::Pwm(_) => Some(expected(*at, wire, element, What::Pulses(None))),
            Kind::Dac(_) => Some(expected(*at, wire, element, What::Millivolts(0.0))),
            Kind::I2c(_) | Kind::Spi(_) => written::first(job, (*at, wire), one, now_ns),
            Kind::Uart(_) | Kind::Can(_) | Kind::Analog(_) | Kind::Icu(_) | Kind::Encoder(_) => {
                None
            }
        }
    };
    wires.iter().filter_map(each).collect()
}

/// The raw value that pulses and voltages start with; `None` if there is no output at first.
fn start(one: &JobDevice<'_>) -> Option<f64> {
    match &one.device.kind {
        Kind::Pwm(own) => own.failsafe,
        Kind::Dac(own) => own.failsafe,
        Kind::Analog(_)
        | Kind::I2c(_)
        | Kind::Icu(_)
        | Kind::Encoder(_)
        | Kind::Digital(_)
        | Kind::Uart(_)
        | Kind::Spi(_)
        | Kind::Can(_) => None,
    }
}

/// The raw value that a device takes when the host is silent; `None` if it keeps the last one.
pub(super) fn failsafe(one: &JobDevice<'_>) -> Option<f64> {
    one.device.coding.failsafe.or_else(|| start(one))
}

pub(super) fn expected(
    at: ConnectionIndex,
    wire: &JobConnection<'_>,
    element: usize,
    what: What,
) -> Expected {
    let pins: Vec<String> = wire.pads.iter().map(|pad| pad.pin.name.to_string()).collect();
    let wire = format!("{} at {}", wire.title, pins.join(", "));
    Expected { element, wire, at, what }
}

fn level(
    at: ConnectionIndex,
    wire: &JobConnection<'_>,
    element: usize,
    own: &Digital,
    is_on: bool,
) -> Expected {
    expected(at, wire, element, What::Level(Role::Out, is_on != own.active_low))
}

fn pulses(
    at: ConnectionIndex,
    wire: &JobConnection<'_>,
    element: usize,
    own: &Pwm,
    raw: f64,
) -> Expected {
    let period_ns = 1e9 / f64::from(own.frequency_hz.max(1));
    let least_ns = own.min_us.map_or(0.0, |us| 1e3 * f64::from(us));
    let most_ns = own.max_us.map_or(period_ns, |us| 1e3 * f64::from(us));
    let share = raw.round().clamp(0.0, FULL_LEVEL) / FULL_LEVEL;
    let width_ns = least_ns + (most_ns - least_ns) * share;
    let [period_ns, width_ns] = [period_ns, width_ns].map(crate::arith::nanoseconds);
    expected(at, wire, element, What::Pulses(Some((period_ns, width_ns))))
}

/// A motor's bridge: a duty and two direction pins, or a duty for each direction.
fn bridge(
    drive: Drive,
    wires: &[(ConnectionIndex, &JobConnection<'_>)],
    raw: f64,
) -> Vec<Expected> {
    let raw = raw.round();
    let (forward, backward) = (raw.max(0.0), (-raw).max(0.0));
    let inputs = match drive {
        Drive::DirectionPins => vec![raw.abs(), forward, backward],
        Drive::TwoPwm => vec![forward, backward],
    };
    let all = wires.iter().zip(inputs);
    let each = |((at, wire), input): (&(ConnectionIndex, &JobConnection<'_>), f64)| match &wire
        .connection
        .kind
    {
        Kind::Digital(own) => Some(level(*at, wire, 0, own, input != 0.0)),
        Kind::Pwm(own) => Some(pulses(*at, wire, 0, own, input)),
        Kind::Analog(_)
        | Kind::I2c(_)
        | Kind::Icu(_)
        | Kind::Encoder(_)
        | Kind::Uart(_)
        | Kind::Spi(_)
        | Kind::Dac(_)
        | Kind::Can(_) => None,
    };
    all.filter_map(each).collect()
}

/// A value in a frame, which is as long as the values in it require.
fn frame(
    job: &BoardJob<'_>,
    (at, wire): (ConnectionIndex, &JobConnection<'_>),
    one: &JobDevice<'_>,
    raw: &[f64],
) -> Option<Expected> {
    let own = one.device.kind.can()?;
    let words = Words::of(one.device)?;
    let mask = words.in_frame(own.byte);
    let select = own.mux.as_ref().map(|mux| mux.bits);
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
        let others = can.mux.as_ref().map(|mux| mux.bits);
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
    Some(expected(at, wire, 0, What::Frame(sent)))
}
