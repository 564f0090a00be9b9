//! A PID line follower. Where the line is comes from the sensors that see it, weighted by how dark they are; where none
//! sees it, it is where it was last, at the end of the row.

use crate::controls::follow::{In, Out};

const PITCH_MM: f32 = 9.5;
const BRIGHT: f32 = 300.0;
const DARK: f32 = 3200.0;
/// Where the line is taken to be when no sensor sees it.
const LOST_MM: f32 = 40.0;
const SUM_MAX: f32 = 10.0;

/// What it remembers from step to step.
pub struct Follow {
    last_mm: f32,
    sum: f32,
}

/// Forwards, and to the right: percent of full speed, which the setters keep to.
fn drive(output: &mut Out, speed: f32, turn: f32) {
    output.set_left(speed + turn);
    output.set_right(speed - turn);
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
            // 0 on the bright floor, 1 on the line.
            let dark = ((f32::from(*value) - BRIGHT) / (DARK - BRIGHT)).max(0.0);
            weight += dark;
            moment += dark * (f32::from(at) - 3.5) * PITCH_MM;
        }
        match (weight < 0.3, self.last_mm > 0.0) {
            (true, true) => LOST_MM,
            (true, false) => -LOST_MM,
            (false, _) => moment / weight,
        }
    }

    /// Every 5 ms.
    pub fn step(&mut self, input: &In, output: &mut Out, dt_us: u32) {
        if !input.line.is_valid {
            drive(output, 0.0, 0.0);
            return;
        }
        let dt = dt_us as f32 * 1e-6;
        let now_mm = self.offset_mm(input);
        let rate = if dt > 0.0 { (now_mm - self.last_mm) / dt } else { 0.0 };
        self.last_mm = now_mm;
        self.sum = (self.sum + now_mm * dt).clamp(-SUM_MAX, SUM_MAX);
        let turn = 1.5 * now_mm + 0.8 * self.sum + 0.08 * rate;
        drive(output, f32::from(input.cruise.value), turn);
        output.offset = Some(now_mm);
    }
}
