//! A motor with brushes behind its gear, at a bridge.

use libm::exp;

/// What is known of a motor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MotorFacts {
    /// Turns a second at full drive without a load.
    pub no_load_turns: f64,
    /// Seconds after which it has 63 % of a new speed.
    pub settling_s: f64,
    /// The share of full drive below which it stands.
    pub dead_zone: f64,
    /// The share of full drive that its load takes, as friction does: against its motion.
    pub load: f64,
    /// Amperes at full drive when it is held.
    pub stall_amperes: f64,
    /// Kelvin that it is warmer than the room when it is held at full drive for long.
    pub stall_rise_kelvin: f64,
    /// Seconds after which it has 63 % of a new temperature.
    pub warming_s: f64,
    /// The temperature of the room.
    pub room_celsius: f64,
}

/// A motor that runs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motor {
    facts: MotorFacts,
    speed: f64,
    turns: f64,
    amperes: f64,
    rise_kelvin: f64,
}

impl Motor {
    /// A motor that stands, as warm as the room.
    #[must_use]
    pub const fn new(facts: MotorFacts) -> Self {
        Self { facts, speed: 0.0, turns: 0.0, amperes: 0.0, rise_kelvin: 0.0 }
    }

    /// Runs for `dt_s` seconds at a share of full drive, -1 to 1, of a supply that has a share of its full voltage.
    pub fn step(&mut self, dt_s: f64, share: f64, supply: f64) {
        let facts = self.facts;
        let driven = if share.abs() <= facts.dead_zone { 0.0 } else { share.clamp(-1.0, 1.0) };
        let driven = driven * supply;
        let goal = against(driven, facts.load) * facts.no_load_turns;
        // The exact solution of a first order, so that the length of a step does not matter.
        let left = if facts.settling_s > 0.0 { exp(-dt_s / facts.settling_s) } else { 0.0 };
        let off = self.speed - goal;
        self.turns += goal * dt_s + off * facts.settling_s * (1.0 - left);
        self.speed = goal + off * left;
        let counter =
            if facts.no_load_turns > 0.0 { self.speed / facts.no_load_turns } else { 0.0 };
        self.amperes = facts.stall_amperes * (driven - counter);
        let share =
            if facts.stall_amperes > 0.0 { self.amperes / facts.stall_amperes } else { 0.0 };
        let warm = facts.stall_rise_kelvin * share * share;
        let left = if facts.warming_s > 0.0 { exp(-dt_s / facts.warming_s) } else { 0.0 };
        self.rise_kelvin = warm + (self.rise_kelvin - warm) * left;
    }

    /// Turns a second.
    #[must_use]
    pub const fn speed(&self) -> f64 {
        self.speed
    }

    /// Turns since the start.
    #[must_use]
    pub const fn turns(&self) -> f64 {
        self.turns
    }

    /// Amperes; negative while it brakes.
    #[must_use]
    pub const fn amperes(&self) -> f64 {
        self.amperes
    }

    /// Degrees Celsius.
    #[must_use]
    pub fn celsius(&self) -> f64 {
        self.facts.room_celsius + self.rise_kelvin
    }
}

/// What is left of a drive when a load works against it.
fn against(driven: f64, load: f64) -> f64 {
    let left = (driven.abs() - load).max(0.0);
    if driven < 0.0 { -left } else { left }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FACTS: MotorFacts = MotorFacts {
        no_load_turns: 10.0,
        settling_s: 0.1,
        dead_zone: 0.05,
        load: 0.1,
        stall_amperes: 2.0,
        stall_rise_kelvin: 80.0,
        warming_s: 60.0,
        room_celsius: 20.0,
    };

    /// Speed and turns are those of the differential equation, however long the steps are.
    #[test]
    fn it_follows_the_first_order_at_every_step() {
        for steps in [1_u32, 10, 500] {
            let mut motor = Motor::new(FACTS);
            let dt = 0.25 / f64::from(steps);
            (0..steps).for_each(|_| motor.step(dt, 0.6, 1.0));
            let goal = 0.5 * 10.0;
            assert!((motor.speed() - goal * (1.0 - exp(-2.5))).abs() < 1e-9, "{steps}");
            let turns = goal * (0.25 - 0.1 * (1.0 - exp(-2.5)));
            assert!((motor.turns() - turns).abs() < 1e-9, "{steps}");
        }
    }

    #[test]
    fn it_stands_in_its_dead_zone_and_draws_most_when_held() {
        let mut motor = Motor::new(FACTS);
        motor.step(1.0, 0.04, 1.0);
        assert_eq!((motor.speed(), motor.turns(), motor.amperes()), (0.0, 0.0, 0.0));
        motor.step(1e-9, -1.0, 1.0);
        assert!((motor.amperes() + 2.0).abs() < 1e-6);
        (0..600).for_each(|_| motor.step(1.0, -1.0, 0.5));
        // Half the supply, and a load of a tenth of full drive.
        assert!((motor.speed() + 4.0).abs() < 1e-9);
        assert!((motor.celsius() - (20.0 + 80.0 * 0.01)).abs() < 1e-2, "{}", motor.celsius());
    }
}
