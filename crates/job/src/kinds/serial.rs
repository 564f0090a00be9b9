//! Devices on serial ports.

use sensedsl_board::profile::TargetProfile;
use sensedsl_diagnostics::Diagnostic;
use sensedsl_diagnostics::codes::e0506_hardware_limit;
use sensedsl_model::design::Part;
use sensedsl_model::kind::uart::{MessageChecksum, Uart};

use crate::part::MessagePlan;

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
