//! Input capture: the driver of the timers.

mod v1;

use sensedsl_firmware_c::runtime as core;
use sensedsl_model::kind::KindName;

use super::runtime::own;
use super::section::{Peripheral, Version, nothing};

/// The input captures.
pub(super) const PERIPHERAL: Peripheral = Peripheral {
    name: "timer",
    kind: Some(KindName::Icu),
    version: |drivers| &drivers.timer,
    versions: &[Version { name: "TIMv1", plan: v1::plan }],
    lacks: nothing,
    core: &[core::CAPTURE, core::COUNT, core::ELEMENTS],
    runtime: own!["up_icu.c", "up_icu.h"],
};
