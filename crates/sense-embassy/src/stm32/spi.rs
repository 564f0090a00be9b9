//! Parts on SPI: each has a chip select, a mode and a clock of its own.

use embassy_stm32::gpio::Output;
use embassy_stm32::mode::Async;
use embassy_stm32::spi::mode::Master;
use embassy_stm32::spi::{Config, MODE_0, MODE_1, MODE_2, MODE_3, Spi};
use embassy_stm32::time::hz;
use embassy_sync::blocking_mutex::raw::CriticalSectionRawMutex;
use embassy_sync::mutex::Mutex;
use embassy_time::Duration;
use sense_rt::{Outcome, Step};

use crate::bus::{Line, exchange};

/// A bus that several tasks share.
pub type SpiBus = Mutex<CriticalSectionRawMutex, Spi<'static, Async, Master>>;

/// A part that is chosen by its chip select.
pub struct SpiLine {
    /// Its bus.
    pub bus: &'static SpiBus,
    /// Its chip select, active low; none of a strip of LEDs, which has the bus for itself.
    pub select: Option<Output<'static>>,
    /// Its mode and clock.
    pub config: Config,
}

/// A mode, 0 to 3, and a clock that the unit can make.
pub fn config(mode: u8, clock_hz: u32) -> Config {
    let mut config = Config::default();
    config.mode = match mode {
        1 => MODE_1,
        2 => MODE_2,
        3 => MODE_3,
        _ => MODE_0,
    };
    config.frequency = hz(clock_hz);
    config
}

impl Line for SpiLine {
    async fn transfer(&mut self, _: u8, step: Step<'_>, timeout: Duration) -> Outcome {
        let mut bus = self.bus.lock().await;
        // The clock rests at the part's level before the part looks at it.
        if bus.set_config(&self.config).is_err() {
            return Outcome::BusError;
        }
        if let Some(select) = &mut self.select {
            select.set_low();
        }
        let outcome = exchange(&mut *bus, step, timeout).await;
        if let Some(select) = &mut self.select {
            select.set_high();
        }
        outcome
    }
}
