//! A robot on two wheels that falls over unless it is balanced: a rod on a base that drives.

use libm::{cos, sin};

/// Metres a second squared.
const GRAVITY: f64 = 9.81;
/// The length of a step of integration, in seconds.
const STEP_S: f64 = 1e-4;

/// What is known of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BalancerFacts {
    /// From the axle to the centre of mass, in metres.
    pub height_m: f64,
    /// The lean at which it lies on the floor, in radians.
    pub fallen: f64,
}

/// How it stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Balancer {
    facts: BalancerFacts,
    lean: f64,
    rate: f64,
    base_speed: f64,
    has_fallen: bool,
}

impl Balancer {
    /// It leans forwards by that many radians, and is at rest.
    #[must_use]
    pub const fn new(facts: BalancerFacts, lean: f64) -> Self {
        Self { facts, lean, rate: 0.0, base_speed: 0.0, has_fallen: false }
    }

    /// Its base comes to a speed in metres a second, evenly within `dt_s` seconds.
    pub fn step(&mut self, dt_s: f64, base_speed: f64) {
        if dt_s <= 0.0 {
            return;
        }
        let push = (base_speed - self.base_speed) / dt_s;
        self.base_speed = base_speed;
        let mut left_s = dt_s;
        while left_s > 0.0 && !self.has_fallen {
            let h = left_s.min(STEP_S);
            // Semi-implicit Euler keeps the energy of a rod that swings.
            let pull = GRAVITY * sin(self.lean) - push * cos(self.lean);
            self.rate += h * pull / self.facts.height_m;
            self.lean += h * self.rate;
            left_s -= h;
            if self.lean.abs() >= self.facts.fallen {
                self.has_fallen = true;
                self.lean = self.facts.fallen * self.lean.signum();
                self.rate = 0.0;
            }
        }
    }

    /// Radians, forwards positive.
    #[must_use]
    pub const fn lean(&self) -> f64 {
        self.lean
    }

    /// Radians a second.
    #[must_use]
    pub const fn rate(&self) -> f64 {
        self.rate
    }

    /// Whether it lies on the floor. It does not get up.
    #[must_use]
    pub const fn has_fallen(&self) -> bool {
        self.has_fallen
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FACTS: BalancerFacts = BalancerFacts { height_m: 0.1, fallen: 0.8 };

    /// Near its top the lean grows by cosh of time over the square root of height over gravity.
    #[test]
    fn it_falls_as_a_rod_does() {
        let mut rod = Balancer::new(FACTS, 1e-4);
        (0..300).for_each(|_| rod.step(1e-3, 0.0));
        let expected = 1e-4 * libm::cosh(0.3 / (0.1 / GRAVITY).sqrt());
        assert!((rod.lean() - expected).abs() < 1e-3 * expected, "{} {expected}", rod.lean());
        (0..3_000).for_each(|_| rod.step(1e-3, 0.0));
        assert!(rod.has_fallen() && rod.rate() == 0.0);
    }

    #[test]
    fn a_controller_that_is_quick_enough_holds_it_and_a_slow_one_does_not() {
        let stands = |cycle: u32| {
            let mut rod = Balancer::new(FACTS, 0.02);
            let (mut speed, mut push) = (0.0, 0.0);
            for ms in 0..20_000_u32 {
                if ms % cycle == 0 {
                    push = 60.0 * rod.lean() + 6.0 * rod.rate();
                }
                speed += push * 1e-3;
                rod.step(1e-3, speed);
            }
            !rod.has_fallen()
        };
        assert!(stands(5) && !stands(200));
    }
}
