//! Wires that both ends pull low: how long a reading takes, how long the processor makes its bits, and how long it keeps
//! interrupts off for one of them.
//!
//! A slot of 1-Wire lasts 70 us with its recovery, a reset 1.1 ms (DS18B20, 19-7487). A burst of a DHT22 lasts 5 ms;
//! a board waits for 7 (AM2302).

use std::collections::BTreeMap;

use sensedsl_board::signal::UnitName;
use sensedsl_model::kind::onewire::{OneWire, OneWireProtocol};

use crate::context::{Context, Wired};
use crate::rows::{Count, Cycle, Part, Row, per_second, shortest};

const SLOT_NS: u64 = 70_000;
const RESET_NS: u64 = 1_100_000;
const BURST_NS: u64 = 7_000_000;
/// A bit is read, or a one is written, while interrupts are off.
const LOCK_NS: u64 = 13_000;
/// Bits of a byte, of a part's address with the command before it, and of that command alone.
const BYTE_BITS: u64 = 8;
const CALL_BITS: u64 = 72;
const SKIP_BITS: u64 = 8;

/// The name of the wire of a device: its pin.
pub(crate) fn wire(context: &Context<'_>, wired: &Wired<'_>) -> Option<UnitName> {
    wired.device.kind.onewire()?;
    let pin = wired.wiring.wires.first()?.pin(context.board)?;
    Some(UnitName::new(&pin.name.to_string()))
}

/// The time in which the processor makes the bits of a reading.
pub(crate) fn held_ns(own: &OneWire) -> u64 {
    if own.protocol == OneWireProtocol::Dht {
        return 0;
    }
    let call_bits = if own.rom.is_some() { CALL_BITS } else { SKIP_BITS };
    let bytes = own.trigger.len() as u64 + own.read.len() as u64 + u64::from(own.answer_bytes());
    (calls(own) * call_bits + bytes * BYTE_BITS + 1) * SLOT_NS
}

/// How often the part is called for a reading.
fn calls(own: &OneWire) -> u64 {
    1 + u64::from(!own.trigger.is_empty())
}

/// The time of a reading on its wire.
fn taken_ns(own: &OneWire) -> u64 {
    match own.protocol {
        OneWireProtocol::Dht => 1_000 * u64::from(own.pulse_us) + BURST_NS,
        OneWireProtocol::W1 => calls(own) * RESET_NS + held_ns(own),
    }
}

/// The devices whose wires are read, each part once.
pub(crate) fn read<'c, 'a>(context: &'c Context<'a>) -> impl Iterator<Item = &'c Wired<'a>> {
    let is_first = |at: usize, wired: &Wired<'_>| {
        let before = context.elements.iter().take(at);
        before
            .filter(|other| other.device.part == wired.device.part)
            .all(|other| context.cycle(other) != context.cycle(wired))
    };
    let wires = context.elements.iter().enumerate();
    wires
        .filter(move |(at, wired)| wired.device.kind.onewire().is_some() && is_first(*at, wired))
        .map(|(_, one)| one)
}

pub(crate) fn rows(context: &Context<'_>) -> Vec<Row> {
    let mut wires: BTreeMap<UnitName, BTreeMap<Cycle, Vec<&Wired<'_>>>> = BTreeMap::new();
    for wired in read(context) {
        let Some(name) = wire(context, wired) else { continue };
        wires.entry(name).or_default().entry(context.cycle(wired)).or_default().push(wired);
    }
    let mut all = Vec::new();
    for (name, cycles) in wires {
        let mut rows: Vec<Row> =
            cycles.into_iter().map(|(cycle, parts)| row(&name, cycle, &parts)).collect();
        let own: Vec<u64> = rows.iter().filter_map(|row| row.cycle_ns).collect();
        shortest(&mut rows, &own);
        all.extend(rows);
    }
    all
}

/// The row of the parts that are read together.
fn row(name: &UnitName, cycle: Cycle, parts: &[&Wired<'_>]) -> Row {
    let own = || parts.iter().filter_map(|wired| wired.device.kind.onewire());
    let mut row = Row::new(Part::Wire, name.as_str(), parts.iter().map(|one| one.index).collect());
    let taken_ns = own().map(taken_ns).sum();
    let bytes = own().map(|own| u64::from(own.answer_bytes())).sum();
    row.cycle = Some(cycle);
    row.cycle_ns = Some(taken_ns);
    row.a_second = Some(Count::Bytes(per_second(bytes, cycle.delay_ms)));
    row.busy_ns = Some(per_second(taken_ns, cycle.delay_ms));
    row.locked_ns = own().any(|own| own.protocol == OneWireProtocol::W1).then_some(LOCK_NS);
    row
}
