//! Devices on serial ports. All versions of the system's driver are the same except for how a port inverts.

mod v1;

use super::runtime::own;
use super::section::{Lacks, Peripheral, Version};
use sensedsl_job::{BoardJob, JobConnection};
use sensedsl_model::kind::KindName;
use sensedsl_wire::Direction;

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
    lacks: LACKS,
    core: &[],
    runtime: own!["up_uart.c", "up_uart.h"],
};

/// Numbers in text can be received but not yet sent.
const LACKS: Lacks = |job: &BoardJob<'_>, connection: &JobConnection<'_>| {
    let mut own = connection.devices.iter().filter_map(|field| job.devices.get(*field));
    let is_text = own
        .any(|one| one.device.direction == Direction::Actuator && one.device.coding.text.is_some());
    is_text.then_some("values that are sent as a text")
};
