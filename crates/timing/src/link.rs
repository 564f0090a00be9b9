//! The link: the volume of the reports in a second, and the capacity of the medium.

use std::collections::BTreeSet;

use sensedsl_model::design::{Device, Transport};
use sensedsl_wire::{Direction, STAMP_BYTES};

use crate::context::Context;
use crate::ports::exact_baud;
use crate::rows::{Count, Part, Row};
use crate::units::SECOND_NS;

/// The reporter's cycle, unless something requires another.
const REPORT_MS: u32 = 10;
/// Bits of a byte on a serial line: a start bit, eight data bits, a stop bit.
const SERIAL_BYTE_BITS: u32 = 10;
/// Most bytes that a full-speed device can send in bulk transfers: 19 packets of 64 bytes in a
/// frame of one millisecond (USB 2.0, table 5-9).
const USB_BYTES_A_SECOND: u32 = 1_216_000;
/// The time that the rest of a frame may take in addition to its time on the line.
const PATIENCE_MS: u32 = 50;

/// The volume of the reports in a second.
pub(crate) struct Reports {
    /// The reporter's cycle.
    pub(crate) cycle_ms: u32,
    /// Reports per second, at most.
    pub(crate) count: u64,
    /// Values per second.
    pub(crate) values: u64,
    /// Bytes per second, including the frames.
    pub(crate) bytes: u64,
    /// The part of these bytes from devices that are polled in cycles.
    pub(crate) cyclic_bytes: u64,
}

/// The report cycle: that of the link's `rate`, or else the shortest cycle time of a device, at
/// most `REPORT_MS`.
pub(crate) fn report_ms(context: &Context<'_>) -> u32 {
    if let Some(report_ms) = context.board.link.report_ms() {
        return report_ms;
    }
    let served =
        context.devices.iter().filter(|wired| !wired.device.kind.name().spec().triggers_itself);
    served.map(|wired| wired.device.delay_ms).fold(REPORT_MS, u32::min).max(1)
}

pub(crate) fn reports(context: &Context<'_>) -> Reports {
    let cycle_ms = report_ms(context);
    if context.board.link.transport == Transport::None {
        return Reports { cycle_ms, count: 0, values: 0, bytes: 0, cyclic_bytes: 0 };
    }
    let most = 1_000_u64.div_ceil(u64::from(cycle_ms));
    // In thousandths, so that slow devices count as well.
    let rate = |device: &Device| {
        let own = device.measured_every_ms().map(|ms| 1_000_000 / u64::from(ms.max(1)));
        own.unwrap_or(most * 1_000).min(most * 1_000)
    };
    let sensors = || {
        let all = context.devices.iter().map(|wired| wired.device);
        all.filter(|device| device.direction == Direction::Sensor)
    };
    let item = |device: &Device| 1 + device.value.value.size_bytes() as u64;
    let sum = |what: &dyn Fn(&Device) -> u64, cyclic: bool| -> u64 {
        let wanted = sensors().filter(|device| !cyclic || device.measured_every_ms().is_some());
        wanted.map(|device| rate(device) * what(device)).sum::<u64>().div_ceil(1_000)
    };
    let frames = |cyclic: bool| {
        // Devices with the same rate and start are read together, and are in the same report.
        let wanted = context.devices.iter().filter(|wired| {
            let is_sensor = wired.device.direction == Direction::Sensor;
            is_sensor && (!cyclic || wired.device.measured_every_ms().is_some())
        });
        let paces: BTreeSet<(u64, u32)> =
            wanted.map(|wired| (rate(wired.device), context.cycle(wired).start_ms)).collect();
        paces.iter().map(|(rate, _)| rate).sum::<u64>().div_ceil(1_000).min(most)
    };
    let bytes = |cyclic: bool| {
        let (values, frames) = (sum(&item, cyclic), frames(cyclic));
        values + frames * frame_bytes(context, values.checked_div(frames).unwrap_or_default())
    };
    Reports {
        cycle_ms,
        count: frames(false),
        values: sum(&|_| 1, false),
        bytes: bytes(false),
        cyclic_bytes: bytes(true),
    }
}

/// Bytes that a frame adds to a payload of this many bytes.
fn frame_bytes(context: &Context<'_>, payload: u64) -> u64 {
    let checksum = context.board.link.checksum.size_bytes() as u64;
    let stamp = if context.board.link.stamp { STAMP_BYTES as u64 } else { 0 };
    let digits = u64::from((payload + checksum + stamp).checked_ilog10().unwrap_or(0)) + 1;
    digits + 2 + checksum + stamp
}

/// Bytes that the medium carries per second.
pub(crate) fn capacity(context: &Context<'_>) -> (Option<u32>, Option<u32>) {
    match context.board.link.transport {
        Transport::None => (None, None),
        Transport::Usb => (None, Some(USB_BYTES_A_SECOND)),
        Transport::Uart => {
            let unit = context.wiring.link.as_ref().map(|link| link.unit.as_str());
            let baud = unit.and_then(|unit| exact_baud(context, unit, context.board.link.baud));
            (baud, baud.map(|baud| baud / SERIAL_BYTE_BITS))
        }
    }
}

pub(crate) fn rows(context: &Context<'_>) -> Vec<Row> {
    let name = match (context.board.link.transport, &context.wiring.link) {
        (Transport::Usb, _) => "USB".to_owned(),
        (Transport::Uart, Some(link)) => link.unit.clone(),
        (Transport::Uart, None) | (Transport::None, _) => return Vec::new(),
    };
    let sensors =
        context.devices.iter().filter(|wired| wired.device.direction == Direction::Sensor);
    let mut row = Row::new(Part::Link, name, sensors.map(|wired| wired.index).collect());
    let reports = reports(context);
    let (clock_hz, bytes) = capacity(context);
    row.clock_hz = clock_hz;
    row.a_second = Some(Count::Bytes(reports.bytes));
    row.busy_ns = bytes.map(|most| busy_ns(reports.bytes, most));
    vec![row]
}

/// How long this many bytes take.
pub(crate) fn busy_ns(bytes: u64, most_a_second: u32) -> u64 {
    bytes.saturating_mul(SECOND_NS) / u64::from(most_a_second.max(1))
}

/// How long the reporter waits until the rest of a frame has gone out: its time on the line plus a
/// margin.
#[must_use]
pub fn finish_ms(frame_bytes: usize, baud: Option<u32>) -> u32 {
    let Some(baud) = baud else { return PATIENCE_MS };
    let bits = u64::try_from(frame_bytes).unwrap_or(u64::MAX) * u64::from(SERIAL_BYTE_BITS);
    let line_ms = bits.saturating_mul(1_000).div_ceil(u64::from(baud.max(1)));
    PATIENCE_MS.saturating_add(u32::try_from(line_ms).unwrap_or(u32::MAX))
}
