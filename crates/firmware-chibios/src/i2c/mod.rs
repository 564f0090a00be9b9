//! Devices on I2C buses: the driver of the buses.

mod bus;
mod v1;
mod v2;

use sensedsl_model::kind::KindName;

use super::chips;
use super::runtime::own;
use super::section::{Peripheral, Version};

/// The I2C units. The drivers with a timing register differ only in how they get their DMA streams.
pub(super) const PERIPHERAL: Peripheral = Peripheral {
    name: "I2C",
    kind: Some(KindName::I2c),
    version: |drivers| &drivers.i2c,
    versions: &[
        Version { name: "I2Cv1", plan: v1::plan },
        Version { name: "I2Cv2", plan: v2::plan },
        Version { name: "I2Cv3", plan: v2::plan },
        Version { name: "I2Cv4", plan: v2::plan },
    ],
    lacks: chips::lacks,
    core: &[],
    runtime: own!["up_i2c_bus.c", "up_i2c_bus.h"],
};
