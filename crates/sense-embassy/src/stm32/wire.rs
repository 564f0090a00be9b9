//! Pins that are pulled low or released.

use embassy_stm32::Peri;
use embassy_stm32::gpio::{Level, OutputOpenDrain, Pin, Speed};

use crate::onewire::Wire;

/// A wire's pin.
pub type OneWirePin = OutputOpenDrain<'static>;

/// A pin with the resistor of the MCU, which keeps a loose wire high.
#[cfg(feature = "gpio-v2")]
pub fn pin(pin: Peri<'static, impl Pin>) -> OneWirePin {
    OutputOpenDrain::new_pull(pin, Level::High, Speed::Medium, embassy_stm32::gpio::Pull::Up)
}

/// A pin; an output of these MCUs has no resistor.
#[cfg(not(feature = "gpio-v2"))]
pub fn pin(pin: Peri<'static, impl Pin>) -> OneWirePin {
    OutputOpenDrain::new(pin, Level::High, Speed::Medium)
}

impl Wire for OneWirePin {
    fn pull(&mut self) {
        self.set_low();
    }

    fn release(&mut self) {
        self.set_high();
    }

    fn is_high(&mut self) -> bool {
        OutputOpenDrain::is_high(self)
    }
}
