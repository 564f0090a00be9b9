//! `embassy-nrf`: what only the HAL of nRF52832, nRF52833 and nRF52840 needs.

mod analog;
mod buses;
mod edges;
mod gaps;
mod link;
mod project;
mod pulses;
mod serial;
mod settings;
mod timers;
mod types;

use super::contract::buses::{I2c, Serial, Spi};
use super::contract::inputs::{Analog, Capture, Edges, Encoder};
use super::contract::outputs::Pulses;
use super::contract::types::Types;
use super::contract::{CORTEX_M, Drivers, Hal, Package, drivers};
use crate::names::Names;
use settings::Settings;

/// `embassy-nrf`
pub(super) struct Nrf;

static PACKAGE: Package = Package {
    name: "nrf",
    crate_name: "embassy-nrf",
    core: &CORTEX_M,
    version: "0.11.0",
    tick_hz: "32_768",
    main_uses: include_str!("templates/main_uses.rs.txt"),
    wiring_uses: include_str!("templates/wiring_uses.rs.txt"),
    runtime_asks: &["gpiote", "unstable-pac"],
    runtime_features: &[],
    runtime_needs: &["embassy-embedded-hal = \"=0.6.0\""],
    check_needs: &[],
    loader: None,
};

impl Hal for Nrf {
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
    i2c: I2c,
    spi: Spi,
    serial: Serial,
    types: Types,
}
