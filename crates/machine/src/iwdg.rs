//! The independent watchdog, clocked by the slow oscillator inside.

use super::wires::{NEVER, periods_ns};

/// Its registers, and the time of its next reset.
#[derive(Debug)]
pub(super) struct Iwdg {
    hz: u64,
    is_open: bool,
    prescaler: u32,
    reload: u32,
    bites_at: u64,
}

impl Iwdg {
    pub(super) fn new(hz: u64) -> Self {
        Self { hz, is_open: false, prescaler: 0, reload: 0xFFF, bites_at: NEVER }
    }

    pub(super) fn deadline(&self) -> u64 {
        self.bites_at
    }

    /// The time from a reload to the reset.
    pub(super) fn period_ns(&self) -> u64 {
        let divider = 4 << self.prescaler.min(6);
        periods_ns(u64::from(self.reload + 1) * divider, self.hz)
    }

    fn feed(&mut self, now: u64) {
        self.bites_at = now + self.period_ns();
    }

    pub(super) fn read(&self, offset: u32) -> u32 {
        match offset {
            0x04 => self.prescaler,
            0x08 => self.reload,
            _ => 0,
        }
    }

    pub(super) fn write(&mut self, offset: u32, value: u32, now: u64) {
        match (offset, value) {
            (0x00, 0x5555) => self.is_open = true,
            (0x00, 0xAAAA) => {
                self.is_open = false;
                if self.bites_at != NEVER {
                    self.feed(now);
                }
            }
            (0x00, 0xCCCC) => self.feed(now),
            (0x00, _) => self.is_open = false,
            (0x04, _) if self.is_open => self.prescaler = value & 7,
            (0x08, _) if self.is_open => self.reload = value & 0xFFF,
            _ => {}
        }
    }
}
