//! The modules for `esp-hal`: ESP32-C3 and C6.

pub mod converter;
pub mod edges;
pub mod gpio;
pub mod i2c;
pub mod levels;
#[cfg(feature = "pcnt")]
pub mod pcnt;
pub mod ports;
pub mod pwm;
pub mod spi;
pub mod uart;
pub mod watchdog;

pub use watchdog::restart;

use esp_hal::peripherals::{FROM_CPU_INTR0, Peripherals, TIMG0};
use esp_hal::timer::timg::TimerGroup;

/// A driver, which a task of any priority may have. The HAL keeps its drivers on the core that has their interrupts.
pub struct OneCore<T>(T);

// SAFETY: these chips have one core, and what runs in its interrupts is separated from the rest by the executors.
unsafe impl<T> Send for OneCore<T> {}

/// The clocks, and the timer that wakes tasks. It is that of the first timer group, which no device has.
#[must_use]
pub fn begin(config: esp_hal::Config) -> Peripherals {
    let all = esp_hal::init(config);
    // SAFETY: nothing else of the program takes these two.
    let (timers, interrupt) = unsafe { (TIMG0::steal(), FROM_CPU_INTR0::steal()) };
    esp_rtos::start(TimerGroup::new(timers).timer0, interrupt);
    all
}
