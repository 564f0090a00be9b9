//! Inputs whose edges interrupt, each on a line of its own.

use embassy_stm32::exti::ExtiInput;
use embassy_stm32::mode::Blocking;

use super::contact::{Kept, Level};

/// An input whose edges interrupt.
pub type Awaited = Kept<ExtiInput<'static, Blocking>>;

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
