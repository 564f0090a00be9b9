//! `esp-hal`: what only the HAL of ESP32-C3 and C6 needs. The crate comes from Espressif, not from Embassy, whose tasks
//! it runs.

mod analog;
mod buses;
mod edges;
mod encoder;
mod gaps;
mod link;
mod project;
mod pulses;
mod serial;
mod settings;

use super::contract::buses::{I2c, Serial, Spi};
use super::contract::inputs::{Analog, Edges, Encoder};
use super::contract::outputs::Pulses;
use super::contract::{Core, Drivers, Hal, Package, drivers};
use crate::names::Names;
use settings::Settings;

/// `esp-hal`
pub(super) struct Esp;

/// RISC-V as Espressif has it.
static RISC_V: Core = Core {
    is_cortex_m: false,
    needs: &["embassy-executor = \"=0.10.0\""],
    speeds: &[
        ("embassy-executor", "3"),
        ("embassy-sync", "\"s\""),
        ("embassy-time", "3"),
        ("embassy-time-queue-utils", "3"),
        ("esp-rtos", "3"),
    ],
    main: "esp_rtos::main",
    item: Some("esp_bootloader_esp_idf::esp_app_desc!();"),
    rustflags: "\"-C\", \"link-arg=-Tlinkall.x\"",
    runner: "espflash flash --monitor --chip {chip}",
    runner_from: "Over USB: `cargo install espflash`.",
    runs: "writes it to the board over USB; needs espflash",
};

static PACKAGE: Package = Package {
    name: "esp",
    crate_name: "esp-hal",
    core: &RISC_V,
    version: "1.2.2",
    tick_hz: "1_000_000",
    main_uses: include_str!("templates/main_uses.rs.txt"),
    wiring_uses: include_str!("templates/wiring_uses.rs.txt"),
    runtime_asks: &["unstable"],
    runtime_features: &["pcnt"],
    runtime_needs: &[
        "embassy-executor = \"=0.10.0\"",
        "esp-rtos = { version = \"=0.4.0\", features = [\"embassy\"] }",
    ],
    check_needs: &[],
    loader: None,
};

impl Hal for Esp {
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
    encoder: Encoder,
    pulses: Pulses,
    i2c: I2c,
    spi: Spi,
    serial: Serial,
}
