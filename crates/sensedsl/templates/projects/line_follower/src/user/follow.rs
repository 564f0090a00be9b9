//! A PID line follower. Where the line is comes from the sensors that see it, weighted by how dark they are; where none
//! sees it, it is where it was last, at the end of the row.

use crate::controls::follow::{In, Out};

const PITCH_MM: f32 = 9.5;
const BRIGHT: f32 = 300.0;
const DARK: f32 = 3200.0;

/// What it remembers from step to step.
pub struct Follow {
    last_mm: f32,
    sum: f32,
}

impl Follow {
    /// Before the first step.
    pub const fn new() -> Self {
        Self { last_mm: 0.0, sum: 0.0 }
    }

    /// Where the line is: millimetres to the right of the middle.
    fn offset_mm(&self, input: &In) -> f32 {
        let (mut weight, mut moment) = (0.0, 0.0);
        for (value, at) in input.line.value.iter().zip(0_u8..) {
            let dark = ((f32::from(*value) - BRIGHT) / (DARK - BRIGHT)).clamp(0.0, 1.0);
            weight += dark;
            moment += dark * (f32::from(at) - 3.5) * PITCH_MM;
        }
        match (weight < 0.3, self.last_mm > 0.0) {
            (true, true) => 40.0,
            (true, false) => -40.0,
            (false, _) => moment / weight,
        }
    }

    /// Every 5 ms.
    pub fn step(&mut self, input: &In, output: &mut Out, dt_us: u32) {
        if !input.line.is_valid {
            output.set_left(0.0);
            output.set_right(0.0);
            return;
        }
        let dt = dt_us as f32 * 1e-6;
        let now_mm = self.offset_mm(input);
        let rate = if dt > 0.0 { (now_mm - self.last_mm) / dt } else { 0.0 };
        self.last_mm = now_mm;
        self.sum = (self.sum + now_mm * dt).clamp(-10.0, 10.0);
        let cruise = f32::from(input.cruise.value);
        let turn = 1.5 * now_mm + 0.8 * self.sum + 0.08 * rate;
        output.set_left((cruise + turn).clamp(-100.0, 100.0));
        output.set_right((cruise - turn).clamp(-100.0, 100.0));
        output.offset = Some(now_mm);
    }
}
