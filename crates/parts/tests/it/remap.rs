//! Remap blocks of STM32F1: all signals of one peripheral that are in use must be in one of them.

use std::collections::{BTreeMap, BTreeSet};

use sensedsl_board::remap::{Blocks, agree_by_pairs};
use sensedsl_board::table::{self, Table};
use sensedsl_parts::{all, find};
use sensedsl_wiring::{Solved, Wiring};

use super::designs;

fn feasible(part: &str, target: &str, devices: &str) -> bool {
    let design = designs::of_devices(part, target, "", devices);
    match Wiring::new(&design, None).solve_only(false) {
        Solved::Wired(_) => true,
        Solved::Infeasible(_) => false,
        Solved::Failed(why) => panic!("{why:?}"),
    }
}

fn count(part: &str, devices: &str) -> String {
    let design = designs::of_devices(part, "none", "", devices);
    format!("{:?}", Wiring::new(&design, None).count().unwrap())
}

fn table(part: &str) -> Table {
    table::load(&find(part).unwrap().csv()).board
}

#[test]
fn the_table_has_the_blocks() {
    let table = table("STM32F103VBT6");
    let blocks = |pin: &str, signal: &str| {
        let pin = table.pins.iter().find(|row| row.name.as_str() == pin).unwrap();
        let usage = pin.usages.iter().find(|usage| usage.signal.name() == signal).unwrap();
        usage.blocks.map(|blocks| blocks.to_string())
    };
    for (pin, signal, expected) in [
        ("PA6", "TIM3_CH1", Some("0")),
        ("PB4", "TIM3_CH1", Some("2")),
        ("PC6", "TIM3_CH1", Some("3")),
        ("PB0", "TIM3_CH3", Some("0|2")),
        ("PA0", "TIM2_CH1", Some("0|2")),
        ("PB10", "TIM2_CH3", Some("2|3")),
        ("PC10", "USART3_TX", Some("1")),
        ("PD8", "USART3_TX", Some("3")),
        ("PB8", "CAN_RX", Some("2")),
        ("PB10", "I2C2_SCL", None),
        ("PA0", "ADC12_IN0", None),
    ] {
        assert_eq!(blocks(pin, signal).as_deref(), expected, "{signal} at {pin}");
    }
}

/// On every F1 and SAM D, signals that can be together in pairs can all be together; no other family has blocks.
#[test]
fn pairs_decide_on_all_parts() {
    let mut sets = 0;
    for part in all().step_by(crate::step(8)) {
        let mut units: BTreeMap<String, BTreeSet<Blocks>> = BTreeMap::new();
        for usage in table(&part.name()).pins.iter().flat_map(|pin| &pin.usages) {
            let Some(blocks) = usage.blocks else { continue };
            let has_blocks = ["STM32F1", "ATSAMD", "ATSAME5"];
            let is_one = has_blocks.iter().any(|start| part.name().starts_with(start));
            assert!(is_one, "{}", part.name());
            let name = usage.signal.name();
            let unit = name.split_once('_').map_or(name, |(unit, _)| unit);
            units.entry(unit.to_owned()).or_default().insert(blocks);
        }
        for (unit, of_unit) in units {
            let of_unit: Vec<Blocks> = of_unit.into_iter().collect();
            assert!(agree_by_pairs(&of_unit), "{} {unit}", part.name());
            sets += of_unit.len();
        }
    }
    assert!(sets > 1_000 / crate::step(8), "{sets}");
}

#[test]
fn a_device_has_all_its_wires_in_one_block() {
    for target in ["none", "chibios"] {
        let on = |devices: &str| feasible("STM32F103C8", target, devices);
        assert!(on("encoder unit = TIM3, a = PA6, b = PA7"));
        assert!(on("encoder unit = TIM3, a = PB4, b = PB5"));
        assert!(!on("encoder unit = TIM3, a = PA6, b = PB5"));
        assert!(on("uart unit = USART1, tx = PB6, rx = PB7"));
        assert!(!on("uart unit = USART1, tx = PB6, rx = PA10"));
        assert!(!on("i2c unit = I2C1, scl = PB6, sda = PB9"));
        assert!(on("i2c unit = I2C1, scl = PB8, sda = PB9"));
    }
}

#[test]
fn devices_on_one_peripheral_agree_on_its_block() {
    for target in ["none", "chibios"] {
        let on = |devices: &str| feasible("STM32F103C8", target, devices);
        // CH1 at PB4 is only in the partial remap, in which CH3 stays where it is.
        assert!(on("pwm unit = TIM3, pin = PB4; pwm unit = TIM3, pin = PB0"));
        assert!(!on("pwm unit = TIM3, pin = PA6; pwm unit = TIM3, pin = PB5"));
        // TIM2 in block 3, in block 2, and in none.
        assert!(on("pwm unit = TIM2, pin = PA15; pwm unit = TIM2, pin = PB10"));
        assert!(on("pwm unit = TIM2, pin = PA0; pwm unit = TIM2, pin = PB11"));
        assert!(!on("pwm unit = TIM2, pin = PA15; pwm unit = TIM2, pin = PA1"));
        assert!(!on("pwm unit = TIM2, pin = PA2; pwm unit = TIM2, pin = PB11"));
        // I2C2 is on PB10 and PB11, and so is everything that 48 pins bring out of USART3.
        assert!(!on("i2c unit = I2C2; uart unit = USART3"));
        assert!(feasible("STM32F103R8", target, "i2c unit = I2C2; uart unit = USART3"));
    }
}

/// A signal that is in several blocks counts as one wiring, not one for each.
#[test]
fn wirings_are_counted_once() {
    assert_eq!(count("STM32F103C8", "pwm pin = PA8"), count("STM32F407VG", "pwm pin = PD12"));
    // TIM1_CH1 to CH4 at PA8 to PA11, all in blocks 0 and 1: two of four in order.
    let two = count("STM32F103C8", "pwm unit = TIM1; pwm unit = TIM1");
    assert!(two.contains("12"), "{two}");
}

/// Every two outputs of one timer: there is a wiring if they have a block in common, and only then.
#[test]
fn all_pairs_of_a_timer_s_outputs() {
    let table = table("STM32F103VBT6");
    let mut outputs: Vec<(String, String, Blocks)> = Vec::new();
    for pin in &table.pins {
        for usage in &pin.usages {
            let name = usage.signal.name();
            let plain = name.starts_with("TIM") && name[5..].starts_with("CH") && name.len() == 8;
            if plain {
                outputs.push((pin.name.to_string(), name.to_owned(), usage.blocks.unwrap()));
            }
        }
    }
    let mut seen = [0, 0];
    for (at, (first, name, blocks)) in outputs.iter().enumerate() {
        for (second, other, others) in &outputs[at + 1..] {
            let unit = &name[..4];
            if other[..4] != *unit || other == name || first == second {
                continue;
            }
            let devices =
                format!("pwm unit = {unit}, pin = {first}; pwm unit = {unit}, pin = {second}");
            let agree = blocks.and(*others).is_some();
            assert_eq!(feasible("STM32F103VB", "none", &devices), agree, "{devices}");
            seen[usize::from(agree)] += 1;
        }
    }
    assert_eq!(seen, [48, 61], "pairs that have none, that have one");
}

/// On SAM D5x the pads of a SERCOM are of one set, as the data sheet has them, or of those that boards have their SPI
/// lines on.
#[test]
fn pads_of_a_sercom_are_of_one_set() {
    let on = |devices: &str| feasible("ATSAMD51J19A", "none", devices);
    for (sda, scl, is_set) in
        [("PA8", "PA9", true), ("PA4", "PA5", true), ("PA8", "PA5", false), ("PA4", "PA9", false)]
    {
        let devices = format!("i2c unit = SERCOM0, sda = {sda}, scl = {scl}");
        assert_eq!(on(&devices), is_set, "{devices}");
    }
    for (mosi, sck, miso, is_set) in [
        // Set 1 in both orders, with a pad of set 3, and the lines of Feather M4.
        ("PA8", "PA9", "PA10", true),
        ("PA11", "PA9", "PA8", true),
        ("PA11", "PA9", "PA10", true),
        ("PA11", "PA5", "PA8", false),
        ("PA8", "PA9", "PA6", false),
    ] {
        let devices = format!("spi unit = SERCOM0, mosi = {mosi}, sck = {sck}, miso = {miso}");
        assert_eq!(on(&devices), is_set, "{devices}");
    }
    assert!(on("spi unit = SERCOM1, mosi = PB23, sck = PA17, miso = PB22"));
    assert!(!on("spi unit = SERCOM1, mosi = PB23, sck = PA17, miso = PA18"));
}
