//! Devices on serial ports. All versions of the system's driver are the same except for how a port inverts.

mod line;
mod v1;

use super::runtime::own;
use super::section::{Peripheral, Version, nothing};
use sensedsl_model::kind::KindName;

/// The serial ports.
pub(super) const PERIPHERAL: Peripheral = Peripheral {
    name: "serial",
    kind: Some(KindName::Uart),
    version: |drivers| &drivers.serial,
    versions: &[
        Version { name: "USARTv1", plan: v1::plan },
        Version { name: "USARTv2", plan: v1::plan },
        Version { name: "USARTv3", plan: v1::plan },
    ],
    lacks: nothing,
    core: &[],
    runtime: own!["up_line.c", "up_line.h", "up_uart.c", "up_uart.h"],
};
