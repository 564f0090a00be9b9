//! What is broken around a board: a fault of the world in, the part and the units that it hits out.

use sensedsl_job::BoardJob;
use sensedsl_model::design::PartIndex;

use crate::world::{Fault, FaultKind};

/// A fault, the part that it hits, and the units of that part's wires.
#[derive(Clone, Debug)]
pub(super) struct Broken {
    pub(super) fault: Fault,
    pub(super) part: Option<PartIndex>,
    pub(super) units: Vec<String>,
}

impl Broken {
    pub(super) fn new(job: &BoardJob<'_>, fault: &Fault) -> Self {
        let device = fault.device.and_then(|device| job.design.device(device));
        let part = device.map(|device| device.part);
        let of_part = job.connections.iter().filter(|one| Some(one.connection.part) == part);
        let units = of_part.filter_map(|one| one.unit.map(str::to_owned)).collect();
        Self { fault: fault.clone(), part, units }
    }

    /// Whether it is a fault of that kind, and is there now.
    pub(super) fn is(&self, kind: FaultKind, now_ns: u64) -> bool {
        self.fault.kind == kind && self.fault.is_there(now_ns)
    }

    /// Whether nothing comes from the part now.
    pub(super) fn cuts(&self, now_ns: u64) -> bool {
        self.is(FaultKind::Torn, now_ns) || self.is(FaultKind::Silent, now_ns)
    }
}
