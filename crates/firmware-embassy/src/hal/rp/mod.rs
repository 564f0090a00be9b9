//! `embassy-rp`: what only the HAL of RP2040 and RP2350 needs.

mod analog;
mod buses;
mod capture;
mod edges;
mod gaps;
mod link;
mod machines;
mod project;
mod pulses;
mod serial;
mod settings;
mod types;

use super::contract::buses::{I2c, OneWire, Serial, Spi};
use super::contract::inputs::{Analog, Capture, Edges, Encoder};
use super::contract::outputs::Pulses;
use super::contract::types::Types;
use super::contract::{CORTEX_M, Drivers, Hal, Loader, Package, drivers};
use crate::names::Names;
use settings::Settings;

/// `embassy-rp`
pub(super) struct Rp;

static PACKAGE: Package = Package {
    name: "rp",
    crate_name: "embassy-rp",
    core: &CORTEX_M,
    version: "0.10.0",
    tick_hz: "1_000_000",
    main_uses: include_str!("templates/main_uses.rs.txt"),
    wiring_uses: include_str!("templates/wiring_uses.rs.txt"),
    runtime_asks: &["unstable-pac"],
    runtime_features: &["pio2"],
    runtime_needs: &["fixed = \"=1.31.0\""],
    check_needs: &[],
    loader: Some(Loader {
        how: "hold BOOTSEL while the board is plugged in",
        command: "picotool load -u -v -x -t elf",
    }),
};

impl Hal for Rp {
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
    onewire: OneWire,
    serial: Serial,
    types: Types,
}
