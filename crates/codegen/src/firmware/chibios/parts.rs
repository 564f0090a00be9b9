//! What parts say in tables of the runtime, beside their wires: chips, messages, formulas, filters.

use sensedsl_model::design::Device;

use super::context::Context;
use crate::job::{JobDevice, JobPart};

/// All tables, and which fields have a filter.
#[derive(Clone, Debug, Default)]
pub(super) struct PartsPlan {
    /// The C of the tables of each part.
    pub(super) tables: Vec<String>,
    /// One for each field, in order; empty where no field has a filter.
    pub(super) filters: Vec<Option<String>>,
}

pub(super) fn plan(context: &Context<'_>) -> PartsPlan {
    let job = context.job;
    let filtered: Vec<Option<String>> =
        job.devices.iter().map(|one| filter(one, &job.parts)).collect();
    let has_any = filtered.iter().any(Option::is_some);
    PartsPlan {
        tables: job.parts.iter().filter_map(tables).collect(),
        filters: if has_any { filtered } else { Vec::new() },
    }
}

/// The tables of a part. What I2C devices by themselves need is in their bus's section.
fn tables(one: &JobPart<'_>) -> Option<String> {
    let mut plan = one.plan.clone();
    if one.part.chip.is_none() {
        plan.bus = None;
    }
    (!plan.is_empty()).then(|| plan.c())
}

/// The name of a device's filter, where it has one.
fn filter(one: &JobDevice<'_>, parts: &[JobPart<'_>]) -> Option<String> {
    let Device { part, name, .. } = one.device;
    let plan = &parts.iter().find(|other| other.index == *part)?.plan;
    let has_one = plan.filters.iter().any(|filter| filter.field == name.value);
    has_one.then(|| name.value.clone())
}
