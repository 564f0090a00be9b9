//! Parts on SPI: each has a chip select, a mode and a clock of its own.

use embassy_embedded_hal::SetConfig as _;
use embassy_nrf::gpio::Output;
use embassy_nrf::spim::{Config, Frequency, MODE_0, MODE_1, MODE_2, MODE_3, Spim};
use embassy_sync::blocking_mutex::raw::CriticalSectionRawMutex;
use embassy_sync::mutex::Mutex;
use embassy_time::Duration;
use sense_rt::{Outcome, Step};

use crate::bus::{Line, exchange};

/// A bus that several tasks share.
pub type SpiBus = Mutex<CriticalSectionRawMutex, Spim<'static>>;

/// A part that is chosen by its chip select.
pub struct SpiLine {
    /// Its bus.
    pub bus: &'static SpiBus,
    /// Its chip select, active low; none of a strip of LEDs, which has the bus for itself.
    pub select: Option<Output<'static>>,
    /// Its mode and clock.
    pub config: Config,
}

/// A mode, 0 to 3, and the fastest clock that is not above this one.
#[must_use]
pub fn config(mode: u8, clock_hz: u32) -> Config {
    let mut config = Config::default();
    config.mode = match mode {
        0 => MODE_0,
        1 => MODE_1,
        2 => MODE_2,
        _ => MODE_3,
    };
    config.frequency = match clock_hz {
        0..250_000 => Frequency::K125,
        250_000..500_000 => Frequency::K250,
        500_000..1_000_000 => Frequency::K500,
        1_000_000..2_000_000 => Frequency::M1,
        2_000_000..4_000_000 => Frequency::M2,
        4_000_000..8_000_000 => Frequency::M4,
        _ => Frequency::M8,
    };
    config
}

impl Line for SpiLine {
    async fn transfer(&mut self, _: u8, step: Step<'_>, timeout: Duration) -> Outcome {
        let mut bus = self.bus.lock().await;
        // The clock rests at the part's level before the part looks at it. There is nothing to be refused.
        let _ = bus.set_config(&self.config);
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
