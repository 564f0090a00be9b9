//! Input capture: the driver of the timers.

mod v1;

use sensedsl_model::kind::KindName;

use super::section::{Peripheral, Version, nothing};

/// See the module.
pub(super) const PERIPHERAL: Peripheral = Peripheral {
    name: "timer",
    kind: Some(KindName::Icu),
    version: |drivers| &drivers.timer,
    versions: &[Version { name: "TIMv1", plan: v1::plan }],
    lacks: nothing,
    runtime: &[
        ("core/up_capture.c", include_str!("../../../../runtime/core/up_capture.c")),
        ("core/up_capture.h", include_str!("../../../../runtime/core/up_capture.h")),
        ("core/up_count.c", include_str!("../../../../runtime/core/up_count.c")),
        ("core/up_count.h", include_str!("../../../../runtime/core/up_count.h")),
        ("core/up_elements.c", include_str!("../../../../runtime/core/up_elements.c")),
        ("core/up_elements.h", include_str!("../../../../runtime/core/up_elements.h")),
        ("chibios/up_icu.c", include_str!("../../../../runtime/chibios/up_icu.c")),
        ("chibios/up_icu.h", include_str!("../../../../runtime/chibios/up_icu.h")),
    ],
};
