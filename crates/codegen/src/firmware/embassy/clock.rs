//! The timer that the clock runs on.

use std::collections::BTreeSet;

use sensedsl_board::profile::TargetProfile;
use sensedsl_board::signal::UnitName;

use crate::job::BoardJob;

/// The first timer of the profile that no device has; none where all are taken.
pub(super) fn timer(job: &BoardJob<'_>, profile: &TargetProfile) -> Option<String> {
    let units: BTreeSet<UnitName> =
        job.connections.iter().filter_map(|one| one.unit).map(UnitName::new).collect();
    let is_free = |timer: &&String| !units.contains(&UnitName::new(timer));
    profile.kernel.timers.iter().find(is_free).cloned()
}
