//! The modules for `embassy-nrf`: nRF52832, nRF52833 and nRF52840.

pub mod converter;
pub mod edges;
pub mod i2c;
pub mod pwm;
pub mod qdec;
pub mod spi;
pub mod timer;
pub mod uart;
pub mod vectors;
pub mod watchdog;

pub use watchdog::restart;

use embassy_nrf::gpio::{Input, Output};

use crate::capture::Pin;
use crate::contact::Level;

impl Level for Input<'static> {
    fn level(&self) -> bool {
        self.is_high()
    }
}

impl Pin for Output<'static> {
    fn set(&mut self, is_high: bool) {
        self.set_level(is_high.into());
    }
}
