//! Something that is heated and cools down to the room: an oven, a bed, a room itself.

use libm::exp;

/// What is known of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeaterFacts {
    /// Watts at full drive.
    pub watts: f64,
    /// Kelvin that it is warmer than the room for each watt, in the end.
    pub kelvin_per_watt: f64,
    /// Seconds after which it has 63 % of a new temperature.
    pub settling_s: f64,
    /// The temperature of the room in degrees Celsius.
    pub room_celsius: f64,
}

/// What is heated, and its temperature.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Heater {
    facts: HeaterFacts,
    rise_kelvin: f64,
}

impl Heater {
    /// It begins at a temperature in degrees Celsius.
    #[must_use]
    pub fn new(facts: HeaterFacts, celsius: f64) -> Self {
        Self { facts, rise_kelvin: celsius - facts.room_celsius }
    }

    /// Heats for `dt_s` seconds with a share of full drive, 0 to 1.
    pub fn step(&mut self, dt_s: f64, share: f64) {
        let goal = share.clamp(0.0, 1.0) * self.facts.watts * self.facts.kelvin_per_watt;
        let settling_s = self.facts.settling_s;
        let left = if settling_s > 0.0 { exp(-dt_s / settling_s) } else { 0.0 };
        self.rise_kelvin = goal + (self.rise_kelvin - goal) * left;
    }

    /// Degrees Celsius.
    #[must_use]
    pub fn celsius(&self) -> f64 {
        self.facts.room_celsius + self.rise_kelvin
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_nears_its_end_by_the_first_order() {
        let facts = HeaterFacts {
            watts: 50.0,
            kelvin_per_watt: 2.0,
            settling_s: 100.0,
            room_celsius: 20.0,
        };
        let mut heater = Heater::new(facts, 20.0);
        (0..1_000).for_each(|_| heater.step(0.1, 0.5));
        assert!((heater.celsius() - (20.0 + 50.0 * (1.0 - exp(-1.0)))).abs() < 1e-9);
        (0..20).for_each(|_| heater.step(100.0, 0.0));
        assert!((heater.celsius() - 20.0).abs() < 1e-6);
    }
}
