//! Analog sensors: the driver of the converters.
//!
//! `plan.rs` decides on conversion groups and threads, for all versions of the driver; one file for each version spells
//! its conversion group. `tables.c.txt` has the runtime's tables.

mod f1;
mod group;
mod plan;
#[cfg(test)]
mod tests;
mod v1;
mod v2;
mod v3;
mod v4;
mod v5;

use sensedsl_model::kind::KindName;

use super::runtime::own;
use super::section::{Peripheral, Version, nothing};

/// The analog converters.
pub(super) const PERIPHERAL: Peripheral = Peripheral {
    name: "ADC",
    kind: Some(KindName::Analog),
    version: |drivers| &drivers.adc,
    versions: &[
        Version { name: "ADCv1", plan: v1::plan },
        Version { name: "ADCv2", plan: v2::plan },
        Version { name: "ADCv3", plan: v3::plan },
        Version { name: "ADCv4", plan: v4::plan },
        Version { name: "ADCv5", plan: v5::plan },
        Version { name: "STM32F1xx", plan: f1::plan },
    ],
    lacks: nothing,
    core: &[],
    runtime: own!["up_adc.c", "up_adc.h"],
};
