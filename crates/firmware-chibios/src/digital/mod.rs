//! Levels of pins, inputs and outputs, for all versions of the pin driver.

mod v1;

use sensedsl_firmware_c::runtime as core;
use sensedsl_model::kind::KindName;

use super::runtime::own;
use super::section::{Peripheral, Version, nothing};

/// The digital inputs and outputs.
pub(super) const PERIPHERAL: Peripheral = Peripheral {
    name: "GPIO",
    kind: Some(KindName::Digital),
    version: |drivers| &drivers.gpio,
    versions: &[
        Version { name: "GPIOv1", plan: v1::plan },
        Version { name: "GPIOv2", plan: v1::plan },
        Version { name: "GPIOv3", plan: v1::plan },
    ],
    lacks: nothing,
    core: &[core::DEBOUNCE],
    runtime: own!["up_digital.c", "up_digital.h"],
};
