//! The watchdog, and what the chip tells of the last reset.

use embassy_nrf::Peri;
use embassy_nrf::pac;
use embassy_nrf::peripherals::WDT;
use embassy_nrf::wdt::{Config, WatchdogHandle};

/// Ticks of the watchdog in a second.
const TICK_HZ: u64 = 32_768;

/// The watchdog with the time that it gives.
pub struct Watchdog {
    unit: Option<Peri<'static, WDT>>,
    time_us: u32,
    handle: Option<WatchdogHandle>,
}

impl Watchdog {
    /// Not running yet. It starts the board over when it is not fed for `time_us`.
    #[must_use]
    pub fn new(unit: Peri<'static, WDT>, time_us: u32) -> Self {
        Self { unit: Some(unit), time_us, handle: None }
    }

    /// From now on it must be petted. A boot loader may have started it already, with a time of its own.
    pub fn unleash(&mut self) {
        let Some(unit) = self.unit.take() else { return };
        let mut config = Config::default();
        let ticks = u64::from(self.time_us) * TICK_HZ / 1_000_000;
        config.timeout_ticks = u32::try_from(ticks).unwrap_or(u32::MAX);
        self.handle = match embassy_nrf::wdt::Watchdog::try_new(unit, config) {
            Ok((_, [handle])) => Some(handle),
            // SAFETY: nobody else has the first handle of a watchdog that runs.
            Err(_) => Some(unsafe { WatchdogHandle::steal::<WDT>(0) }),
        };
    }

    /// Gives the full time again.
    pub fn pet(&mut self) {
        if let Some(handle) = &mut self.handle {
            handle.pet();
        }
    }
}

/// Why the board started, as `Life` takes it, and forgets it: the chip adds the causes of all resets since it had
/// power.
#[must_use]
pub fn cause() -> u32 {
    let reasons = pac::POWER.resetreas().read();
    pac::POWER.resetreas().write_value(reasons);
    if reasons.dog() {
        1 << 29
    } else if reasons.sreq() || reasons.lockup() {
        1 << 28
    } else if reasons.resetpin() {
        1 << 26
    } else if reasons.off() {
        1 << 31
    } else {
        1 << 27
    }
}

/// Starts the board anew, with all its units.
pub fn restart() -> ! {
    cortex_m::peripheral::SCB::sys_reset()
}
