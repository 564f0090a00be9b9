//! Inputs whose edges interrupt: the HAL has the interrupt of all pins, and wakes a task for each.

use embassy_rp::gpio::Input;
use embassy_rp::pac::SIO;

use crate::contact::{Level, Watched};
pub use crate::contact::{Trigger, watch};

/// A pin by its number, which the task that waits for its edges owns.
pub struct Pad(pub u8);

/// A contact that the reporter samples.
pub type SampledInput = Watched<Input<'static>>;

/// A contact whose edges a task waits for.
pub type InterruptInput = Watched<Pad>;

impl Level for Pad {
    fn level(&self) -> bool {
        SIO.gpio_in(usize::from(self.0 / 32)).read() >> (self.0 % 32) & 1 != 0
    }
}
