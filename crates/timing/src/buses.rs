//! Buses: how long the transfers of their devices take at the bus's clock.
//!
//! An I2C transfer is a start condition, nine clocks per byte, a second start condition before the
//! bytes that are read, and a stop condition with the time that the bus stays free after it
//! (UM10204, 3.1). Each condition is counted as one clock: the specification's minimum times for
//! each part of them are between 0.4 and 0.7 of a clock.

use std::collections::BTreeMap;

use sensedsl_board::signal::UnitName;
use sensedsl_model::design::Device;
use sensedsl_model::kind::Interface;
use sensedsl_model::kind::can::Can;
use sensedsl_model::kind::i2c::I2c;
use sensedsl_model::kind::spi::Spi;
use sensedsl_wire::Direction;

use crate::can_bit::can_bit;
use crate::clocks::{at_most, unit_hz};
use crate::context::{Context, Wired};
use crate::i2c_clock::{self, BusClock};
use crate::processor::{Transfers, Work};
use crate::rows::{Count, Part, Row, clocks_ns, shortest};
use crate::strips;

/// Clocks of a byte with its acknowledge.
const I2C_BYTE_CLOCKS: u64 = 9;
/// Clocks of a start condition, and of a stop condition with the pause after it.
const I2C_CONDITION_CLOCKS: u64 = 1;
/// Clocks of a byte.
const SPI_BYTE_CLOCKS: u64 = 8;
/// Bits of a frame with an extended identifier, without its data, including the stuff bits in the
/// worst case.
const CAN_FRAME_BITS: u64 = 67 + 13;
/// Bits of a byte, including the stuff bits in the worst case.
const CAN_BYTE_BITS: u64 = 10;

/// What a device does on its bus in one of its cycles, and the milliseconds between two such
/// cycles.
pub(crate) struct Script {
    pub(crate) transfers: Transfers,
    pub(crate) clocks: u64,
    pub(crate) every_ms: u32,
}

impl Transfers {
    /// One transfer of only a value, without the bytes around it on the bus.
    fn of_value(device: &Device, value_bytes: u64) -> Self {
        let elements = device.value.value.count() as u64;
        Self { count: 1, phases: 1, bytes: 0, elements, value_bytes }
    }
}

pub(crate) fn i2c_script(context: &Context<'_>, wired: &Wired<'_>, i2c: &I2c) -> Script {
    let device = wired.device;
    let least = context.board.profile().map_or(1, |profile| profile.i2c.read_bytes_min);
    let length = strips::sent(context, wired).unwrap_or(i2c.length_bytes.into());
    // Only a part whose registers have two bytes can have one beyond 0xFF; its other registers are
    // counted as one byte less.
    let register = i2c.register.map_or(0, |register| 1 + u64::from(register > 0xFF));
    let mut transfers = Transfers::of_value(device, length);
    match device.direction {
        Direction::Actuator => transfers.bytes = 1 + register + i2c.start.len() as u64 + length,
        Direction::Sensor => {
            transfers.bytes = 1 + length.max(u64::from(least));
            if register > 0 {
                transfers.bytes += 1 + register;
                transfers.phases += 1;
            }
            if !i2c.trigger.is_empty() {
                transfers.count += 1;
                transfers.bytes += 1 + i2c.trigger.len() as u64;
                transfers.phases += 1;
            }
        }
    }
    let conditions = transfers.phases + transfers.count;
    let clocks = transfers.bytes * I2C_BYTE_CLOCKS + conditions * I2C_CONDITION_CLOCKS;
    Script { transfers, clocks, every_ms: device.measured_every_ms().unwrap_or(device.delay_ms) }
}

fn spi_script(context: &Context<'_>, wired: &Wired<'_>, spi: &Spi) -> Script {
    let own = spi.read.len() as u64 + u64::from(spi.length_bytes);
    let bytes = strips::sent(context, wired).unwrap_or(own);
    let transfers = Transfers { bytes, ..Transfers::of_value(wired.device, bytes) };
    Script { transfers, clocks: bytes * SPI_BYTE_CLOCKS, every_ms: wired.device.delay_ms }
}

fn can_script(wired: &Wired<'_>, can: &Can) -> Script {
    let bytes = u64::from(can.byte) + wired.device.value.value.size_bytes() as u64;
    let clocks = CAN_FRAME_BITS + bytes * CAN_BYTE_BITS;
    let transfers = Transfers { bytes, ..Transfers::of_value(wired.device, bytes) };
    Script { transfers, clocks, every_ms: wired.device.delay_ms }
}

/// The work of a device on its bus.
pub(crate) fn script(context: &Context<'_>, wired: &Wired<'_>) -> Option<Script> {
    match wired.device.kind.interface() {
        Interface::I2c(i2c) => Some(i2c_script(context, wired, i2c)),
        Interface::Spi(spi) => Some(spi_script(context, wired, spi)),
        Interface::Can(can) => Some(can_script(wired, can)),
        Interface::Analog(_)
        | Interface::Icu(_)
        | Interface::Encoder(_)
        | Interface::Digital(_)
        | Interface::Uart(_)
        | Interface::Pwm(_)
        | Interface::Dac(_)
        | Interface::OneWire(_)
        | Interface::Stepper(_)
        | Interface::Code(_) => None,
    }
}

/// The greatest clock that all devices of a unit support.
pub(crate) fn asked_hz<'w, 'a: 'w>(on_bus: impl Iterator<Item = &'w Wired<'a>>) -> Option<u32> {
    let asked = on_bus.filter_map(|wired| match wired.device.kind.interface() {
        Interface::I2c(i2c) => Some(i2c.speed_hz),
        Interface::Spi(spi) => Some(spi.clock_hz),
        Interface::Can(can) => Some(can.bitrate_hz),
        Interface::Analog(_)
        | Interface::Icu(_)
        | Interface::Encoder(_)
        | Interface::Digital(_)
        | Interface::Uart(_)
        | Interface::Pwm(_)
        | Interface::Dac(_)
        | Interface::OneWire(_)
        | Interface::Stepper(_)
        | Interface::Code(_) => None,
    });
    asked.min()
}

/// The exact clock of a bus whose devices support this clock.
pub(crate) fn exact_hz(context: &Context<'_>, unit: &UnitName, asked_hz: u32) -> Option<u32> {
    let profile = context.board.profile()?;
    let facts = profile.unit(unit.as_str())?;
    let hz = unit_hz(context, facts)?;
    let is_in = |units: &[sensedsl_board::profile::Unit]| units.iter().any(|one| one == facts);
    if is_in(&profile.i2cs) {
        let asked_hz = asked_hz.min(profile.i2c.speed_max_hz);
        i2c_clock::fastest(&profile.i2c, hz, asked_hz).map(|BusClock { speed_hz, .. }| speed_hz)
    } else if is_in(&profile.spis) {
        at_most(profile.spi_dividers.as_ref()?, hz, asked_hz)
    } else {
        can_bit(profile.can_dividers.as_ref()?, hz, asked_hz)?.rate_hz(hz)
    }
}

pub(crate) fn rows(context: &Context<'_>, work: &Work) -> Vec<Row> {
    let mut units: BTreeMap<UnitName, (Vec<Row>, Vec<u64>)> = BTreeMap::new();
    for ((unit, cycle), devices) in context.classes(|wired| script(context, wired)) {
        let on_unit = || {
            let all = context.elements.iter();
            all.filter(|wired| wired.wiring.unit.as_deref() == Some(unit.as_str()))
        };
        let pulses = on_unit()
            .find_map(|wired| strips::on_unit(context, unit.as_str(), wired.device.kind.spi()?));
        let hz = match pulses {
            Some(pulses) => Some(pulses.clock_hz),
            None => asked_hz(on_unit()).and_then(|asked| exact_hz(context, &unit, asked)),
        };
        let indices = devices.iter().map(|(wired, _)| wired.index).collect();
        let mut row = Row::new(Part::Bus, unit.as_str(), indices);
        let scripts = || devices.iter().map(|(_, script)| script);
        let clocks = scripts().map(|script| script.clocks).sum();
        let a_second = |what: fn(&Script) -> u64| -> u64 {
            scripts().map(|script| what(script) * 1_000 / u64::from(script.every_ms.max(1))).sum()
        };
        row.cycle = Some(cycle);
        row.clock_hz = hz;
        row.a_second = Some(Count::Bytes(a_second(|script| script.transfers.bytes)));
        row.cycle_ns = hz.map(|hz| clocks_ns(clocks, hz));
        // The work that is due each cycle; a device that answers late only lowers it.
        row.busy_ns = hz.map(|hz| clocks_ns(a_second(|script| script.clocks), hz));
        let transfers = scripts().map(|script| script.transfers);
        let own_ns = row.cycle_ns.unwrap_or_default() + work.of_bus(transfers);
        let (rows, own) = units.entry(unit).or_default();
        rows.push(row);
        own.push(own_ns);
    }
    let finish = |(mut rows, own): (Vec<Row>, Vec<u64>)| {
        shortest(&mut rows, &own);
        rows
    };
    units.into_values().flat_map(finish).collect()
}
