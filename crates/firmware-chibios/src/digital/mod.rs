//! Levels of pins, in and out: the driver of the pins, whatever version it has.

mod v1;

use sensedsl_model::kind::KindName;

use super::section::{Peripheral, Version, nothing};

/// See the module.
pub(super) const PERIPHERAL: Peripheral = Peripheral {
    name: "GPIO",
    kind: Some(KindName::Digital),
    version: |drivers| &drivers.gpio,
    versions: &[
        Version { name: "GPIOv1", plan: v1::plan },
        Version { name: "GPIOv2", plan: v1::plan },
        Version { name: "GPIOv3", plan: v1::plan },
    ],
    lacks: nothing,
    runtime: &[
        ("core/up_debounce.c", include_str!("../../../../runtime/core/up_debounce.c")),
        ("core/up_debounce.h", include_str!("../../../../runtime/core/up_debounce.h")),
        ("chibios/up_digital.c", include_str!("../../../../runtime/chibios/up_digital.c")),
        ("chibios/up_digital.h", include_str!("../../../../runtime/chibios/up_digital.h")),
    ],
};
