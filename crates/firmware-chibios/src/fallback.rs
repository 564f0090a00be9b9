//! The failsafe values of actuators that are applied as if the host had sent them.

use super::context::Context;
use sensedsl_firmware_c::FallBackPlan;
use sensedsl_job::Owner;

/// The values that are set when the host falls silent: what code sets is not the host's.
pub(super) fn of_host(context: &Context<'_>) -> Vec<FallBackPlan> {
    let job = context.job;
    let hosts =
        job.devices.iter().enumerate().filter(|(index, _)| job.owner(*index) == Owner::Host);
    hosts.filter_map(|(_, one)| FallBackPlan::new(one)).collect()
}
