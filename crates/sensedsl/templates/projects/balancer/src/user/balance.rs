//! Balances: a complementary filter tells the lean from the gyroscope and the accelerometer, and the speed of the wheels
//! follows lean and rate. Its speed, and the way that it has gone, lean it back to where it began.

use crate::controls::balance::{In, Out};

const DEGREES: f32 = 57.29578;
/// The wheels' greatest speed, metres a second: 300 rpm at 80 mm.
const FASTEST: f32 = 1.26;
/// Counts of a metre; a turn has 840.
const METRE: f32 = 840.0 / (0.08 * core::f32::consts::PI);

/// What it remembers from step to step.
pub struct Balance {
    lean: f32,
    speed: f32,
    is_begun: bool,
}

fn drive(output: &mut Out, metres_a_second: f32) {
    output.set_left(metres_a_second / FASTEST * 100.0);
    output.set_right(metres_a_second / FASTEST * 100.0);
}

impl Balance {
    /// Before the first step.
    pub const fn new() -> Self {
        Self { lean: 0.0, speed: 0.0, is_begun: false }
    }

    /// Every 5 ms.
    pub fn step(&mut self, input: &In, output: &mut Out, dt_us: u32) {
        if !input.imu_acceleration.is_valid || !input.imu_rate.is_valid {
            drive(output, 0.0);
            return;
        }
        let dt = dt_us as f32 * 1e-6;
        // Gravity along the robot, in g: for small angles the sine is the angle.
        let from_gravity = -input.get_imu_acceleration(0);
        let rate = input.get_imu_rate(1) / DEGREES;
        if !self.is_begun {
            self.lean = from_gravity;
            self.is_begun = true;
        }
        self.lean = 0.998 * (self.lean + rate * dt) + 0.002 * from_gravity;

        // The push that holds it, summed to a speed.
        let way = input.wheels.value[0] as f32 / METRE;
        let push = 60.0 * self.lean + 7.0 * rate + 3.0 * self.speed + 1.0 * way;
        self.speed = (self.speed + push * dt).clamp(-FASTEST, FASTEST);
        drive(output, self.speed);
        output.lean = Some(self.lean * DEGREES);
    }
}
