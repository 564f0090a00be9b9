//! Pulses that some captured devices want each cycle: plain pins, set by a thread.

mod v2;

use super::runtime::own;
use super::section::{Peripheral, Version, nothing};

/// See the module. All other pads are set up by the same driver, so that its version is asked for even where
/// nothing wants a pulse.
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
