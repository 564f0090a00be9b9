//! Timing facts in a target profile: sampling times, clock dividers, the cost of the runtime.

use std::fmt;

use serde::Deserialize;

/// A sampling time in cycles of the converter's clock: a whole number, or a whole number and a
/// half.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Cycles {
    halves: u32,
}

impl Cycles {
    /// A whole number of cycles.
    #[must_use]
    pub const fn new(cycles: u32) -> Self {
        Self { halves: cycles.saturating_mul(2) }
    }

    /// A whole number of cycles and a half.
    pub(crate) const fn and_a_half(cycles: u32) -> Self {
        Self { halves: cycles.saturating_mul(2).saturating_add(1) }
    }

    /// Twice the number of cycles, which is always whole.
    #[must_use]
    pub const fn halves(self) -> u32 {
        self.halves
    }

    /// The number of cycles, rounded down.
    #[must_use]
    pub const fn whole(self) -> u32 {
        self.halves / 2
    }
}

impl fmt::Display for Cycles {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let half = if self.halves % 2 == 1 { ".5" } else { "" };
        write!(f, "{}{half}", self.whole())
    }
}

/// The timing register of an I²C unit (`TIMINGR`): the unit's clock, divided by the prescaler, is
/// counted for the low and the high phase of a bus clock.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct I2cTiming {
    /// The greatest prescaler.
    pub prescaler_max: u32,
}

/// How a unit's clock is divided down to the clock on its wires.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Dividers {
    /// The least and the greatest divider.
    pub range: [u32; 2],
    /// True if only powers of two in this range are possible.
    #[serde(default)]
    pub powers_of_two: bool,
    /// The least and the greatest number of steps per bit, besides the divider; 1 if there is only
    /// the divider.
    #[serde(default = "one_step")]
    pub steps: [u32; 2],
    /// The place in the system's source that the facts come from.
    pub source: String,
}

/// The cost of the runtime, in processor instructions per event.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Costs {
    /// The macro for the core's clock.
    pub clock: String,
    /// Clock cycles per hundred instructions.
    pub cycles_per_hundred: u32,
    /// Waking a thread for its cycle, and putting it to sleep.
    pub wake: u32,
    /// Starting a conversion, and handling its end.
    pub convert: u32,
    /// Storing an analog value.
    pub convert_value: u32,
    /// Adding a sample to a mean.
    pub convert_sample: u32,
    /// Checking a device on a bus.
    pub bus_device: u32,
    /// Starting a transfer on a bus, and handling its end.
    pub bus_transfer: u32,
    /// Sending an address on a bus, with its interrupts; a transfer that writes and then reads
    /// sends two.
    pub bus_phase: u32,
    /// Assembling an element of a value.
    pub bus_element: u32,
    /// Handling a byte of an element.
    pub bus_byte: u32,
    /// Sending a pulse on a line.
    pub pulse: u32,
    /// Handling an interrupt of a capture.
    pub capture: u32,
    /// Making a step of a motor: the interrupt, and when the next step is due.
    pub step: u32,
    /// Checking a capture in the reporter.
    pub capture_look: u32,
    /// Waking the reporter, checking whether anything is due, and putting it to sleep.
    pub report: u32,
    /// Beginning and ending a report.
    pub report_frame: u32,
    /// Adding a value to a report.
    pub report_value: u32,
    /// Encoding a byte of a report.
    pub report_byte: u32,
    /// Sending a report on a serial port.
    pub serial_frame: u32,
    /// Sending a byte of a report.
    pub serial_byte: u32,
    /// How the instructions were counted.
    pub source: String,
}

pub(super) fn one() -> u32 {
    1
}

fn one_step() -> [u32; 2] {
    [1, 1]
}
