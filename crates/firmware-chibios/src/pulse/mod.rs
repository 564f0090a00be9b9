//! Pulses that some captured devices need in each cycle: plain pins, set by a thread.

mod v2;

use super::runtime::own;
use super::section::{Peripheral, Version, nothing};

/// The pulses. The same driver sets up all other pads, so its version is required even if nothing needs a pulse.
pub(super) const PERIPHERAL: Peripheral = Peripheral {
    name: "GPIO",
    kind: None,
    version: |drivers| &drivers.gpio,
    versions: &[
        Version { name: "GPIOv1", plan: v2::plan },
        Version { name: "GPIOv2", plan: v2::plan },
        Version { name: "GPIOv3", plan: v2::plan },
    ],
    lacks: nothing,
    core: &[],
    runtime: own!["up_pulse.c", "up_pulse.h"],
};
