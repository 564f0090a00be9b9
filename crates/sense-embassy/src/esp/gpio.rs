//! Pins as all HALs have them: the HAL's own take a configuration that is the same for all of them here.

use esp_hal::gpio::{self, InputConfig, InputPin, OutputConfig, OutputPin};
pub use esp_hal::gpio::{Level, Pull};

use crate::capture::Pin;

/// An input.
pub struct Input<'d>(pub(super) gpio::Input<'d>);

impl<'d> Input<'d> {
    /// An input with a resistor, or none.
    pub fn new(pin: impl InputPin + 'd, pull: Pull) -> Self {
        Self(gpio::Input::new(pin, InputConfig::default().with_pull(pull)))
    }

    /// Whether it is high.
    #[must_use]
    pub fn is_high(&self) -> bool {
        self.0.is_high()
    }

    /// Whether it is low.
    #[must_use]
    pub fn is_low(&self) -> bool {
        self.0.is_low()
    }
}

impl crate::contact::Level for Input<'static> {
    fn level(&self) -> bool {
        self.is_high()
    }
}

/// An output that drives both levels.
pub struct Output<'d>(gpio::Output<'d>);

impl<'d> Output<'d> {
    /// An output that begins with a level.
    pub fn new(pin: impl OutputPin + 'd, level: Level) -> Self {
        Self(gpio::Output::new(pin, level, OutputConfig::default()))
    }

    /// Makes it high.
    pub fn set_high(&mut self) {
        self.0.set_high();
    }

    /// Makes it low.
    pub fn set_low(&mut self) {
        self.0.set_low();
    }

    /// Gives it a level.
    pub fn set_level(&mut self, level: Level) {
        self.0.set_level(level);
    }
}

impl Pin for Output<'static> {
    fn set(&mut self, is_high: bool) {
        self.set_level(is_high.into());
    }
}
