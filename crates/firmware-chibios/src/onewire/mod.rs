//! Parts on one wire: plain pins whose bits the processor makes.

mod v1;

use sensedsl_firmware_c::runtime as core;
use sensedsl_job::kinds;
use sensedsl_model::kind::KindName;

pub(super) use kinds::onewire::number_of;

use super::chips;
use super::runtime::own;
use super::section::{Peripheral, Version};

/// The wires.
pub(super) const PERIPHERAL: Peripheral = Peripheral {
    name: "GPIO",
    kind: Some(KindName::OneWire),
    version: |drivers| &drivers.gpio,
    versions: &[
        Version { name: "GPIOv1", plan: v1::plan },
        Version { name: "GPIOv2", plan: v1::plan },
        Version { name: "GPIOv3", plan: v1::plan },
    ],
    lacks: chips::lacks,
    core: &[core::ONEWIRE],
    runtime: own!["up_onewire_bus.c", "up_onewire_bus.h", "up_ticks.h"],
};
