//! The judge: every value that a board reports against what the world did.
//!
//! A value that arrives at some time was measured a little earlier, and between measuring and arriving it is rounded,
//! coded and filtered. So it must lie within what the world was in a span of time, give or take what rounding can do.
//! Both are known for each device from its kind, its cycle and its filters. What is out of it, or does not come at all,
//! is a disagreement, and the worst of each device is kept.

mod age;
mod sensor;
mod tolerance;

use sensedsl_codegen::job::BoardJob;
use sensedsl_wire::Scalar;

use crate::bench::Bench;
use crate::truth::Subject;
use sensor::SensorJudge;

const MS: u64 = 1_000_000;
const SECOND: u64 = 1_000 * MS;

/// A value that disagrees, in the device's own unit.
#[derive(Clone, Debug, PartialEq)]
pub struct Wrong {
    /// When it arrived.
    pub at_ns: u64,
    /// Of which element.
    pub element: usize,
    /// What it should have been: from, to; none where nothing came at all.
    pub expected: Option<(f64, f64)>,
    /// What it was; of what did not come for how long, in seconds.
    pub got: f64,
    /// How far it is off, in tolerances.
    pub off: f64,
}

/// What was found out about a device.
#[derive(Clone, Debug, PartialEq)]
pub struct Judged {
    /// Its name.
    pub name: String,
    /// Its unit.
    pub quantity: String,
    /// Values that were compared.
    pub reports: u64,
    /// Values during and right after a fault that concerns it; they are not compared.
    pub excused: u64,
    /// Values that disagree, and silences.
    pub wrong: u64,
    /// The worst of them.
    pub worst: Option<Wrong>,
    /// How old a value may be.
    pub age_ns: u64,
}

/// Compares reports with the world.
#[derive(Clone, Debug)]
pub struct Judge {
    devices: Vec<SensorJudge>,
}

impl Judge {
    /// The judge of a board on its bench.
    #[must_use]
    pub fn new(job: &BoardJob<'_>, bench: &Bench) -> Self {
        let find = |subject: &Subject| job.devices.iter().find(|one| one.index == subject.device);
        let sensor =
            |subject: &Subject| Some(SensorJudge::new(job, bench, find(subject)?, subject));
        Self { devices: bench.subjects().iter().filter_map(sensor).collect() }
    }

    /// A report has arrived.
    pub fn take(&mut self, now_ns: u64, values: &[(u8, Vec<Scalar>)]) {
        for (id, elements) in values {
            if let Some(sensor) = self.devices.iter_mut().find(|one| one.subject.id == *id) {
                sensor.take(now_ns, elements);
            }
        }
    }

    /// The run is over.
    #[must_use]
    pub fn finish(mut self, now_ns: u64) -> Vec<Judged> {
        for sensor in &mut self.devices {
            sensor.silence(now_ns);
        }
        self.devices.into_iter().map(|one| one.judged).collect()
    }
}
