//! The hand-written code that goes into a project: the runtime, and what is between it and the HAL.

use std::collections::BTreeSet;
use std::fmt::Write as _;

use super::hal::Hal;

/// Path and text.
macro_rules! files {
    ($folder:literal, $($path:literal,)*) => {
        &[$(($path, include_str!(concat!(env!("CARGO_MANIFEST_DIR"), $folder, $path))),)*]
    };
}

/// Between the runtime and whatever HAL; path below `src/rt/`.
const SHARED: &[(&str, &str)] = files![
    "/runtime/",
    "analog.rs",
    "bus.rs",
    "capture.rs",
    "contact.rs",
    "life.rs",
    "link.rs",
    "link_uart.rs",
    "link_usb.rs",
    "serial.rs",
    "shared.rs",
];

/// Those between it and `embassy-stm32`.
const STM32: &[(&str, &str)] = files![
    "/runtime/stm32/",
    "again.rs",
    "can.rs",
    "can_banks.rs",
    "can_fd.rs",
    "exti.rs",
    "i2c.rs",
    "port_new.rs",
    "port_old.rs",
    "pwm.rs",
    "reset_new.rs",
    "reset_old.rs",
    "spi.rs",
    "timer.rs",
    "usart.rs",
];

/// Those between it and `embassy-rp`.
const RP: &[(&str, &str)] = files![
    "/runtime/rp/",
    "converter.rs",
    "edges.rs",
    "gate.rs",
    "i2c.rs",
    "pwm.rs",
    "spi.rs",
    "uart.rs",
    "watchdog.rs",
];

/// Those of a HAL.
pub(super) fn adapters(hal: Hal) -> impl Iterator<Item = &'static (&'static str, &'static str)> {
    let own = match hal {
        Hal::Stm32 => STM32,
        Hal::Rp => RP,
    };
    SHARED.iter().chain(own)
}

/// Those that every project on a HAL has.
pub(super) const fn always(hal: Hal) -> &'static [&'static str] {
    match hal {
        Hal::Stm32 => &["life.rs", "shared.rs"],
        Hal::Rp => &["life.rs", "shared.rs", "watchdog.rs"],
    }
}

/// How the module of the adapters begins.
const MODULE: &str = include_str!("../runtime/mod.rs");

/// The module of the adapters that a project has.
pub(super) fn module(own: &BTreeSet<&'static str>, always: &[&'static str]) -> String {
    let mut text = MODULE.to_owned();
    let names: BTreeSet<&str> =
        own.iter().chain(always).filter_map(|name| name.strip_suffix(".rs")).collect();
    let mut modules = String::new();
    for name in names {
        // The units of a chip are of one sort, and the code around them does not know which.
        let sort = ["_new", "_old"].iter().find_map(|sort| name.strip_suffix(sort));
        let sort = sort.or_else(|| name.starts_with("can_").then_some("controller"));
        if let Some(module) = sort {
            let _ = writeln!(modules, "#[path = \"{name}.rs\"]\npub mod {module};");
        } else {
            let _ = writeln!(modules, "pub mod {name};");
        }
    }
    text = text.replacen("// modules\n", &modules, 1);
    text
}

/// The runtime; path below `sense-rt/src/`.
pub(super) const RUNTIME: &[(&str, &str)] = files![
    "/../sense-rt/src/",
    "bits.rs",
    "bytes.rs",
    "capture.rs",
    "checksum.rs",
    "chip/ask.rs",
    "chip/memory.rs",
    "chip/mod.rs",
    "chip/say.rs",
    "chip/table.rs",
    "chip/time.rs",
    "coding.rs",
    "compose.rs",
    "contact.rs",
    "convert.rs",
    "count.rs",
    "decode.rs",
    "drive.rs",
    "elements.rs",
    "encode.rs",
    "filter.rs",
    "filter/real.rs",
    "filter/smooth.rs",
    "formula/bosch.rs",
    "formula/mod.rs",
    "formula/ntc.rs",
    "formula/tsl2561.rs",
    "health.rs",
    "lib.rs",
    "listener.rs",
    "message.rs",
    "message/start.rs",
    "message/table.rs",
    "outcome.rs",
    "parse.rs",
    "pulse_width.rs",
    "reporter.rs",
    "requests.rs",
    "scalar.rs",
    "schema.rs",
    "silence.rs",
    "store.rs",
    "train.rs",
    "uses.rs",
    "watch.rs",
];
