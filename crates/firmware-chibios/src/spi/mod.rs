//! Devices on SPI buses: the driver of the buses.

mod bus;
mod v1;
mod v2;
mod v3;

use sensedsl_model::kind::KindName;

use super::chips;
use super::runtime::own;
use super::section::{Peripheral, Version};
pub(super) use bus::number_of;

/// The SPI units. All MCUs have the system's second driver model.
pub(super) const PERIPHERAL: Peripheral = Peripheral {
    name: "SPI",
    kind: Some(KindName::Spi),
    version: |drivers| &drivers.spi,
    versions: &[
        Version { name: "SPIv1/driver_v2", plan: v1::plan },
        Version { name: "SPIv2/driver_v2", plan: v2::plan },
        Version { name: "SPIv3/driver_v2", plan: v3::plan },
    ],
    lacks: chips::lacks,
    core: &[],
    runtime: own!["up_spi_bus.c", "up_spi_bus.h"],
};
