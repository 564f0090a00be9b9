//! Drives at full speed, slows down from 60 cm on, and stands at 20 cm. Without a distance it stands as well.

use crate::controls::stop::{In, Out};

/// A distance that is older than that is none.
const OLD_US: u32 = 200_000;

/// What it remembers from step to step: nothing.
pub struct Stop {}

impl Stop {
    /// Before the first step.
    pub const fn new() -> Self {
        Self {}
    }

    /// Every 10 ms.
    pub fn step(&mut self, input: &In, output: &mut Out, _dt_us: u32) {
        let front = &input.front;
        let mut speed = 0.0;
        if front.is_valid && front.age_us < OLD_US && !input.bumper.value {
            speed = ((input.get_front() - 20.0) * 2.0).min(80.0);
            // Less than this does not turn the motors.
            if speed < 8.0 {
                speed = 0.0;
            }
        }
        output.set_left_speed(speed);
        output.set_right_speed(speed);
    }
}
