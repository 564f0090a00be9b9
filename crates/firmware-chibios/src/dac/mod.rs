//! DAC outputs.

mod v1;

use sensedsl_model::kind::KindName;

use super::runtime::own;
use super::section::{Peripheral, Version, nothing};

/// The digital-analog converters.
pub(super) const PERIPHERAL: Peripheral = Peripheral {
    name: "DAC",
    kind: Some(KindName::Dac),
    version: |drivers| &drivers.dac,
    versions: &[Version { name: "DACv1", plan: v1::plan }],
    lacks: nothing,
    core: &[],
    runtime: own!["up_dac.c", "up_dac.h"],
};
