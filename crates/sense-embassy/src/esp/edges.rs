//! Inputs whose edges interrupt: the HAL has the interrupt of all pins, and wakes a task for each.

use esp_hal::peripherals::GPIO;

use super::gpio::Input;
pub use crate::contact::Trigger;
use crate::contact::{self, Level, Watched};

/// A pin by its number, which the task that waits for its edges owns.
pub struct Pad(pub u8);

/// A contact that the reporter samples.
pub type SampledInput = Watched<Input<'static>>;

/// A contact whose edges a task waits for.
pub type InterruptInput = Watched<Pad>;

impl Level for Pad {
    fn level(&self) -> bool {
        GPIO::regs().in_().read().bits() >> self.0 & 1 != 0
    }
}

/// Waits for edges, for ever.
pub async fn watch(pin: Input<'static>, trigger: Trigger, contact: &'static InterruptInput) -> ! {
    contact::watch(pin.0, trigger, contact).await
}
