//! Devices on serial ports: those that speak by themselves, and lines on which the board speaks with one part after the
//! other.

use std::collections::BTreeMap;

use sensedsl_board::profile::TargetProfile;
use sensedsl_board::signal::UnitName;
use sensedsl_diagnostics::Diagnostic;
use sensedsl_diagnostics::codes::e0506_hardware_limit;
use sensedsl_model::design::Part;
use sensedsl_model::kind::uart::{MessageChecksum, Uart};

use crate::part::MessagePlan;
use crate::{BoardJob, Cycle, JobConnection};

/// The time that a port's queue must bridge: the task that empties it may have to wait for others.
pub const PATIENCE_MS: u32 = 20;

/// The smallest and the largest queue of a port, in bytes.
pub const QUEUE_BYTES: std::ops::RangeInclusive<u32> = 64..=2_048;

/// The silence on the line that separates two messages if nothing else does: two characters, in ms. 0 for messages with
/// a checksum or an end.
#[must_use]
pub fn gap_ms(uart: &Uart, message: &MessagePlan) -> u32 {
    let is_reported = message.checksum != MessageChecksum::None || !uart.end.is_empty();
    let two_characters_ms = 24_000_u32.div_ceil(uart.baud.max(1));
    if is_reported { 0 } else { two_characters_ms.max(2) }
}

/// The bytes that arrive during [`PATIENCE_MS`].
#[must_use]
pub fn waiting_bytes(uart: &Uart) -> u32 {
    (uart.baud / 10).saturating_mul(PATIENCE_MS) / 1_000
}

/// The diagnostic for a device with inverted wires on an MCU whose ports cannot invert.
pub fn not_inverted(part: &Part, profile: &TargetProfile) -> Diagnostic {
    let name = &part.name;
    let message = format!("the serial ports of {} cannot invert their wires", profile.family);
    let help = format!(
        "put an inverter in front of {} and leave `invert` out, or take another MCU",
        name.value
    );
    e0506_hardware_limit::hardware_limit(name.span, &message, &help)
}

/// A line on which the board asks parts, tells them something, and waits for what they answer.
#[derive(Clone, Debug)]
pub struct Dialogue<'a> {
    /// The unit, as the wiring names it.
    pub unit: &'a str,
    /// How the line is set: all its parts agree.
    pub uart: &'a Uart,
    /// The cycle of its fastest part, with the highest priority of all its parts.
    pub cycle: Cycle,
    /// Its connections, one for each part, in the file's order.
    pub wires: Vec<&'a JobConnection<'a>>,
}

/// The settings of a connection's port.
#[must_use]
pub fn uart_of<'a>(job: &'a BoardJob<'a>, wire: &'a JobConnection<'a>) -> Option<&'a Uart> {
    let own = wire.connection.kind.uart();
    own.or_else(|| job.devices.get(*wire.devices.first()?)?.device.kind.uart())
}

/// Whether the board speaks with the part of a connection, instead of only listening or only sending.
#[must_use]
pub fn is_dialogue(job: &BoardJob<'_>, wire: &JobConnection<'_>) -> bool {
    let own = wire.connection.kind.uart();
    let devices = wire.devices.iter().filter_map(|index| job.devices.get(*index));
    let mut all = own.into_iter().chain(devices.filter_map(|one| one.device.kind.uart()));
    all.any(|uart| uart.exchange.is_dialogue())
}

/// The lines on which the board speaks with parts, in natural order.
#[must_use]
pub fn dialogues<'a>(job: &'a BoardJob<'a>) -> Vec<Dialogue<'a>> {
    let mut all: BTreeMap<UnitName, Dialogue<'a>> = BTreeMap::new();
    for wire in job.connections.iter().filter(|wire| is_dialogue(job, wire)) {
        let (Some(unit), Some(uart)) = (wire.unit, wire.connection.kind.uart()) else { continue };
        let line = all.entry(UnitName::new(unit)).or_insert_with(|| Dialogue {
            unit,
            uart,
            cycle: wire.cycle,
            wires: Vec::new(),
        });
        line.cycle.delay_ms = line.cycle.delay_ms.min(wire.cycle.delay_ms);
        line.cycle.prio = line.cycle.prio.max(wire.cycle.prio);
        line.wires.push(wire);
    }
    all.into_values().collect()
}

impl Dialogue<'_> {
    /// The name of its tables and of its thread: that of its only part, or of its unit.
    #[must_use]
    pub fn ident(&self) -> String {
        match self.wires.as_slice() {
            [one] => one.ident.clone(),
            _ => format!("{}_line", crate::snake(self.unit)),
        }
    }
}
