//! The user's code: a thread for each controller.

mod plan;

use sensedsl_model::kind::KindName;

use super::runtime::own;
use super::section::{Peripheral, Version, nothing};

/// The user's code, which needs no driver of the system.
pub(super) const PERIPHERAL: Peripheral = Peripheral {
    name: "code",
    kind: Some(KindName::Code),
    version: |_| "code",
    versions: &[Version { name: "code", plan: plan::plan }],
    lacks: nothing,
    core: &[],
    runtime: own!["up_control.c", "up_control.h"],
};
