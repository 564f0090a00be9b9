//! The watchdog, and what it and the chip tell of the last reset.

use embassy_rp::Peri;
use embassy_rp::pac;
use embassy_rp::peripherals::WATCHDOG;
use embassy_time::Duration;

/// The watchdog with the time that it gives.
pub struct Watchdog {
    watchdog: embassy_rp::watchdog::Watchdog,
    time: Duration,
}

impl Watchdog {
    /// Not running yet. It starts the board over when it is not fed for `time_us`.
    pub fn new(unit: Peri<'static, WATCHDOG>, time_us: u32) -> Self {
        Self {
            watchdog: embassy_rp::watchdog::Watchdog::new(unit),
            time: Duration::from_micros(time_us.into()),
        }
    }

    /// From now on it must be petted.
    pub fn unleash(&mut self) {
        self.watchdog.start(self.time);
    }

    /// Gives the full time again.
    pub fn pet(&mut self) {
        self.watchdog.feed(self.time);
    }
}

/// Why the board started, as `Life` takes it. `has_power`: the supply came; `has_run`: the pin that stops the chip.
/// The watchdog's own word is of the last reset alone, so it comes first.
pub fn cause(has_power: bool, has_run: bool) -> u32 {
    let reason = pac::WATCHDOG.reason().read();
    if reason.timer() {
        1 << 29
    } else if reason.force() {
        1 << 28
    } else if has_power {
        1 << 27
    } else if has_run {
        1 << 26
    } else {
        0
    }
}

/// Starts the board anew, with all its units.
pub fn restart() -> ! {
    // SAFETY: nothing else of the program runs again.
    let mut watchdog = embassy_rp::watchdog::Watchdog::new(unsafe { WATCHDOG::steal() });
    watchdog.trigger_reset();
    loop {
        cortex_m::asm::nop();
    }
}
