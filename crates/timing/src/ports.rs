//! Exact clocks of devices' serial ports and of timers that output pulses.

use std::collections::{BTreeMap, BTreeSet};

use sensedsl_board::signal::UnitName;
use sensedsl_model::design::{Device, PartIndex};
use sensedsl_model::kind::Interface;
use sensedsl_model::kind::uart::{Parity, Uart};
use sensedsl_model::protocol::TextField;
use sensedsl_model::words::Words;

use crate::clocks::{nearest, unit_hz};
use crate::context::{Context, Wired};
use crate::rows::{Count, Part, Row, clocks_ns, per_second, shortest};
use crate::units::MILLISECOND_NS;

/// Bytes of a number in a text: its length depends on the number.
const SHORT_TEXT_BYTES: u64 = 8;

pub(crate) fn rows(context: &Context<'_>) -> Vec<Row> {
    let mut rows = Vec::new();
    let mut lines: BTreeMap<UnitName, Vec<(&Wired<'_>, &Uart)>> = BTreeMap::new();
    let mut heard: BTreeMap<UnitName, Vec<&Wired<'_>>> = BTreeMap::new();
    let mut outputs: BTreeMap<(UnitName, u32), Row> = BTreeMap::new();
    for wired in &context.elements {
        let Some(unit) = wired.wiring.unit.as_deref() else { continue };
        match wired.device.kind.interface() {
            Interface::Uart(uart)
                if uart.exchange.is_dialogue() || is_of_dialogue(context, wired) =>
            {
                lines.entry(UnitName::new(unit)).or_default().push((wired, uart));
            }
            Interface::Uart(_) => heard.entry(UnitName::new(unit)).or_default().push(wired),
            Interface::Pwm(pwm) => {
                let key = (UnitName::new(unit), pwm.frequency_hz);
                let fresh = || {
                    let mut row = Row::new(Part::Output, unit, Vec::new());
                    row.clock_hz = Some(pwm.frequency_hz);
                    row
                };
                let row = outputs.entry(key).or_insert_with(fresh);
                row.devices.push(wired.index);
                row.devices.dedup();
            }
            Interface::Analog(_)
            | Interface::I2c(_)
            | Interface::Icu(_)
            | Interface::Encoder(_)
            | Interface::Digital(_)
            | Interface::Spi(_)
            | Interface::Dac(_)
            | Interface::Can(_)
            | Interface::OneWire(_)
            | Interface::Stepper(_)
            | Interface::Code(_) => {}
        }
    }
    rows.extend(heard.iter().filter_map(|(unit, all)| port(context, all, unit.as_str())));
    rows.extend(lines.iter().flat_map(|(unit, on_line)| line(context, unit.as_str(), on_line)));
    rows.extend(outputs.into_values());
    rows
}

/// Whether the board speaks with the part of a device, although the device itself says nothing of it.
fn is_of_dialogue(context: &Context<'_>, wired: &Wired<'_>) -> bool {
    let of_part = context.elements.iter().filter(|one| one.device.part == wired.device.part);
    let mut all = of_part.filter_map(|one| one.device.kind.uart());
    all.any(|uart| uart.exchange.is_dialogue())
}

/// The rows of a line on which the board speaks with its parts, one for each cycle time: each request once with its
/// answer, and with the first row what is sent again and again. The pauses before answers are the parts' own, and are
/// not counted.
fn line(context: &Context<'_>, unit: &str, on_line: &[(&Wired<'_>, &Uart)]) -> Vec<Row> {
    let mut classes: BTreeMap<u32, Vec<(&Wired<'_>, &Uart)>> = BTreeMap::new();
    for (wired, own) in on_line {
        classes.entry(wired.device.delay_ms).or_default().push((*wired, *own));
    }
    let mut told: u64 = on_line.iter().map(|(wired, own)| told_again(wired.device, own)).sum();
    let mut rows = Vec::new();
    for (delay_ms, class) in &classes {
        let Some((first, uart)) = class.first() else { continue };
        let mut row = Row::new(Part::Port, unit, class.iter().map(|(one, _)| one.index).collect());
        let bytes = asked_in_a_cycle(class);
        let a_second = per_second(bytes, *delay_ms) + std::mem::take(&mut told);
        row.clock_hz = exact_baud(context, unit, uart.baud);
        row.cycle = Some(context.cycle(first));
        row.a_second = Some(Count::Bytes(a_second));
        row.cycle_ns = row.clock_hz.map(|hz| clocks_ns(bytes * byte_bits(uart), hz));
        row.busy_ns = row.clock_hz.map(|hz| clocks_ns(a_second * byte_bits(uart), hz));
        rows.push(row);
    }
    let none = vec![0; rows.len()];
    shortest(&mut rows, &none);
    rows
}

/// The bytes that parts with one cycle time are asked and answer.
fn asked_in_a_cycle(class: &[(&Wired<'_>, &Uart)]) -> u64 {
    let mut asked: Vec<(PartIndex, &[u8])> = Vec::new();
    let mut bytes = 0;
    for (wired, own) in class {
        let request = (wired.device.part, own.exchange.request.as_slice());
        if !request.1.is_empty() && !asked.contains(&request) {
            asked.push(request);
            bytes += asked_bytes(own);
        }
    }
    bytes
}

/// The bytes in a second of a command that is sent again and again.
fn told_again(device: &Device, uart: &Uart) -> u64 {
    match uart.exchange.resend_ms {
        0 => 0,
        resend_ms => per_second(told_bytes(device, uart), resend_ms),
    }
}

/// The bytes of a request and its answer.
fn asked_bytes(uart: &Uart) -> u64 {
    let exchange = &uart.exchange;
    let start = if exchange.sums_request { 0 } else { uart.start.len() };
    let body = exchange.body_bytes.map_or(SHORT_TEXT_BYTES, u64::from);
    let around = exchange.request.len() + start + uart.end.len();
    around as u64 + body + u64::from(uart.checksum.bytes())
}

/// The bytes of a command and what is said to it.
fn told_bytes(device: &Device, uart: &Uart) -> u64 {
    let exchange = &uart.exchange;
    let around = uart.start.len() + exchange.behind.len() + uart.end.len() + exchange.answer.len();
    let value = Words::of(device).map_or(SHORT_TEXT_BYTES, |words| u64::from(words.wire_bytes()));
    around as u64 + value + u64::from(uart.checksum.bytes())
}

/// The row of a serial port at which a part speaks by itself: all its values come in the same messages, once in the
/// shortest of their cycles.
fn port(context: &Context<'_>, all: &[&Wired<'_>], unit: &str) -> Option<Row> {
    let first = all.iter().min_by_key(|wired| wired.device.delay_ms)?;
    let of_wires = context.design.connection(first.wiring.connection);
    let uart = of_wires.and_then(|one| one.kind.uart())?;
    let mut row = Row::new(Part::Port, unit, all.iter().map(|wired| wired.index).collect());
    let cycle = context.cycle(first);
    let bytes = message_bytes(uart, all);
    row.clock_hz = exact_baud(context, unit, uart.baud);
    row.cycle = Some(cycle);
    row.a_second = Some(Count::Bytes(per_second(bytes, cycle.delay_ms)));
    row.cycle_ns = row.clock_hz.map(|hz| clocks_ns(bytes * byte_bits(uart), hz));
    row.busy_ns = row.cycle_ns.map(|ns| per_second(ns, cycle.delay_ms));
    row.shortest_ms =
        row.cycle_ns.and_then(|ns| u32::try_from(ns.div_ceil(MILLISECOND_NS).max(1)).ok());
    Some(row)
}

/// The rate that a serial port derives from its clock.
pub(crate) fn exact_baud(context: &Context<'_>, unit: &str, asked: u32) -> Option<u32> {
    let profile = context.board.profile()?;
    let hz = unit_hz(context, profile.serials.iter().find(|serial| serial.name == unit)?)?;
    nearest(profile.serial_dividers.as_ref()?, hz, asked)
}

/// The bytes of the message that has the values, or of all the sentences that have them.
fn message_bytes(uart: &Uart, all: &[&Wired<'_>]) -> u64 {
    let around = uart.start.len() as u64 + u64::from(uart.checksum.bytes()) + uart.end.len() as u64;
    let texts: Vec<(&TextField, u64)> = all.iter().filter_map(|wired| text(wired)).collect();
    if uart.is_length_given || texts.is_empty() {
        return around + u64::from(uart.length_bytes);
    }
    let sentences: BTreeSet<Option<&str>> =
        texts.iter().map(|(text, _)| text.sentence.as_deref()).collect();
    let values: u64 = texts.iter().map(|(_, count)| SHORT_TEXT_BYTES * count).sum();
    around * sentences.len() as u64 + values
}

/// A value that is written as a text, and how many numbers that is.
fn text<'a>(wired: &Wired<'a>) -> Option<(&'a TextField, u64)> {
    let text = wired.device.coding.text.as_ref()?;
    Some((text, wired.device.value.value.count() as u64))
}

fn byte_bits(uart: &Uart) -> u64 {
    let parity = u64::from(uart.parity != Parity::None);
    1 + u64::from(uart.data_bits) + parity + u64::from(uart.stop_bits)
}
