//! Contacts: their edges interrupt, each on a line of its own, or the reporter samples them.

use embassy_stm32::exti::ExtiInput;
use embassy_stm32::gpio::Input;
use embassy_stm32::mode::Blocking;

use crate::contact::{Level, Watched};

/// A contact that the reporter samples.
pub type SampledInput = Watched<Input<'static>>;

/// A contact whose edges interrupt.
pub type InterruptInput = Watched<ExtiInput<'static, Blocking>>;

impl Level for ExtiInput<'static, Blocking> {
    fn level(&self) -> bool {
        self.is_high()
    }

    fn take_edge(&mut self) -> bool {
        let is_own = self.is_pending();
        if is_own {
            self.clear_pending();
        }
        is_own
    }
}
