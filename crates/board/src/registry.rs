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

/// The files of a folder of `boards/`.
macro_rules! board {
    ($name:literal, $aliases:expr, $mcu:literal, $description:literal) => {
        Entry::new(
            ($name, $aliases),
            $mcu,
            $description,
            (
                include_str!(concat!("../../../boards/", $name, "/board.toml")),
                include_str!(concat!("../../../boards/", $name, "/pins.csv")),
            ),
        )
    };
}

#[rustfmt::skip]
pub(crate) const BOARDS: &[Entry] = &[
    board!("ARDUINO-MEGA-2560", &["ARDUINO-MEGA", "MEGA-2560"], "ATMEGA2560-16AU", "Arduino Mega 2560, the pins of its connectors"),
    board!("ARDUINO-UNO-R3", &["ARDUINO-UNO", "UNO-R3"], "ATMEGA328P-PU", "Arduino Uno R3, the pins of its connectors"),
    board!("B-G474E-DPOW1", &["ST_STM32G474RE_DISCOVERY_DPOW1"], "STM32G474RET6", "B-G474E-DPOW1, Discovery kit, all pins of its MCU"),
    board!("BLACKPILL-F401CC", &["WEACT-F401CC"], "STM32F401CCU6", "Black Pill F401CC, all pins of its MCU"),
    board!("BLACKPILL-F411CE", &["WEACT-F411CE"], "STM32F411CEU6", "Black Pill F411CE, all pins of its MCU"),
    board!("BLUEPILL-F103C8", &["BLUEPILL", "STM32F103C8-MINIMAL"], "STM32F103C8T6", "Blue Pill, the minimal board with an STM32F103C8, all pins of its MCU"),
    board!("NUCLEO-C031C6", &["ST_NUCLEO64_C031C6", "NUCLEO64-C031C6"], "STM32C031C6T6", "Nucleo-64 C031C6, all pins of its MCU"),
    board!("NUCLEO-C071RB", &["ST_NUCLEO64_C071RB", "NUCLEO64-C071RB"], "STM32C071RBT6", "Nucleo-64 C071RB, all pins of its MCU"),
    board!("NUCLEO-F030R8", &["ST_NUCLEO64_F030R8", "NUCLEO64-F030R8"], "STM32F030R8T6", "Nucleo-64 F030R8, the pins of its Morpho connectors"),
    board!("NUCLEO-F031K6", &["ST_NUCLEO32_F031K6", "NUCLEO32-F031K6"], "STM32F031K6T6", "Nucleo-32 F031K6, the pins of its Nano connectors"),
    board!("NUCLEO-F042K6", &["ST_NUCLEO32_F042K6", "NUCLEO32-F042K6"], "STM32F042K6T6", "Nucleo-32 F042K6, the pins of its Nano connectors"),
    board!("NUCLEO-F070RB", &["ST_NUCLEO64_F070RB", "NUCLEO64-F070RB"], "STM32F070RBT6", "Nucleo-64 F070RB, the pins of its Morpho connectors"),
    board!("NUCLEO-F072RB", &["ST_NUCLEO64_F072RB", "NUCLEO64-F072RB"], "STM32F072RBT6", "Nucleo-64 F072RB, the pins of its Morpho connectors"),
    board!("NUCLEO-F091RC", &["ST_NUCLEO64_F091RC", "NUCLEO64-F091RC"], "STM32F091RCT6", "Nucleo-64 F091RC, the pins of its Morpho connectors"),
    board!("NUCLEO-F103RB", &["ST_NUCLEO64_F103RB", "NUCLEO64-F103RB"], "STM32F103RBT6", "Nucleo-64 F103RB, the pins of its Morpho connectors"),
    board!("NUCLEO-F207ZG", &["ST_NUCLEO144_F207ZG", "NUCLEO144-F207ZG"], "STM32F207ZGT6", "Nucleo-144 F207ZG, all pins of its MCU"),
    board!("NUCLEO-F302R8", &["ST_NUCLEO64_F302R8", "NUCLEO64-F302R8"], "STM32F302R8T6", "Nucleo-64 F302R8, the pins of its Morpho connectors"),
    board!("NUCLEO-F303K8", &["ST_NUCLEO32_F303K8", "NUCLEO32-F303K8"], "STM32F303K8T6", "Nucleo-32 F303K8, the pins of its Nano connectors"),
    board!("NUCLEO-F303RE", &["ST_NUCLEO64_F303RE", "NUCLEO64-F303RE"], "STM32F303RET6", "Nucleo-64 F303RE, the pins of its Morpho connectors"),
    board!("NUCLEO-F303ZE", &["ST_NUCLEO144_F303ZE", "NUCLEO144-F303ZE"], "STM32F303ZET6", "Nucleo-144 F303ZE, all pins of its MCU"),
    board!("NUCLEO-F334R8", &["ST_NUCLEO64_F334R8", "NUCLEO64-F334R8"], "STM32F334R8T6", "Nucleo-64 F334R8, the pins of its Morpho connectors"),
    board!("NUCLEO-F401RE", &["ST_NUCLEO64_F401RE", "NUCLEO64-F401RE"], "STM32F401RET6", "Nucleo-64 F401RE, the pins of its Morpho connectors"),
    board!("NUCLEO-F410RB", &["ST_NUCLEO64_F410RB", "NUCLEO64-F410RB"], "STM32F410RBT6", "Nucleo-64 F410RB, the pins of its Morpho connectors"),
    board!("NUCLEO-F411RE", &["ST_NUCLEO64_F411RE", "NUCLEO64-F411RE"], "STM32F411RET6", "Nucleo-64 F411RE, the pins of its Morpho connectors"),
    board!("NUCLEO-F412ZG", &["ST_NUCLEO144_F412ZG", "NUCLEO144-F412ZG"], "STM32F412ZGT6", "Nucleo-144 F412ZG, all pins of its MCU"),
    board!("NUCLEO-F413ZH", &["ST_NUCLEO144_F413ZH", "NUCLEO144-F413ZH"], "STM32F413ZHT6", "Nucleo-144 F413ZH, all pins of its MCU"),
    board!("NUCLEO-F429ZI", &["ST_NUCLEO144_F429ZI", "NUCLEO144-F429ZI"], "STM32F429ZIT6", "Nucleo-144 F429ZI, all pins of its MCU"),
    board!("NUCLEO-F446RE", &["ST_NUCLEO64_F446RE", "NUCLEO64-F446RE"], "STM32F446RET6", "Nucleo-64 F446RE, the pins of its Morpho connectors"),
    board!("NUCLEO-F446ZE", &["ST_NUCLEO144_F446ZE", "NUCLEO144-F446ZE"], "STM32F446ZET6", "Nucleo-144 F446ZE, all pins of its MCU"),
    board!("NUCLEO-F722ZE", &["ST_NUCLEO144_F722ZE", "NUCLEO144-F722ZE"], "STM32F722ZET6", "Nucleo-144 F722ZE, all pins of its MCU"),
    board!("NUCLEO-F746ZG", &["ST_NUCLEO144_F746ZG", "NUCLEO144-F746ZG"], "STM32F746ZGT6", "Nucleo-144 F746ZG, all pins of its MCU"),
    board!("NUCLEO-F756ZG", &["ST_NUCLEO144_F756ZG", "NUCLEO144-F756ZG"], "STM32F756ZGT6", "Nucleo-144 F756ZG, all pins of its MCU"),
    board!("NUCLEO-F767ZI", &["ST_NUCLEO144_F767ZI", "NUCLEO144-F767ZI"], "STM32F767ZIT6", "Nucleo-144 F767ZI, all pins of its MCU"),
    board!("NUCLEO-G0B1RE", &["ST_NUCLEO64_G0B1RE", "NUCLEO64-G0B1RE"], "STM32G0B1RET6", "Nucleo-64 G0B1RE, the pins of its Morpho connectors"),
    board!("NUCLEO-G031K8", &["ST_NUCLEO32_G031K8", "NUCLEO32-G031K8"], "STM32G031K8T6", "Nucleo-32 G031K8, the pins of its Nano connectors"),
    board!("NUCLEO-G071RB", &["ST_NUCLEO64_G071RB", "NUCLEO64-G071RB"], "STM32G071RBT6", "Nucleo-64 G071RB, the pins of its Morpho connectors"),
    board!("NUCLEO-G431RB", &["ST_NUCLEO64_G431RB", "NUCLEO64-G431RB"], "STM32G431RBT6", "Nucleo-64 G431RB, the pins of its Morpho connectors"),
    board!("NUCLEO-G474RE", &["ST_NUCLEO64_G474RE", "NUCLEO64-G474RE"], "STM32G474RET6", "Nucleo-64 G474RE, the pins of its Morpho connectors"),
    board!("NUCLEO-H7A3ZI-Q", &["ST_NUCLEO144_H7A3ZI_Q", "NUCLEO144-H7A3ZI-Q"], "STM32H7A3ZIT6Q", "Nucleo-144 H7A3ZI, all pins of its MCU"),
    board!("NUCLEO-H503RB", &["ST_NUCLEO64_H503RB", "NUCLEO64-H503RB"], "STM32H503RBT6", "Nucleo-64 H503RB, the pins of its Morpho connectors"),
    board!("NUCLEO-H563ZI", &["ST_NUCLEO144_H563ZI", "NUCLEO144-H563ZI"], "STM32H563ZIT6", "Nucleo-144 H563ZI, all pins of its MCU"),
    board!("NUCLEO-H723ZG", &["ST_NUCLEO144_H723ZG", "NUCLEO144-H723ZG"], "STM32H723ZGT6", "Nucleo-144 H723ZG, all pins of its MCU"),
    board!("NUCLEO-H743ZI", &["ST_NUCLEO144_H743ZI", "NUCLEO144-H743ZI"], "STM32H743ZIT6", "Nucleo-144 H743ZI (MB1137), all pins of its MCU"),
    board!("NUCLEO-H743ZI2", &["NUCLEO144-H743ZI2"], "STM32H743ZIT6", "Nucleo-144 H743ZI2 (MB1364), all pins of its MCU"),
    board!("NUCLEO-H755ZI-Q", &["ST_NUCLEO144_H755ZI", "NUCLEO144-H755ZI-Q"], "STM32H755ZIT6", "Nucleo-144 H755ZI, all pins of its MCU"),
    board!("NUCLEO-L4P5ZG", &["ST_NUCLEO144_L4P5ZG", "NUCLEO144-L4P5ZG"], "STM32L4P5ZGT6", "Nucleo-144 L4P5ZG, all pins of its MCU"),
    board!("NUCLEO-L4R5ZI", &["ST_NUCLEO144_L4R5ZI", "NUCLEO144-L4R5ZI"], "STM32L4R5ZIT6", "Nucleo-144 L4R5ZI, all pins of its MCU"),
    board!("NUCLEO-L011K4", &["ST_NUCLEO32_L011K4", "NUCLEO32-L011K4"], "STM32L011K4T6", "Nucleo-32 L011K4, the pins of its Nano connectors"),
    board!("NUCLEO-L031K6", &["ST_NUCLEO32_L031K6", "NUCLEO32-L031K6"], "STM32L031K6T6", "Nucleo-32 L031K6, the pins of its Nano connectors"),
    board!("NUCLEO-L053R8", &["ST_NUCLEO64_L053R8", "NUCLEO64-L053R8"], "STM32L053R8T6", "Nucleo-64 L053R8, the pins of its Morpho connectors"),
    board!("NUCLEO-L073RZ", &["ST_NUCLEO64_L073RZ", "NUCLEO64-L073RZ"], "STM32L073RZT6", "Nucleo-64 L073RZ, the pins of its Morpho connectors"),
    board!("NUCLEO-L152RE", &["ST_NUCLEO64_L152RE", "NUCLEO64-L152RE"], "STM32L152RET6", "Nucleo-64 L152RE, the pins of its Morpho connectors"),
    board!("NUCLEO-L432KC", &["ST_NUCLEO32_L432KC", "NUCLEO32-L432KC"], "STM32L432KCU6", "Nucleo-32 L432KC, the pins of its Nano connectors"),
    board!("NUCLEO-L452RE-P", &["ST_NUCLEO64_L452RE_P", "NUCLEO64-L452RE-P"], "STM32L452RET6P", "Nucleo-64 L452RE, the pins of its Morpho connectors"),
    board!("NUCLEO-L476RG", &["ST_NUCLEO64_L476RG", "NUCLEO64-L476RG"], "STM32L476RGT6", "Nucleo-64 L476RG, the pins of its Morpho connectors"),
    board!("NUCLEO-L496ZG", &["ST_NUCLEO144_L496ZG", "NUCLEO144-L496ZG"], "STM32L496ZGT6", "Nucleo-144 L496ZG, all pins of its MCU"),
    board!("NUCLEO-L552ZE-Q", &["ST_NUCLEO144_L552ZE", "NUCLEO144-L552ZE-Q"], "STM32L552ZET6Q", "Nucleo-144 L552ZE, all pins of its MCU"),
    board!("NUCLEO-U083RC", &["ST_NUCLEO64_U083RC", "NUCLEO64-U083RC"], "STM32U083RCT6", "Nucleo-64 U083RC, the pins of its Morpho connectors"),
    board!("NUCLEO-U385RG-Q", &["ST_NUCLEO64_U385RG_Q", "NUCLEO64-U385RG-Q"], "STM32U385RGT6Q", "Nucleo-64 U385RG, all pins of its MCU"),
    board!("NUCLEO-WB55RG", &["ST_NUCLEO68_WB55RG", "NUCLEO68-WB55RG"], "STM32WB55RGV6", "NUCLEO-WB55RG, all pins of its MCU"),
    board!("NUCLEO-WL55JC1", &["ST_NUCLEO64_WL55JC", "NUCLEO64-WL55JC", "NUCLEO-WL55JC"], "STM32WL55JCI7", "Nucleo-64 WL55JC, all pins of its MCU"),
    board!("P-NUCLEO-WB55-USBDONGLE", &["ST_NUCLEO48_WB55CG_USB", "NUCLEO48-WB55CG-USB"], "STM32WB55CGU6", "P-NUCLEO-WB55-USBDONGLE, all pins of its MCU"),
    board!("RASPBERRYPI-PICO", &["RPI-PICO", "PICO", "RP_PICO_RP2040"], "RP2040", "Raspberry Pi Pico, all its pins"),
    board!("RASPBERRYPI-PICO-2", &["RPI-PICO-2", "PICO-2"], "RP2350A", "Raspberry Pi Pico 2, all its pins"),
    board!("STM32C0116-DK", &["ST_STM32C011F6_DISCOVERY"], "STM32C011F6U6", "STM32C0116-DK, Discovery kit, all pins of its MCU"),
    board!("STM32F0DISCOVERY", &["ST_STM32F0_DISCOVERY"], "STM32F051R8T6", "STM32F0DISCOVERY, Discovery kit, all pins of its MCU"),
    board!("STM32F3DISCOVERY", &["ST_STM32F3_DISCOVERY"], "STM32F303VCT6", "STM32F3DISCOVERY, Discovery kit, all pins of its MCU"),
    board!("STM32F4DiscoveryBoard", &[], "STM32F407VGT6", "STM32F4 Discovery, the 26 pins of the paper's Table 1"),
    board!("STM32F072B-DISCO", &["ST_STM32F072B_DISCOVERY"], "STM32F072RBT6", "STM32F072B-DISCO, Discovery kit, all pins of its MCU"),
    board!("STM32F401C-DISCO", &["ST_STM32F401C_DISCOVERY"], "STM32F401VCT6", "STM32F401C-DISCO, Discovery kit, all pins of its MCU"),
    board!("STM32F407G-DISC1", &["STM32F4-DISCOVERY", "STM32F407-DISCOVERY", "STM32F407VG-DISCOVERY", "F4-DISCOVERY"], "STM32F407VGT6", "STM32F4 Discovery, all pins and on-board parts"),
    board!("STM32F429I-DISC1", &["ST_STM32F429I_DISCOVERY"], "STM32F429ZIT6", "STM32F429I-DISC1, Discovery kit, all pins of its MCU"),
    board!("STM32F469I-DISCO", &["ST_STM32F469I_DISCOVERY"], "STM32F469NIH6", "STM32F469I-DISCO, Discovery kit, the pins of its connectors and on-board parts"),
    board!("STM32F746G-DISCO", &["ST_STM32F746G_DISCOVERY"], "STM32F746NGH6", "STM32F746G-DISCO, Discovery kit, the pins of its connectors and on-board parts"),
    board!("STM32F769I-DISC1", &["ST_STM32F769I_DISCOVERY"], "STM32F769NIH6", "STM32F769I-DISC1, Discovery kit, the pins of its connectors and on-board parts"),
    board!("STM32F3348-DISCO", &["ST_STM32F334_DISCOVERY"], "STM32F334C8T6", "STM32F3348-DISCO, Discovery kit, all pins of its MCU"),
    board!("STM32H735G-DK", &["ST_STM32H735IG_DISCOVERY"], "STM32H735IGK6", "STM32H735G-DK, Discovery kit, the pins of its connectors and on-board parts"),
    board!("STM32H750B-DK", &["ST_STM32H750XB_DISCOVERY"], "STM32H750XBH6", "STM32H750B-DK, Discovery kit, the pins of its connectors and on-board parts"),
    board!("STM32L4R9I-DISCO", &["ST_STM32L4R9I_DISCOVERY"], "STM32L4R9AII6", "STM32L4R9I-DISCO, Discovery kit, the pins of its connectors and on-board parts"),
    board!("STM32L476G-DISCO", &["ST_STM32L476_DISCOVERY"], "STM32L476VGT6", "STM32L476G-DISCO, Discovery kit, all pins of its MCU"),
    board!("STM32L0538-DISCO", &["ST_STM32L053_DISCOVERY"], "STM32L053C8T6", "STM32L0538-DISCO, Discovery kit, all pins of its MCU"),
    board!("STM32L-DISCOVERY", &["ST_STM32L_DISCOVERY"], "STM32L152RBT6", "STM32L-DISCOVERY, Discovery kit, all pins of its MCU"),
    board!("STM32VLDISCOVERY", &["ST_STM32VL_DISCOVERY"], "STM32F100RBT6", "STM32VLDISCOVERY, Discovery kit, all pins of its MCU"),
];

#[rustfmt::skip]
pub(crate) const TARGETS: &[Target] = &[
    Target {
        target: "chibios-21.11",
        family: "STM32F0",
        parts: &["STM32F030?4", "STM32F030?6", "STM32F030?8", "STM32F030?C", "STM32F031", "STM32F038", "STM32F042", "STM32F048", "STM32F051", "STM32F058", "STM32F070?6", "STM32F070?B", "STM32F071", "STM32F072", "STM32F078", "STM32F091", "STM32F098"],
        text: include_str!("../../../targets/chibios-21.11/stm32f0.toml"),
    },
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
    Target {
        target: "chibios-21.11",
        family: "STM32F7",
        parts: &["STM32F722", "STM32F723", "STM32F732", "STM32F733", "STM32F745", "STM32F746", "STM32F756", "STM32F765", "STM32F767", "STM32F769", "STM32F777", "STM32F779"],
        text: include_str!("../../../targets/chibios-21.11/stm32f7.toml"),
    },
    Target {
        target: "chibios-21.11",
        family: "STM32G0",
        parts: &["STM32G031", "STM32G041", "STM32G070", "STM32G071", "STM32G081", "STM32G0B0", "STM32G0B1", "STM32G0C1"],
        text: include_str!("../../../targets/chibios-21.11/stm32g0.toml"),
    },
    Target {
        target: "chibios-21.11",
        family: "STM32G4",
        parts: &["STM32G431", "STM32G441", "STM32G471", "STM32G473", "STM32G474", "STM32G483", "STM32G484", "STM32G491"],
        text: include_str!("../../../targets/chibios-21.11/stm32g4.toml"),
    },
    Target {
        target: "chibios-21.11",
        family: "STM32H7",
        parts: &["STM32H723", "STM32H725", "STM32H730", "STM32H733", "STM32H735", "STM32H743", "STM32H753", "STM32H745", "STM32H755", "STM32H747", "STM32H757", "STM32H750", "STM32H7A3", "STM32H7B3"],
        text: include_str!("../../../targets/chibios-21.11/stm32h7.toml"),
    },
    Target {
        target: "chibios-21.11",
        family: "STM32L4",
        parts: &["STM32L422", "STM32L431", "STM32L432", "STM32L433", "STM32L443", "STM32L452", "STM32L475", "STM32L476", "STM32L486", "STM32L496", "STM32L4A6"],
        text: include_str!("../../../targets/chibios-21.11/stm32l4.toml"),
    },
    Target {
        target: "chibios-21.11",
        family: "STM32L4",
        parts: &["STM32L4P5", "STM32L4Q5", "STM32L4R5", "STM32L4R7", "STM32L4R9", "STM32L4S5", "STM32L4S7", "STM32L4S9"],
        text: include_str!("../../../targets/chibios-21.11/stm32l4plus.toml"),
    },
];
