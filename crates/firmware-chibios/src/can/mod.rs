//! Devices on CAN buses: the tables are the same for all controllers; the differences are in the runtime.

mod frames;

use super::runtime::own;
use super::section::{Peripheral, Version, nothing};
use sensedsl_model::kind::KindName;

/// The CAN controllers.
pub(super) const PERIPHERAL: Peripheral = Peripheral {
    name: "CAN",
    kind: Some(KindName::Can),
    version: |drivers| &drivers.can,
    versions: &[
        Version { name: "CANv1", plan: frames::plan },
        Version { name: "FDCANv1", plan: frames::plan },
        Version { name: "FDCANv2", plan: frames::plan },
    ],
    lacks: nothing,
    core: &[],
    runtime: own!["up_can.c", "up_can.h"],
};
