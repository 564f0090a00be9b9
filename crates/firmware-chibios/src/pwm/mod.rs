//! PWM outputs and the bridges of motors: the driver of the timers.

mod rate;
mod v1;

use sensedsl_firmware_c::runtime as core;
use sensedsl_model::kind::KindName;

use super::runtime::own;
use super::section::{Peripheral, Version, nothing};

/// The PWM outputs.
pub(super) const PERIPHERAL: Peripheral = Peripheral {
    name: "timer",
    kind: Some(KindName::Pwm),
    version: |drivers| &drivers.timer,
    versions: &[Version { name: "TIMv1", plan: v1::plan }],
    lacks: nothing,
    core: &[core::PULSE_WIDTH],
    runtime: own!["up_pwm.c", "up_pwm.h"],
};
