//! Parts on SPI: each has a chip select, a mode and a clock of its own.

use embassy_sync::blocking_mutex::raw::CriticalSectionRawMutex;
use embassy_sync::mutex::Mutex;
use embassy_time::Duration;
use esp_hal::Async;
use esp_hal::gpio::interconnect::{PeripheralInput, PeripheralOutput};
use esp_hal::spi::Mode;
use esp_hal::spi::master::{Config, Instance, Spi};
use esp_hal::time::Rate;
use sense_rt::{Outcome, Step};

use super::OneCore;
use super::gpio::Output;
use crate::bus::{Line, exchange};

/// A unit as master.
pub type Master = OneCore<Spi<'static, Async>>;

/// A bus that several tasks share.
pub type SpiBus = Mutex<CriticalSectionRawMutex, Master>;

/// A part that is chosen by its chip select.
pub struct SpiLine {
    /// Its bus.
    pub bus: &'static SpiBus,
    /// Its chip select, active low; none of a strip of LEDs, which has the bus for itself.
    pub select: Option<Output<'static>>,
    /// Its mode and clock.
    pub config: Config,
}

/// A bus, whose clock each part sets.
pub fn bus(
    unit: impl Instance + 'static,
    sck: impl PeripheralOutput<'static>,
    mosi: impl PeripheralOutput<'static>,
    miso: impl PeripheralInput<'static>,
) -> Master {
    match Spi::new(unit, Config::default()) {
        Ok(bus) => OneCore(bus.with_sck(sck).with_mosi(mosi).with_miso(miso).into_async()),
        Err(_) => crate::restart(),
    }
}

/// A mode, 0 to 3, and a clock.
#[must_use]
pub fn config(mode: u8, clock_hz: u32) -> Config {
    let mode = match mode {
        0 => Mode::_0,
        1 => Mode::_1,
        2 => Mode::_2,
        _ => Mode::_3,
    };
    Config::default().with_mode(mode).with_frequency(Rate::from_hz(clock_hz))
}

impl Line for SpiLine {
    async fn transfer(&mut self, _: u8, step: Step<'_>, timeout: Duration) -> Outcome {
        let mut bus = self.bus.lock().await;
        let bus = &mut bus.0;
        // The clock rests at the part's level before the part looks at it.
        if bus.apply_config(&self.config).is_err() {
            return Outcome::BusError;
        }
        if let Some(select) = &mut self.select {
            select.set_low();
        }
        let outcome = exchange(bus, step, timeout).await;
        if let Some(select) = &mut self.select {
            select.set_high();
        }
        outcome
    }
}
