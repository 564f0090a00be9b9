//! Quadrature encoders: timers that count both tracks in hardware, set up by their registers.

mod v1;

use sensedsl_firmware_c::runtime as core;
use sensedsl_model::kind::KindName;

use super::runtime::own;
use super::section::{Peripheral, Version, nothing};

/// The quadrature encoders.
pub(super) const PERIPHERAL: Peripheral = Peripheral {
    name: "timer",
    kind: Some(KindName::Encoder),
    version: |drivers| &drivers.timer,
    versions: &[Version { name: "TIMv1", plan: v1::plan }],
    lacks: nothing,
    core: &[core::COUNT],
    runtime: own!["up_encoder.c", "up_encoder.h"],
};
