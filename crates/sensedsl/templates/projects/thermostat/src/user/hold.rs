//! A PI controller with a limited sum: it does not run away while the heater is fully on.

use crate::controls::hold::{In, Out};

/// What it remembers from step to step.
pub struct Hold {
    sum: f32,
}

impl Hold {
    /// Before the first step.
    pub const fn new() -> Self {
        Self { sum: 0.0 }
    }

    /// Every 200 ms.
    pub fn step(&mut self, input: &In, output: &mut Out, dt_us: u32) {
        if !input.temperature.is_valid {
            output.set_heater(0.0);
            return;
        }
        let off = input.setpoint.value - input.get_temperature();
        let share = 25.0 * off + self.sum;
        // The sum stands still while the heater is at one of its ends.
        if share > 0.0 && share < 100.0 {
            self.sum += 0.8 * off * dt_us as f32 * 1e-6;
        }
        // Kept within 0 and 100 %, as the file says of the heater.
        output.set_heater(share);
    }
}
