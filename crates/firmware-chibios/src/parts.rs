//! The runtime tables of parts, apart from their wires: chips, messages, formulas, filters.

use sensedsl_model::design::Device;

use super::context::Context;
use super::{onewire, spi};
use sensedsl_firmware_c::{self as c, DmaBuffer, Wiring};
use sensedsl_job::{JobConnection, JobDevice, JobPart};

/// All tables, and the fields that have a filter.
#[derive(Clone, Debug, Default)]
pub(super) struct PartsPlan {
    /// The C code of each part's tables.
    pub(super) tables: Vec<String>,
    /// The name of each field's filter, in order; empty if no field has a filter.
    pub(super) filters: Vec<Option<String>>,
}

pub(super) fn plan(context: &Context<'_>) -> PartsPlan {
    let job = context.job;
    let filtered: Vec<Option<String>> =
        job.devices.iter().map(|one| filter(one, &job.parts)).collect();
    let has_any = filtered.iter().any(Option::is_some);
    PartsPlan {
        tables: job.parts.iter().map(|one| tables(context, one)).collect(),
        filters: if has_any { filtered } else { Vec::new() },
    }
}

/// The tables of a part, with what depends on the wiring: the memory for its bus's buffers, and its chip select.
fn tables(context: &Context<'_>, one: &JobPart<'_>) -> String {
    let of_part = |other: &&JobConnection<'_>| {
        let is_bus = other.connection.kind.register_access().is_some();
        is_bus && other.connection.part == one.index
    };
    let wired = context.job.connections.iter().find(of_part);
    c::tables(
        &one.plan,
        Wiring {
            buffer: wired.map_or(DmaBuffer::Main, |wired| context.names.buffer(&wired.streams)),
            select: spi::number_of(context.job, one.index)
                .or_else(|| onewire::number_of(context.job, one.index)),
            shares_memory: false,
        },
    )
}

/// The name of a device's filter, if it has one.
fn filter(one: &JobDevice<'_>, parts: &[JobPart<'_>]) -> Option<String> {
    let Device { part, name, .. } = one.device;
    let plan = &parts.iter().find(|other| other.index == *part)?.plan;
    let has_one = plan.filters.iter().any(|filter| filter.field == name.value);
    has_one.then(|| one.ident.clone())
}
