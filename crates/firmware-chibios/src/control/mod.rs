//! The user's code: a thread for each controller, and a guard above them.

mod plan;

use sensedsl_model::kind::KindName;

use super::runtime::own;
use super::section::{Peripheral, Version, nothing};
pub(super) use plan::ControlPlan;

/// The user's code, which needs no driver of the system.
pub(super) const PERIPHERAL: Peripheral = Peripheral {
    name: "code",
    kind: Some(KindName::Code),
    version: |_| "code",
    versions: &[Version { name: "code", plan: plan::section }],
    lacks: nothing,
    core: &[],
    runtime: own!["up_control.c", "up_control.h"],
};
