//! A wire with a contact behind it: its level once that has lasted, edges that count, and pulses
//! that nobody saw.
//!
//! Interrupts and the look of a cycle both tell what they see. Time is a number that wraps, in any
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

/// What is wanted of a contact.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ContactConfig {
    /// A change counts when it has lasted that long; 0: at once.
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

/// What was seen of a contact.
#[derive(Clone, Copy, Debug, Default)]
pub struct Contact {
    since: u32,
    edges: u32,
    has_level: bool,
    seen: bool,
    level: bool,
}

impl Contact {
    /// At the start.
    pub const NEW: Self = Self { since: 0, edges: 0, has_level: false, seen: false, level: false };

    /// Edges that counted; wraps.
    #[must_use]
    pub const fn edges(&self) -> u32 {
        self.edges
    }

    /// The level that has lasted.
    #[must_use]
    pub const fn level(&self) -> bool {
        self.level
    }

    /// What was seen before has lasted until now.
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

    /// An interrupt came and this level was found. Without `lasting` only edges that count may
    /// interrupt, with it both.
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
        // The level may be back already; it has changed all the same.
        self.seen = level;
        self.since = now;
    }

    /// The wire was looked at: often enough that what is to last is seen to last.
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

    /// The same where nothing interrupts: a level that is another one now has not lasted until now.
    pub fn sample(&mut self, config: &ContactConfig, level: bool, now: u32) {
        if self.has_level && config.lasting > 0 && level != self.seen {
            self.seen = level;
            self.since = now;
        } else {
            self.look(config, level, now);
        }
    }
}

/// What was told of a contact.
#[derive(Clone, Copy, Debug, Default)]
pub struct ContactTold {
    edges: u32,
    level: bool,
    has_told: bool,
}

impl ContactTold {
    /// At the start.
    pub const NEW: Self = Self { edges: 0, level: false, has_told: false };

    /// The level to tell, if there is one: another than before; or that of a pulse which came and
    /// went since the last look, and then the level that is comes with the next.
    pub fn tell(&mut self, config: &ContactConfig, contact: &Contact) -> Option<bool> {
        let has_edge = contact.edges != self.edges;
        self.edges = contact.edges;
        if !self.has_told || contact.level != self.level {
            self.has_told = true;
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
        // The wire has a spike around 20, and is another level from 43 on.
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
