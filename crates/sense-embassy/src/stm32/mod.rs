//! The modules for `embassy-stm32`.

#[cfg(any(feature = "can-banks", feature = "can-fd"))]
pub mod can;
#[cfg(feature = "adc-v2")]
pub mod converter;
pub mod edges;
#[cfg(any(feature = "i2c-v1", feature = "i2c-v2"))]
pub mod i2c;
pub mod pwm;
pub mod spi;
pub mod stepper;
pub mod timer;
#[cfg(any(feature = "usart-v1", feature = "usart-v3"))]
pub mod usart;
#[cfg(feature = "otg")]
pub mod usb;
pub mod wire;

use embassy_stm32::gpio::{Input, Output};

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

/// Restarts the board.
pub fn restart() -> ! {
    cortex_m::peripheral::SCB::sys_reset()
}
