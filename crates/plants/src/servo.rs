//! A model servo: it turns to where its pulses say, as fast as it can, between its end stops.

/// What is known of a servo.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ServoFacts {
    /// The greatest speed in radians a second.
    pub rate: f64,
    /// The end stops in radians, the lesser one first.
    pub stops: (f64, f64),
}

/// A servo that holds an angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Servo {
    facts: ServoFacts,
    angle: f64,
}

impl Servo {
    /// A servo at an angle in radians.
    #[must_use]
    pub const fn new(facts: ServoFacts, angle: f64) -> Self {
        Self { facts, angle }
    }

    /// Turns for `dt_s` seconds towards an angle in radians; without pulses it stays.
    pub fn step(&mut self, dt_s: f64, goal: Option<f64>) {
        let Some(goal) = goal else { return };
        let (least, greatest) = self.facts.stops;
        let goal = goal.max(least).min(greatest);
        let reach = self.facts.rate * dt_s;
        self.angle += (goal - self.angle).max(-reach).min(reach);
    }

    /// Radians.
    #[must_use]
    pub const fn angle(&self) -> f64 {
        self.angle
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_no_faster_than_it_can_and_stops_at_its_ends() {
        let mut servo = Servo::new(ServoFacts { rate: 6.0, stops: (-1.5, 1.5) }, 0.0);
        servo.step(0.1, Some(2.0));
        assert!((servo.angle() - 0.6).abs() < 1e-12);
        (0..10).for_each(|_| servo.step(0.1, Some(2.0)));
        assert_eq!(servo.angle(), 1.5);
        servo.step(0.1, None);
        assert_eq!(servo.angle(), 1.5);
    }
}
