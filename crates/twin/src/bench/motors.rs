//! Motors on the bench: each has a track of its own, which a sensor of its position tells.

use sensedsl_job::BoardJob;
use sensedsl_model::design::ConnectionIndex;
use sensedsl_wire::Direction;

use super::Bench;
use crate::commands::track::Track;
use crate::truth::scale_of;
use crate::world::{Shape, Signal};

impl Bench {
    /// Motors count their steps; a sensor of one tells where its own is.
    pub(super) fn motors(&mut self, job: &BoardJob<'_>) {
        for one in &job.connections {
            let Some(motor) = one.connection.kind.stepper() else { continue };
            let over = one.devices.iter().filter_map(|at| job.devices.get(*at));
            let sensor = over.map(|of| of.device).find(|of| of.direction == Direction::Sensor);
            let scale = sensor.map(|of| scale_of(&of.shown)).unwrap_or_default();
            let track = Track::new(motor.clone(), scale);
            let subject = sensor.and_then(|of| self.subject(of));
            if let Some(subject) = subject.and_then(|place| self.subjects.get_mut(place)) {
                subject.signals = vec![Signal::of(Shape::Walked(track.clone()))];
            }
            self.recorder.follow(one.index, track);
        }
    }

    /// A board that knows no timers makes a step of a motor.
    pub(crate) fn step_at(&mut self, connection: ConnectionIndex, from_ns: u64, width_ns: u64) {
        self.recorder.step(connection, from_ns, width_ns);
    }
}
