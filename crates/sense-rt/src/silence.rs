//! When actuators fall back: the host has sent no valid frame for too long.

/// How long the host has been silent.
#[derive(Clone, Copy, Debug)]
pub struct Silence {
    limit_ms: u32,
    received_ms: u32,
    is_silent: bool,
}

impl Silence {
    /// `limit_ms` is 10 to 3600000, or 0: never. The start counts as a frame from the host.
    #[must_use]
    pub const fn new(limit_ms: u32, now_ms: u32) -> Self {
        Self { limit_ms, received_ms: now_ms, is_silent: false }
    }

    /// A valid frame from the host has arrived.
    pub fn received(&mut self, now_ms: u32) {
        self.received_ms = now_ms;
        self.is_silent = false;
    }

    /// Must be called in each cycle: true if the actuators must fall back now, once for each
    /// silence.
    pub fn step(&mut self, now_ms: u32) -> bool {
        let is_short = now_ms.wrapping_sub(self.received_ms) < self.limit_ms;
        // Once silent, it remains so, even when the clock wraps.
        if self.limit_ms == 0 || self.is_silent || is_short {
            return false;
        }
        self.is_silent = true;
        true
    }
}
