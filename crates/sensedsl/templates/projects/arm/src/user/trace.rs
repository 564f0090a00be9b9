//! Goes round a square in the space of the two joints, straight from corner to corner in two seconds each.

use crate::controls::trace::{In, Out};

const CORNERS: [[f32; 2]; 4] = [[60.0, 60.0], [120.0, 60.0], [120.0, 120.0], [60.0, 120.0]];
const EACH_US: u32 = 2_000_000;

/// What it remembers from step to step.
pub struct Trace {
    since_us: u32,
    corner: usize,
}

impl Trace {
    /// Before the first step.
    pub const fn new() -> Self {
        Self { since_us: 0, corner: 0 }
    }

    /// Every 20 ms.
    pub fn step(&mut self, input: &In, output: &mut Out, dt_us: u32) {
        self.since_us += dt_us;
        if self.since_us >= EACH_US {
            self.since_us -= EACH_US;
            self.corner = (self.corner + 1) % CORNERS.len();
        }
        let share = self.since_us as f32 / EACH_US as f32;
        let (from, to) = (CORNERS[self.corner], CORNERS[(self.corner + 1) % CORNERS.len()]);
        let shoulder = from[0] + (to[0] - from[0]) * share;
        let elbow = from[1] + (to[1] - from[1]) * share;
        output.set_shoulder(shoulder);
        output.set_elbow(elbow);
        if input.joints.is_valid {
            output.behind = Some([shoulder - input.get_joints(0), elbow - input.get_joints(1)]);
        }
    }
}
