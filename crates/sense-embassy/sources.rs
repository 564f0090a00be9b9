//! The sources of this crate, for a generator that copies them into a project.

/// Path and text.
macro_rules! files {
    ($($path:literal,)*) => {
        &[$(($path, include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/src/", $path))),)*]
    };
}

/// All files below `src`: path and text.
pub const SOURCES: &[(&str, &str)] = files![
    "analog.rs",
    "bus.rs",
    "capture.rs",
    "contact.rs",
    "devices.rs",
    "lib.rs",
    "link.rs",
    "link_uart.rs",
    "link_usb.rs",
    "nrf/converter.rs",
    "nrf/edges.rs",
    "nrf/i2c.rs",
    "nrf/mod.rs",
    "nrf/pwm.rs",
    "nrf/qdec.rs",
    "nrf/spi.rs",
    "nrf/timer.rs",
    "nrf/uart.rs",
    "nrf/vectors.rs",
    "nrf/watchdog.rs",
    "rp/converter.rs",
    "rp/edges.rs",
    "rp/gate.rs",
    "rp/i2c.rs",
    "rp/mod.rs",
    "rp/pio.rs",
    "rp/pwm.rs",
    "rp/spi.rs",
    "rp/uart.rs",
    "rp/watchdog.rs",
    "serial.rs",
    "status.rs",
    "stm32/can/banks.rs",
    "stm32/can/fd.rs",
    "stm32/can/mod.rs",
    "stm32/converter.rs",
    "stm32/edges.rs",
    "stm32/i2c/mod.rs",
    "stm32/i2c/v1.rs",
    "stm32/i2c/v2.rs",
    "stm32/mod.rs",
    "stm32/pwm.rs",
    "stm32/spi.rs",
    "stm32/timer.rs",
    "stm32/usart/mod.rs",
    "stm32/usart/v1.rs",
    "stm32/usart/v3.rs",
    "stm32/usb.rs",
    "time.rs",
];
