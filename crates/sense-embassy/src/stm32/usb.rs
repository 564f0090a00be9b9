//! The USB device that can be a host as well.

use embassy_stm32::usb::Config;

/// How it is set: it senses the bus voltage if `has_vbus`, otherwise the bus always powers it.
#[must_use]
pub fn config(has_vbus: bool) -> Config {
    let mut config = Config::default();
    config.vbus_detection = has_vbus;
    config
}
