//! Inputs whose edges interrupt: the HAL has the interrupt of all pins, and wakes a task for each.

use esp_hal::peripherals::GPIO;

use super::gpio::Input;
use crate::contact::{Level, Watched};

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

/// The edges that count.
#[derive(Clone, Copy)]
pub enum Trigger {
    /// From low to high.
    Rising,
    /// From high to low.
    Falling,
    /// Both of them.
    Any,
}

/// Waits for edges, for ever. Edges between one and the look at it are one with it.
pub async fn watch(
    mut pin: Input<'static>,
    trigger: Trigger,
    contact: &'static InterruptInput,
) -> ! {
    loop {
        match trigger {
            Trigger::Rising => pin.0.wait_for_rising_edge().await,
            Trigger::Falling => pin.0.wait_for_falling_edge().await,
            Trigger::Any => pin.0.wait_for_any_edge().await,
        }
        contact.on_interrupt();
    }
}
