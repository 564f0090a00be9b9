//! The modules for `embassy-rp`: RP2040 and RP2350.

pub mod converter;
pub mod edges;
pub mod gate;
pub mod i2c;
pub mod pio;
pub mod pwm;
pub mod spi;
pub mod uart;
pub mod watchdog;
pub mod wire;

pub use watchdog::restart;

use embassy_rp::gpio::{Input, Output};

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
