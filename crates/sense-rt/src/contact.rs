//! A wire with a contact: its debounced level, the edges that count, and pulses between two looks.
//!
//! Both interrupts and cyclic polling report what they see. Time is a number that wraps, in any
//! unit, and levels are those of the wire.

/// The edges that count.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Edge {
    /// From low to high.
    Rising,
    /// From high to low.
    Falling,
    /// Either.
    Both,
}

/// The configuration of a contact.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ContactConfig {
    /// How long a change must last to count; 0: it counts at once.
    pub lasting: u32,
    /// The edges that count.
    pub edge: Edge,
}

impl ContactConfig {
    fn counts(&self, level: bool) -> bool {
        match self.edge {
            Edge::Both => true,
            Edge::Rising => level,
            Edge::Falling => !level,
        }
    }
}

/// The state of a contact.
#[derive(Clone, Copy, Debug, Default)]
pub struct Contact {
    since: u32,
    edges: u32,
    has_level: bool,
    seen: bool,
    level: bool,
}

impl Contact {
    /// The state at the start.
    pub const NEW: Self = Self { since: 0, edges: 0, has_level: false, seen: false, level: false };

    /// The edges that counted; wraps.
    #[must_use]
    pub const fn edges(&self) -> u32 {
        self.edges
    }

    /// The level after debouncing.
    #[must_use]
    pub const fn level(&self) -> bool {
        self.level
    }

    /// The level seen before has lasted until now.
    fn settle(&mut self, config: &ContactConfig, now: u32) {
        if self.seen != self.level && now.wrapping_sub(self.since) >= config.lasting {
            self.level = self.seen;
            if config.counts(self.level) {
                self.edges = self.edges.wrapping_add(1);
            }
        }
    }

    fn begin(&mut self, level: bool, now: u32) {
        *self = Self { since: now, edges: self.edges, has_level: true, seen: level, level };
    }

    /// An interrupt came and found this level. Without `lasting`, only edges that count may
    /// interrupt; with it, both edges must.
    pub fn on_edge(&mut self, config: &ContactConfig, level: bool, now: u32) {
        if config.lasting == 0 {
            self.begin(level, now);
            self.edges = self.edges.wrapping_add(1);
            return;
        }
        if !self.has_level {
            self.begin(level, now);
        }
        self.settle(config, now);
        // The level may have changed back already; it has changed all the same.
        self.seen = level;
        self.since = now;
    }

    /// The wire was polled; this must happen often enough to see a level last.
    pub fn look(&mut self, config: &ContactConfig, level: bool, now: u32) {
        if !self.has_level || config.lasting == 0 {
            self.begin(level, now);
            return;
        }
        self.settle(config, now);
        if level != self.seen {
            self.seen = level;
            self.since = now;
        }
    }

    /// The wire was polled, and there are no interrupts: a level that differs from the last one has
    /// not lasted until now.
    pub fn sample(&mut self, config: &ContactConfig, level: bool, now: u32) {
        if self.has_level && config.lasting > 0 && level != self.seen {
            self.seen = level;
            self.since = now;
        } else {
            self.look(config, level, now);
        }
    }
}

/// The last report of a contact.
#[derive(Clone, Copy, Debug, Default)]
pub struct ContactReport {
    edges: u32,
    level: bool,
    has_reported: bool,
}

impl ContactReport {
    /// The state at the start.
    pub const NEW: Self = Self { edges: 0, level: false, has_reported: false };

    /// The level to report, if any: one that differs from the last, or that of a pulse that came
    /// and went since the last call; the present level is then reported by the next call.
    pub fn record(&mut self, config: &ContactConfig, contact: &Contact) -> Option<bool> {
        let has_edge = contact.edges != self.edges;
        self.edges = contact.edges;
        if !self.has_reported || contact.level != self.level {
            self.has_reported = true;
            self.level = contact.level;
            return Some(self.level);
        }
        if has_edge && config.counts(!self.level) {
            self.level = !self.level;
            return Some(self.level);
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CONFIG: ContactConfig = ContactConfig { lasting: 5, edge: Edge::Both };

    #[test]
    fn a_spike_that_a_sample_meets_does_not_count() {
        let mut contact = Contact::NEW;
        // The wire has a spike around 20, and its level changes at 43.
        for (now, level, settled) in [
            (0, false, false),
            (10, false, false),
            (20, true, false),
            (30, false, false),
            (40, false, false),
            (50, true, false),
            (60, true, true),
        ] {
            contact.sample(&CONFIG, level, now);
            assert_eq!(contact.level(), settled, "{now}");
        }
        assert_eq!(contact.edges(), 1);
    }
}
