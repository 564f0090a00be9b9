//! The user's controllers as both C runtimes see them: whom a field obeys, and the functions that carry its value.

use sensedsl_code::FieldPlan;
use sensedsl_job::{BoardJob, JobDevice, Owner};
use sensedsl_wire::Direction;

use crate::FallBackPlan;

/// A device that a controller reads or sets: its field, and the runtime's function.
#[derive(Clone, Debug)]
pub struct Access {
    /// The field in the user's code.
    pub ident: String,
    /// The device's name, as in `SENSE_FIELD_`.
    pub name: String,
    /// The runtime's function that carries the value.
    pub function: &'static str,
}

/// What a controller reads.
#[must_use]
pub fn reads(job: &BoardJob<'_>, fields: &[FieldPlan]) -> Vec<Access> {
    accesses(job, fields, read)
}

/// What a controller sets or reports.
#[must_use]
pub fn sets(job: &BoardJob<'_>, fields: &[FieldPlan]) -> Vec<Access> {
    accesses(job, fields, set)
}

/// The values that devices of code have at the start.
#[must_use]
pub fn first_values(job: &BoardJob<'_>) -> Vec<FallBackPlan> {
    let of_code =
        |one: &JobDevice<'_>| Some(FallBackPlan::of(one, one.device.kind.code()?.default));
    job.devices.iter().filter_map(of_code).collect()
}

/// Whom each field obeys, as the runtime calls it.
#[must_use]
pub fn owners(job: &BoardJob<'_>) -> Vec<&'static str> {
    let owner = |index| match job.owner(index) {
        Owner::Host => "UP_OWNER_HOST",
        Owner::Code => "UP_OWNER_CODE",
        Owner::CodeOrHost => "UP_OWNER_CODE_OR_HOST",
    };
    (0..job.devices.len()).map(owner).collect()
}

fn accesses(
    job: &BoardJob<'_>,
    fields: &[FieldPlan],
    function: fn(&JobDevice<'_>) -> &'static str,
) -> Vec<Access> {
    let one = |field: &FieldPlan| {
        let device = job.devices.get(field.index)?;
        let (ident, name) = (field.ident.clone(), device.name().to_owned());
        Some(Access { ident, name, function: function(device) })
    };
    fields.iter().filter_map(one).collect()
}

/// A value that nobody measures is good as soon as it is there.
fn read(one: &JobDevice<'_>) -> &'static str {
    let is_given = one.device.kind.code().is_some() || one.device.direction == Direction::Actuator;
    if is_given { "up_control_given" } else { "up_control_get" }
}

fn set(one: &JobDevice<'_>) -> &'static str {
    match one.device.direction {
        Direction::Actuator => "up_control_set",
        Direction::Sensor => "up_control_report",
    }
}
