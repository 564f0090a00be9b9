//! PWM outputs and the bridges of motors: the driver of the timers.

mod rate;
mod v1;

use sensedsl_model::kind::KindName;

use super::section::{Peripheral, Version, nothing};

/// See the module.
pub(super) const PERIPHERAL: Peripheral = Peripheral {
    name: "timer",
    kind: Some(KindName::Pwm),
    version: |drivers| &drivers.timer,
    versions: &[Version { name: "TIMv1", plan: v1::plan }],
    lacks: nothing,
    runtime: &[
        ("core/up_pulse_width.c", include_str!("../../../../runtime/core/up_pulse_width.c")),
        ("core/up_pulse_width.h", include_str!("../../../../runtime/core/up_pulse_width.h")),
        ("chibios/up_pwm.c", include_str!("../../../../runtime/chibios/up_pwm.c")),
        ("chibios/up_pwm.h", include_str!("../../../../runtime/chibios/up_pwm.h")),
    ],
};
