//! Inputs whose edges interrupt: the HAL has the interrupt of all pins, and wakes a task for each.

use embassy_rp::gpio::Input;
use embassy_rp::pac::SIO;

use super::contact::{Kept, Level};

/// A pin by its number, which the task that waits for its edges owns.
pub struct Pad(pub u8);

/// An input whose edges are waited for.
pub type Awaited = Kept<Pad>;

impl Level for Pad {
    fn level(&self) -> bool {
        SIO.gpio_in(usize::from(self.0 / 32)).read() >> (self.0 % 32) & 1 != 0
    }
}

/// The edges that count.
#[derive(Clone, Copy)]
pub enum Trigger {
    Rising,
    Falling,
    Any,
}

/// Waits for edges, for ever. Edges between one and the look at it are one with it.
pub async fn watch(mut pin: Input<'static>, trigger: Trigger, kept: &'static Awaited) -> ! {
    loop {
        match trigger {
            Trigger::Rising => pin.wait_for_rising_edge().await,
            Trigger::Falling => pin.wait_for_falling_edge().await,
            Trigger::Any => pin.wait_for_any_edge().await,
        }
        kept.on_interrupt();
    }
}
