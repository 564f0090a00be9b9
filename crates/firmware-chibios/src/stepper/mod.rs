//! Stepper motors: timers that make one pulse at a time, on the driver of PWM outputs.

mod v1;

use sensedsl_firmware_c::runtime as core;
use sensedsl_model::kind::KindName;

use super::runtime::own;
use super::section::{Peripheral, Version, nothing};

/// The stepper motors.
pub(super) const PERIPHERAL: Peripheral = Peripheral {
    name: "timer",
    kind: Some(KindName::Stepper),
    version: |drivers| &drivers.timer,
    versions: &[Version { name: "TIMv1", plan: v1::plan }],
    lacks: nothing,
    core: &[core::STEPPER, core::COUNT],
    runtime: own!["up_motor.c", "up_motor.h"],
};
