//! Balances: a complementary filter tells the lean from the gyroscope and the accelerometer, and the speed of the wheels
//! follows lean and rate. Its own speed leans it back, so that it comes to rest.

use crate::controls::balance::{In, Out};

const DEGREES: f32 = 57.29578;

/// What it remembers from step to step.
pub struct Balance {
    lean: f32,
    speed: f32,
    is_begun: bool,
}

impl Balance {
    /// Before the first step.
    pub const fn new() -> Self {
        Self { lean: 0.0, speed: 0.0, is_begun: false }
    }

    /// Every 5 ms.
    pub fn step(&mut self, input: &In, output: &mut Out, dt_us: u32) {
        if !input.imu_acceleration.is_valid || !input.imu_rate.is_valid {
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
        self.lean = 0.999 * (self.lean + rate * dt) + 0.001 * from_gravity;

        // The push that holds it, summed to a speed.
        let push = 60.0 * self.lean + 7.0 * rate + 1.2 * self.speed;
        self.speed = (self.speed + push * dt).clamp(-1.2, 1.2);
        let share = (self.speed / 1.26 * 100.0).clamp(-100.0, 100.0);
        output.set_left(share);
        output.set_right(share);
        output.lean = Some(self.lean * DEGREES);
    }
}
