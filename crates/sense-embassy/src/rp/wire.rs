//! Pins that are pulled low or released.

use embassy_rp::Peri;
use embassy_rp::gpio::{Level, OutputOpenDrain, Pin};

use crate::onewire::Wire;

/// A wire's pin.
pub type OneWirePin = OutputOpenDrain<'static>;

/// A pin with the resistor of the MCU, which keeps a loose wire high.
pub fn pin(pin: Peri<'static, impl Pin>) -> OneWirePin {
    let mut pin = OutputOpenDrain::new(pin, Level::High);
    pin.set_pullup(true);
    pin
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
