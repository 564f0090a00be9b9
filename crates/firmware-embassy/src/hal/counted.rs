//! Edges that are counted, where an edge wakes a task instead of a handler: it may see two of them as one.

use sensedsl_job::JobDevice;
use sensedsl_model::kind::digital::Digital;
use sensedsl_wire::{Direction, ScalarType};

/// Whether any number of edges is counted in any time.
pub(super) fn is_counted(own: &Digital, devices: &[&JobDevice<'_>]) -> bool {
    let is_count = |one: &&JobDevice<'_>| {
        one.device.direction == Direction::Sensor
            && one.device.value.value.scalar != ScalarType::Bool
    };
    own.edge.is_some() && own.debounce_us == 0 && devices.iter().any(is_count)
}
