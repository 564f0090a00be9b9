//! Inputs whose edges interrupt: the HAL has the interrupt of all pins, and wakes a task for each.

use embassy_nrf::gpio::Input;
use embassy_nrf::pac;

use crate::contact::{Level, Watched};

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
            Trigger::Rising => pin.wait_for_rising_edge().await,
            Trigger::Falling => pin.wait_for_falling_edge().await,
            Trigger::Any => pin.wait_for_any_edge().await,
        }
        contact.on_interrupt();
    }
}
