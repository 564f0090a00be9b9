//! Requests on parts of all families with ChibiOS profiles: what their drivers can do and what they
//! cannot.

use std::collections::BTreeMap;

use sensedsl_board::profile;
use sensedsl_parts::all;
use sensedsl_wiring::{Solved, Wiring};

use super::designs;

/// The units that the best wiring of devices takes, by device; `None` if there is no wiring.
fn wired(part: &str, link: &str, devices: &str) -> Option<Vec<String>> {
    let link = format!("link {{ {link} }}\n");
    let design = designs::of_devices(part, "chibios", &link, devices);
    match Wiring::new(&design, None).solve_only(false) {
        Solved::Wired(wiring) => {
            let devices = wiring.boards.iter().flat_map(|board| &board.devices);
            Some(devices.filter_map(|device| device.unit.clone()).collect())
        }
        Solved::Infeasible(_) => None,
        Solved::Failed(why) => panic!("{part}: {devices}: {why:?}"),
    }
}

fn feasible(part: &str, link: &str, devices: &str) -> bool {
    wired(part, link, devices).is_some()
}

const SERIAL: &str = "transport = uart;";
const USB: &str = "transport = usb;";

#[test]
fn requests_of_f0_f1_and_f3() {
    // F0: one bus of I2C on the smallest; TIM14 to 17 do not capture.
    // On 32 pins, CAN has no place other than USB's.
    assert!(feasible("STM32F042K6", USB, "analog; i2c; icu"));
    assert!(feasible("STM32F042K6", SERIAL, "analog; i2c; icu; can"));
    assert!(!feasible("STM32F042K6", USB, "can"));
    assert!(feasible("STM32F042C6", USB, "can"));
    assert!(!feasible("STM32F030F4", SERIAL, "i2c unit = I2C2"));
    assert!(!feasible("STM32F072RB", SERIAL, "icu unit = TIM14"));
    // The tree has no interrupt handler for TIM15 on F0.
    assert!(!feasible("STM32F072RB", SERIAL, "icu unit = TIM15"));
    // F1: USB and CAN share a memory; the streams of I2C2 are those of SPI2.
    assert!(feasible("STM32F103RB", SERIAL, "can; i2c; analog"));
    assert!(!feasible("STM32F103RB", USB, "can"));
    assert!(!feasible("STM32F103RB", USB, "i2c unit = I2C2; spi unit = SPI2"));
    assert!(feasible("STM32F103RB", USB, "i2c unit = I2C1; spi unit = SPI2"));
    assert!(feasible("STM32F105RB", USB, "can unit = CAN1; can unit = CAN2"));
    // F3: fixed streams again; TIM8 is only on the larger lines.
    assert!(feasible("STM32F303VC", USB, "analog; i2c; icu; can; dac; encoder"));
    assert!(!feasible("STM32F303VC", USB, "i2c unit = I2C1; i2c unit = I2C3"));
    assert!(!feasible("STM32F303K8", SERIAL, "icu unit = TIM8"));
}

#[test]
fn requests_of_f4_and_f7() {
    // F4 other than F407: no DAC on F411, no TIM2 on F410.
    assert!(!feasible("STM32F411CE", USB, "dac"));
    assert!(feasible("STM32F446RE", USB, "analog; i2c; icu; dac"));
    assert!(!feasible("STM32F410RB", SERIAL, "icu unit = TIM2"));
    // F7: two requests, two streams, but not the same.
    assert!(feasible("STM32F746NG", USB, "i2c unit = I2C1; i2c unit = I2C2; i2c unit = I2C3"));
    assert!(!feasible("STM32F722ZE", USB, "can unit = CAN2"));
}

#[test]
fn requests_of_g0_g4_h7_and_l4() {
    // G0: no DAC on G031, and its eight contacts do not leave room for much.
    assert!(!feasible("STM32G031K8", SERIAL, "dac"));
    assert!(feasible("STM32G071RB", SERIAL, "dac; analog; i2c; icu"));
    // G4: any request can have any stream, FDCAN serves CAN.
    let found = wired("STM32G474RE", USB, "can; analog; i2c; i2c unit = I2C4").unwrap();
    assert!(found.iter().any(|unit| unit.starts_with("FDCAN")), "{found:?}");
    assert!(!feasible("STM32G431RB", USB, "i2c unit = I2C4"));
    // H7: ADC2 has no driver of its own; TIM23 has none at all.
    assert!(feasible("STM32H743ZI", USB, "analog unit = ADC1; analog unit = ADC3; i2c; can; icu"));
    assert!(!feasible("STM32H743ZI", USB, "analog unit = ADC2"));
    assert!(!feasible("STM32H723ZG", SERIAL, "icu unit = TIM23"));
    // L4: I2C3's streams are those of ADC2 and ADC3 if nothing else is free.
    assert!(feasible("STM32L476RG", USB, "analog; i2c; i2c unit = I2C3; can; dac"));
    assert!(!feasible("STM32L476RG", USB, "i2c unit = I2C4"));
    assert!(feasible("STM32L4R5ZI", USB, "i2c unit = I2C4; spi; can; dac"));
}

/// A multiplexer has only a certain number of streams.
#[test]
fn streams_behind_a_multiplexer_run_out() {
    // G031 has five channels: two buses of I2C, a converter and one SPI, which needs two.
    let devices = "i2c unit = I2C1; i2c unit = I2C2; spi; analog";
    assert!(wired("STM32G031K8", SERIAL, devices).is_some());
    let spis = "spi unit = SPI1; spi unit = SPI2";
    assert!(wired("STM32G031K8", SERIAL, spis).is_some());
    assert!(wired("STM32G031K8", SERIAL, &format!("{spis}; i2c unit = I2C1")).is_some());
    assert_eq!(wired("STM32G031K8", SERIAL, &format!("{spis}; {devices}")), None);
}

/// Every part of the families has a profile, except those that the tree does not know.
#[test]
fn parts_have_profiles() {
    let mut without: BTreeMap<String, usize> = BTreeMap::new();
    let families = ["F0", "F1", "F3", "F4", "F7", "G0", "G4", "H7", "L4"];
    let mut with = 0;
    for part in all() {
        let name = part.name();
        let Some(family) = name.strip_prefix("STM32").and_then(|rest| rest.get(..2)) else {
            continue;
        };
        if !families.contains(&family) {
            continue;
        }
        if profile::find("chibios", &name).is_ok() {
            with += 1;
        } else {
            let die: String = name.chars().take(9).collect();
            *without.entry(die).or_default() += 1;
        }
    }
    let names: Vec<&str> = without.keys().map(String::as_str).collect();
    let unknown = "STM32F100 STM32F318 STM32F328 STM32F358 STM32F373 STM32F378 STM32F423 STM32F730 \
                   STM32F750 STM32F768 STM32F778 STM32G030 STM32G050 STM32G051 STM32G061 STM32G4A1 \
                   STM32H742 STM32H7B0 STM32H7R3 STM32H7R7 STM32H7S3 STM32H7S7 STM32L412 STM32L442 \
                   STM32L451 STM32L462 STM32L471";
    assert_eq!(names.join(" "), unknown);
    assert!(with > 1_000, "{with}");
}
