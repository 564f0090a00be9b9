//! `embassy-stm32`: what only the HAL of ST's MCUs needs.

mod analog;
mod buses;
mod can;
mod capture;
mod clock;
mod dac;
mod edges;
mod link;
mod motors;
mod moved;
mod project;
mod pulses;
mod serial;
mod settings;
mod types;

use super::contract::buses::{Can, I2c, OneWire, Serial, Spi};
use super::contract::inputs::{Analog, Capture, Edges, Encoder};
use super::contract::motors::Motors;
use super::contract::outputs::{Dac, Pulses};
use super::contract::types::Types;
use super::contract::{CORTEX_M, Drivers, Hal, Package, drivers};
use crate::names::Names;
use settings::Settings;

/// `embassy-stm32`
pub(super) struct Stm32;

static PACKAGE: Package = Package {
    name: "stm32",
    crate_name: "embassy-stm32",
    core: &CORTEX_M,
    version: "0.6.0",
    tick_hz: "1_000_000",
    main_uses: include_str!("templates/main_uses.rs.txt"),
    wiring_uses: include_str!("templates/wiring_uses.rs.txt"),
    runtime_asks: &["exti", "unstable-pac"],
    runtime_features: &[
        "adc-v2",
        "can-banks",
        "can-fd",
        "gpio-v2",
        "i2c-v1",
        "i2c-v2",
        "otg",
        "usart-v1",
        "usart-v3",
    ],
    runtime_needs: &["embedded-can = \"=0.4.1\""],
    check_needs: &[
        "embassy-time = \"=0.5.1\"",
        "embassy-time-driver = { version = \"=0.2.2\", features = [\"tick-hz-1_000_000\"] }",
        "embassy-time-queue-utils = \"=0.3.2\"",
    ],
    loader: None,
};

impl Hal for Stm32 {
    fn package(&self) -> &'static Package {
        &PACKAGE
    }

    fn drivers(&self, names: &Names) -> Result<Box<dyn Drivers>, String> {
        Ok(Box::new(Settings::of(names)?))
    }
}

drivers! {
    Settings;
    edges: Edges,
    analog: Analog,
    capture: Capture,
    encoder: Encoder,
    pulses: Pulses,
    motors: Motors,
    dac: Dac,
    i2c: I2c,
    spi: Spi,
    onewire: OneWire,
    serial: Serial,
    can: Can,
    types: Types,
}
