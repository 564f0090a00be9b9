//! Exact clocks of devices' serial ports and of timers that output pulses.

use std::collections::BTreeMap;

use sensedsl_board::signal::UnitName;
use sensedsl_model::kind::Interface;
use sensedsl_model::kind::uart::{Parity, Uart};

use crate::clocks::{nearest, unit_hz};
use crate::context::{Context, Wired};
use crate::rows::{Count, Part, Row, clocks_ns, per_second};
use crate::units::MILLISECOND_NS;

pub(crate) fn rows(context: &Context<'_>) -> Vec<Row> {
    let mut rows = Vec::new();
    let mut outputs: BTreeMap<(UnitName, u32), Row> = BTreeMap::new();
    for wired in &context.elements {
        let Some(unit) = wired.wiring.unit.as_deref() else { continue };
        match wired.device.kind.interface() {
            Interface::Uart(uart) => rows.push(port(context, wired, unit, uart)),
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
            | Interface::Stepper(_) => {}
        }
    }
    rows.extend(outputs.into_values());
    rows
}

/// The row of a serial port.
fn port(context: &Context<'_>, wired: &Wired<'_>, unit: &str, uart: &Uart) -> Row {
    let mut row = Row::new(Part::Port, unit, vec![wired.index]);
    let cycle = context.cycle(wired);
    let bytes = message_bytes(uart);
    row.clock_hz = exact_baud(context, unit, uart.baud);
    row.cycle = Some(cycle);
    row.a_second = Some(Count::Bytes(per_second(bytes, cycle.delay_ms)));
    row.cycle_ns = row.clock_hz.map(|hz| clocks_ns(bytes * byte_bits(uart), hz));
    row.busy_ns = row.cycle_ns.map(|ns| per_second(ns, cycle.delay_ms));
    row.shortest_ms =
        row.cycle_ns.and_then(|ns| u32::try_from(ns.div_ceil(MILLISECOND_NS).max(1)).ok());
    row
}

/// The rate that a serial port derives from its clock.
pub(crate) fn exact_baud(context: &Context<'_>, unit: &str, asked: u32) -> Option<u32> {
    let profile = context.board.profile()?;
    let hz = unit_hz(context, profile.serials.iter().find(|serial| serial.name == unit)?)?;
    nearest(profile.serial_dividers.as_ref()?, hz, asked)
}

fn message_bytes(uart: &Uart) -> u64 {
    uart.start.len() as u64 + u64::from(uart.length_bytes) + uart.end.len() as u64
}

fn byte_bits(uart: &Uart) -> u64 {
    let parity = u64::from(uart.parity != Parity::None);
    1 + u64::from(uart.data_bits) + parity + u64::from(uart.stop_bits)
}
