//! Devices on I2C buses: the driver of the buses.

mod v1;

use sensedsl_model::kind::KindName;

use super::section::{Peripheral, Version, plain_only};

/// See the module.
pub(super) const PERIPHERAL: Peripheral = Peripheral {
    name: "I2C",
    kind: Some(KindName::I2c),
    version: |drivers| &drivers.i2c,
    versions: &[Version { name: "I2Cv1", plan: v1::plan }],
    lacks: plain_only,
    runtime: &[
        ("core/up_i2c.c", include_str!("../../../../../../runtime/core/up_i2c.c")),
        ("core/up_i2c.h", include_str!("../../../../../../runtime/core/up_i2c.h")),
        ("chibios/up_i2c_bus.c", include_str!("../../../../../../runtime/chibios/up_i2c_bus.c")),
    ],
};
