//! The hand-written runtime that is copied beside the generated files: what every sketch has, and what some kinds use.

use sensedsl_firmware_c::runtime::File;

/// Files of `runtime/`.
macro_rules! own {
    ($($name:literal),* $(,)?) => {
        &[$((
            $name,
            include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/runtime/", $name)),
        )),*]
    };
}

/// The files that every sketch has.
pub(crate) const FILES: &[File] =
    own!["up_life.c", "up_life.h", "up_ports.h", "up_rt.c", "up_rt.h"];

pub(crate) const ANALOG: &[File] = own!["up_analog.c", "up_analog.h"];
pub(crate) const CHIPS: &[File] = own!["up_chips.c", "up_chips.h"];
pub(crate) const CONTROL: &[File] = own!["up_control.c", "up_control.h"];
pub(crate) const DIGITAL: &[File] = own!["up_digital.c", "up_digital.h"];
pub(crate) const ENCODER: &[File] = own!["up_encoder.c", "up_encoder.h"];
pub(crate) const I2C: &[File] = own!["up_i2c.c", "up_i2c.h"];
pub(crate) const ICU: &[File] = own!["up_icu.c", "up_icu.h"];
pub(crate) const PWM: &[File] = own!["up_pwm.c", "up_pwm.h"];
pub(crate) const SPI: &[File] = own!["up_spi.cpp", "up_spi.h"];
pub(crate) const UART: &[File] = own!["up_uart.c", "up_uart.h"];
