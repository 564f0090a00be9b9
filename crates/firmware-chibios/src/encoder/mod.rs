//! Quadrature encoders: timers whose hardware counts both tracks, by their registers.

mod v1;

use sensedsl_model::kind::KindName;

use super::section::{Peripheral, Version, nothing};

/// See the module.
pub(super) const PERIPHERAL: Peripheral = Peripheral {
    name: "timer",
    kind: Some(KindName::Encoder),
    version: |drivers| &drivers.timer,
    versions: &[Version { name: "TIMv1", plan: v1::plan }],
    lacks: nothing,
    runtime: &[
        ("core/up_count.c", include_str!("../../../../runtime/core/up_count.c")),
        ("core/up_count.h", include_str!("../../../../runtime/core/up_count.h")),
        ("chibios/up_encoder.c", include_str!("../../../../runtime/chibios/up_encoder.c")),
        ("chibios/up_encoder.h", include_str!("../../../../runtime/chibios/up_encoder.h")),
    ],
};
