//! A battery that empties and gives way under load.

/// What is known of a battery.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BatteryFacts {
    /// Volts when it is full and nothing draws from it.
    pub full_volts: f64,
    /// Volts when it is empty; between them they fall evenly.
    pub empty_volts: f64,
    /// What it holds, in ampere-seconds.
    pub capacity_coulombs: f64,
    /// What is inside of it and in its cables, in ohms.
    pub ohms: f64,
}

/// A battery with what is left of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Battery {
    facts: BatteryFacts,
    left: f64,
    amperes: f64,
}

impl Battery {
    /// A battery of which a share is left, 0 to 1.
    #[must_use]
    pub const fn new(facts: BatteryFacts, left: f64) -> Self {
        Self { facts, left, amperes: 0.0 }
    }

    /// Gives a current in amperes for `dt_s` seconds; a negative one charges it.
    pub fn step(&mut self, dt_s: f64, amperes: f64) {
        self.amperes = amperes;
        if self.facts.capacity_coulombs > 0.0 {
            self.left = (self.left - amperes * dt_s / self.facts.capacity_coulombs).clamp(0.0, 1.0);
        }
    }

    /// Amperes; negative while it is charged.
    #[must_use]
    pub const fn amperes(&self) -> f64 {
        self.amperes
    }

    /// Volts at its contacts.
    #[must_use]
    pub fn volts(&self) -> f64 {
        let BatteryFacts { full_volts, empty_volts, ohms, .. } = self.facts;
        (empty_volts + (full_volts - empty_volts) * self.left - self.amperes * ohms).max(0.0)
    }

    /// The share of its full voltage, for what it supplies.
    #[must_use]
    pub fn share(&self) -> f64 {
        if self.facts.full_volts > 0.0 { self.volts() / self.facts.full_volts } else { 0.0 }
    }

    /// The share that is left in it.
    #[must_use]
    pub const fn left(&self) -> f64 {
        self.left
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_empties_by_what_is_drawn_and_sags_by_its_resistance() {
        let facts = BatteryFacts {
            full_volts: 8.4,
            empty_volts: 6.4,
            capacity_coulombs: 7_200.0,
            ohms: 0.1,
        };
        let mut battery = Battery::new(facts, 1.0);
        (0..3_600).for_each(|_| battery.step(1.0, 1.0));
        assert!((battery.left() - 0.5).abs() < 1e-9);
        assert!((battery.volts() - (7.4 - 0.1)).abs() < 1e-9);
        (0..100_000).for_each(|_| battery.step(1.0, 1.0));
        assert_eq!(battery.left(), 0.0);
    }
}
