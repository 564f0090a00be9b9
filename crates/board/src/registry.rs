// Generated from boards/ and targets/ by tests/registry.rs; do not edit.
//! The data that is part of the binary.

use crate::catalog::Entry;

/// A file of `targets/`.
pub(crate) struct Target {
    pub(crate) target: &'static str,
    pub(crate) family: &'static str,
    pub(crate) parts: &'static [&'static str],
    pub(crate) text: &'static str,
}

#[rustfmt::skip]
pub(crate) const BOARDS: &[Entry] = &[
    Entry::new(
        ("STM32F4DiscoveryBoard", &[]),
        "STM32F407VGT6",
        "STM32F4 Discovery, the 26 pins of the paper's Table 1",
        (
            include_str!("../../../boards/STM32F4DiscoveryBoard/board.toml"),
            include_str!("../../../boards/STM32F4DiscoveryBoard/pins.csv"),
        ),
    ),
    Entry::new(
        ("STM32F407G-DISC1", &["STM32F4-DISCOVERY", "STM32F407-DISCOVERY", "STM32F407VG-DISCOVERY", "F4-DISCOVERY"]),
        "STM32F407VGT6",
        "STM32F4 Discovery, all pins and on-board parts",
        (
            include_str!("../../../boards/STM32F407G-DISC1/board.toml"),
            include_str!("../../../boards/STM32F407G-DISC1/pins.csv"),
        ),
    ),
];

#[rustfmt::skip]
pub(crate) const TARGETS: &[Target] = &[
    Target {
        target: "chibios-21.11",
        family: "STM32F1",
        parts: &["STM32F100?4", "STM32F100?6", "STM32F100?8", "STM32F100?B", "STM32F101?4", "STM32F101?6", "STM32F102?4", "STM32F102?6", "STM32F103?4", "STM32F103?6", "STM32F101?8", "STM32F101?B", "STM32F102?8", "STM32F102?B", "STM32F103?8", "STM32F103?B", "STM32F101?C", "STM32F101?D", "STM32F101?E", "STM32F103?C", "STM32F103?D", "STM32F103?E", "STM32F101?F", "STM32F101?G", "STM32F103?F", "STM32F103?G", "STM32F105", "STM32F107"],
        text: include_str!("../../../targets/chibios-21.11/stm32f1.toml"),
    },
    Target {
        target: "chibios-21.11",
        family: "STM32F3",
        parts: &["STM32F301?6", "STM32F301?8", "STM32F302?6", "STM32F302?8", "STM32F302?B", "STM32F302?C", "STM32F302?D", "STM32F302?E", "STM32F303?6", "STM32F303?8", "STM32F303?B", "STM32F303?C", "STM32F303?D", "STM32F303?E", "STM32F398", "STM32F334"],
        text: include_str!("../../../targets/chibios-21.11/stm32f3.toml"),
    },
    Target {
        target: "chibios-21.11",
        family: "STM32F4",
        parts: &["STM32F401", "STM32F405", "STM32F407", "STM32F415", "STM32F417", "STM32F410", "STM32F411", "STM32F412", "STM32F413", "STM32F427", "STM32F429", "STM32F437", "STM32F439", "STM32F446", "STM32F469", "STM32F479"],
        text: include_str!("../../../targets/chibios-21.11/stm32f4.toml"),
    },
];
