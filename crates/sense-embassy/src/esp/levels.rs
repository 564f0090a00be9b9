//! Levels of priority: the tasks of each one above the lowest run in a software interrupt.

use embassy_executor::SendSpawner;
use esp_hal::interrupt::Priority;
use esp_hal::peripherals::{FROM_CPU_INTR1, FROM_CPU_INTR2, FROM_CPU_INTR3};
use esp_rtos::embassy::InterruptExecutor;
use static_cell::StaticCell;

/// Starts the executor of a level, 1 to 3, of which the last is the most urgent. Each is started once.
#[must_use]
pub fn start(level: u8) -> SendSpawner {
    static FIRST: StaticCell<InterruptExecutor<1>> = StaticCell::new();
    static SECOND: StaticCell<InterruptExecutor<2>> = StaticCell::new();
    static THIRD: StaticCell<InterruptExecutor<3>> = StaticCell::new();
    // SAFETY: nothing else of the program takes the interrupts, and a level is started once.
    let (first, second, third) =
        unsafe { (FROM_CPU_INTR1::steal(), FROM_CPU_INTR2::steal(), FROM_CPU_INTR3::steal()) };
    match level {
        1 => FIRST.init(InterruptExecutor::new(first)).start(Priority::Priority2),
        2 => SECOND.init(InterruptExecutor::new(second)).start(Priority::Priority3),
        _ => THIRD.init(InterruptExecutor::new(third)).start(Priority::Priority4),
    }
}
