//! Facts of time in a target profile: sampling times, how clocks are divided, what the runtime costs.

use std::fmt;

use serde::Deserialize;

/// A sampling time in cycles of the converter's clock: whole, or and a half.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Cycles {
    halves: u32,
}

impl Cycles {
    /// So many cycles.
    #[must_use]
    pub const fn new(cycles: u32) -> Self {
        Self { halves: cycles.saturating_mul(2) }
    }

    /// So many cycles and a half.
    pub(crate) const fn and_a_half(cycles: u32) -> Self {
        Self { halves: cycles.saturating_mul(2).saturating_add(1) }
    }

    /// Twice the cycles, which is whole.
    #[must_use]
    pub const fn halves(self) -> u32 {
        self.halves
    }

    /// The whole cycles.
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

/// The timing register of an I²C unit (`TIMINGR`): the unit's clock, divided by the prescaler, is counted for the low
/// and the high part of a bus clock.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct I2cTiming {
    /// The greatest prescaler.
    pub prescaler_max: u32,
}

/// How a unit's clock is divided to the one on its wires.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Dividers {
    /// The least and the greatest divider.
    pub range: [u32; 2],
    /// Only the powers of two among them.
    #[serde(default)]
    pub powers_of_two: bool,
    /// The least and the greatest number of steps that a bit is made of beside the divider; 1 where
    /// the divider alone makes it.
    #[serde(default = "one_step")]
    pub steps: [u32; 2],
    /// Where in the system's source the facts were read.
    pub source: String,
}

/// What the runtime costs the processor, in instructions.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Costs {
    /// The macro of the core's clock.
    pub clock: String,
    /// Clock cycles of a hundred instructions.
    pub cycles_per_hundred: u32,
    /// A thread wakes for its cycle and sleeps again.
    pub wake: u32,
    /// A conversion is started, and its end is noticed.
    pub convert: u32,
    /// An analog value is stored.
    pub convert_value: u32,
    /// A sample is added to a mean.
    pub convert_sample: u32,
    /// A device on a bus is looked at.
    pub bus_device: u32,
    /// A transfer on a bus is started, and its end is noticed.
    pub bus_transfer: u32,
    /// An address on a bus with its interrupts: a transfer that writes and then reads has two.
    pub bus_phase: u32,
    /// An element of a value is put together.
    pub bus_element: u32,
    /// A byte of it.
    pub bus_byte: u32,
    /// A line gets a pulse.
    pub pulse: u32,
    /// An interrupt of a capture.
    pub capture: u32,
    /// A capture is looked at by the reporter.
    pub capture_look: u32,
    /// The reporter wakes, looks whether anything is due, and sleeps again.
    pub report: u32,
    /// A report is begun and ended.
    pub report_frame: u32,
    /// A value goes into a report.
    pub report_value: u32,
    /// A byte of a report is encoded.
    pub report_byte: u32,
    /// A report goes out of a serial port.
    pub serial_frame: u32,
    /// A byte of it.
    pub serial_byte: u32,
    /// How it was counted.
    pub source: String,
}

pub(super) fn one() -> u32 {
    1
}

fn one_step() -> [u32; 2] {
    [1, 1]
}
