//! Parts on SPI: each has a chip select, a mode and a clock of its own.

use embassy_rp::gpio::Output;
use embassy_rp::spi::{Async, Config, Instance, Phase, Polarity, Spi};
use embassy_sync::blocking_mutex::raw::CriticalSectionRawMutex;
use embassy_sync::mutex::Mutex;
use embassy_time::Duration;
use sense_rt::{Outcome, Step};

use crate::bus::{Line, exchange};

/// A bus that several tasks share.
pub type SpiBus<T> = Mutex<CriticalSectionRawMutex, Spi<'static, T, Async>>;

/// A part that is chosen by its chip select.
pub struct SpiLine<T: Instance + 'static> {
    /// Its bus.
    pub bus: &'static SpiBus<T>,
    /// Its chip select, active low; none of a strip of LEDs, which has the bus for itself.
    pub select: Option<Output<'static>>,
    /// Its mode and clock.
    pub config: Config,
}

/// A mode, 0 to 3, and a clock that the unit can make.
pub fn config(mode: u8, clock_hz: u32) -> Config {
    let mut config = Config::default();
    config.polarity = if mode & 2 == 0 { Polarity::IdleLow } else { Polarity::IdleHigh };
    config.phase = if mode & 1 == 0 {
        Phase::CaptureOnFirstTransition
    } else {
        Phase::CaptureOnSecondTransition
    };
    config.frequency = clock_hz;
    config
}

impl<T: Instance> Line for SpiLine<T> {
    async fn transfer(&mut self, _: u8, step: Step<'_>, timeout: Duration) -> Outcome {
        let mut bus = self.bus.lock().await;
        // The clock rests at the part's level before the part looks at it.
        bus.set_config(&self.config);
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
