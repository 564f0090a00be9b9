// Generated from boards/ and targets/ by tests/registry.rs; do not edit.
//! The data that is part of the binary.

use crate::catalog::Entry;

/// A file of `targets/`.
pub(crate) struct Target {
    pub(crate) target: &'static str,
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
        parts: &["STM32F405", "STM32F415", "STM32F407", "STM32F417"],
        text: include_str!("../../../targets/chibios-21.11/stm32f4.toml"),
    },
];
