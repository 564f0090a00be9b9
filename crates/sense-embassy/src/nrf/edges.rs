//! Inputs whose edges interrupt: the HAL has the interrupt of all pins, and wakes a task for each.

use embassy_nrf::gpio::Input;
use embassy_nrf::pac;

use crate::contact::{Level, Watched};
pub use crate::contact::{Trigger, watch};

/// A pin by its port and its number there, which the task that waits for its edges owns.
pub struct Pad(pub pac::gpio::Gpio, pub u8);

/// A contact that the reporter samples.
pub type SampledInput = Watched<Input<'static>>;

/// A contact whose edges a task waits for.
pub type InterruptInput = Watched<Pad>;

impl Level for Pad {
    fn level(&self) -> bool {
        self.0.in_().read().0 >> self.1 & 1 != 0
    }
}
