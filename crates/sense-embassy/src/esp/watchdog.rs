//! The watchdog, and what the chip tells of the last reset.

use esp_hal::peripherals::RTC_TIMER;
use esp_hal::rtc_cntl::{Rtc, RwdtStage, SocResetReason, reset_reason};
use esp_hal::system::Cpu;
use esp_hal::time::Duration;

/// The watchdog with the time that it gives.
pub struct Watchdog {
    unit: Rtc<'static>,
    time_us: u32,
}

impl Watchdog {
    /// Not running yet. It starts the board over when it is not fed for `time_us`.
    #[must_use]
    pub fn new(unit: RTC_TIMER<'static>, time_us: u32) -> Self {
        Self { unit: Rtc::new(unit), time_us }
    }

    /// From now on it must be petted.
    pub fn unleash(&mut self) {
        let time = Duration::from_micros(self.time_us.into());
        self.unit.rwdt.set_timeout(RwdtStage::Stage0, time);
        self.unit.rwdt.enable();
    }

    /// Gives the full time again.
    pub fn pet(&mut self) {
        self.unit.rwdt.feed();
    }
}

/// Why the board started, as `BoardStatus` takes it.
#[must_use]
pub fn cause() -> u32 {
    use SocResetReason as Reason;
    match reset_reason(Cpu::ProCpu) {
        Some(
            Reason::CoreMwdt0
            | Reason::CoreMwdt1
            | Reason::CoreRtcWdt
            | Reason::Cpu0Mwdt0
            | Reason::Cpu0Mwdt1
            | Reason::Cpu0RtcWdt
            | Reason::SysRtcWdt
            | Reason::SysSuperWdt,
        ) => 1 << 29,
        Some(Reason::CoreSw | Reason::Cpu0Sw | Reason::CoreUsbUart | Reason::CoreUsbJtag) => {
            1 << 28
        }
        Some(Reason::CoreDeepSleep) => 1 << 31,
        _ => 1 << 27,
    }
}

/// Starts the board anew, with all its units.
pub fn restart() -> ! {
    esp_hal::system::software_reset()
}
