//! The shipped table: its content, and what names lead to.

use std::collections::BTreeSet;

use sensedsl_board::table;
use sensedsl_parts::{all, find, nearest_name, packed_bytes};

#[test]
fn the_table_is_small_and_large() {
    assert!(packed_bytes() < 400_000, "{} bytes", packed_bytes());
    let numbers: BTreeSet<String> = all()
        .flat_map(|part| part.numbers())
        .filter(|number| number.starts_with("STM32"))
        .collect();
    assert!(numbers.len() >= 3_400, "{} STM32 part numbers", numbers.len());
    let families: BTreeSet<&str> = numbers.iter().map(|number| &number[..7]).collect();
    let expected = "C0 F0 F1 F2 F3 F4 F7 G0 G4 H5 H7 L0 L1 L4 L5 N6 U0 U3 U5 WB WL";
    let expected: BTreeSet<String> = expected.split(' ').map(|f| format!("STM32{f}")).collect();
    assert_eq!(families, expected.iter().map(String::as_str).collect());
}

/// A part's number leads to that part, and its table reads as its pins without a warning.
#[test]
fn every_part_is_a_table() {
    for part in all().step_by(crate::step(16)) {
        let found = find(&part.name()).unwrap();
        assert_eq!(found.parts, [part], "{}", part.name());
        let table::Loaded { board, findings } = table::load(&found.csv());
        assert!(findings.is_empty(), "{}: {findings:?}", part.name());
        let pins: Vec<String> = board.pins.iter().map(|pin| pin.name.to_string()).collect();
        let own: Vec<String> = found.sheet.pins().map(|(pin, ..)| pin.to_string()).collect();
        assert_eq!(pins, own, "{}", part.name());
        assert!(!pins.is_empty(), "{}", part.name());
    }
}

#[test]
fn names_lead_to_parts() {
    let mcu = |name: &str| find(name).map(|found| (found.mcu.clone(), found.package()));
    let is = |name: &str, package| Some((name.to_owned(), Some(package)));
    assert_eq!(mcu("stm32f407vgt6"), is("STM32F407VGT6", "LQFP100"));
    assert_eq!(mcu("STM32F407VGTx"), is("STM32F407VGT6", "LQFP100"));
    assert_eq!(mcu("STM32F407VGT6TR"), is("STM32F407VGT6", "LQFP100"));
    assert_eq!(mcu("STM32F407VG"), is("STM32F407VG", "LQFP100"));
    assert_eq!(mcu("STM32G031J6"), is("STM32G031J6", "SO8N"));
    assert_eq!(mcu("RP2040"), is("RP2040", "QFN56"));
    assert_eq!(mcu("ATmega2560-16AU"), is("ATMEGA2560-16AU", "TQFP100"));
    assert_eq!(mcu("STM32F4"), None);
    assert_eq!(nearest_name("STM32F407VGT66").as_deref(), Some("STM32F407VGT6"));
}

#[test]
fn what_is_not_known_is_told() {
    let doubt = |name: &str| find(name).unwrap().doubt();
    assert_eq!(doubt("STM32F407VGT6"), None);
    assert_eq!(doubt("STM32F103C8"), None, "its packages bring out the same pins");
    assert!(doubt("STM32WBA52CG").unwrap().contains("package"));
    assert!(doubt("RP2040").unwrap().contains("places"));
    let several = find("STM32H7A3ZI").unwrap();
    assert!(several.doubt().unwrap().contains("several packages"));
    let of = |name: &str| -> BTreeSet<String> {
        find(name).unwrap().sheet.pins().map(|(pin, ..)| pin.to_string()).collect()
    };
    assert!(of("STM32H7A3ZI").is_subset(&of("STM32H7A3ZIT6")));
    assert!(of("STM32H7A3ZI").is_subset(&of("STM32H7A3ZIT6Q")));
}

/// The contacts of the 8-pin STM32G031J6, as its data sheet has them.
#[test]
fn contacts_that_pins_share() {
    let found = find("STM32G031J6").unwrap();
    let on = |contact: &str| -> Vec<String> {
        let pins = found.sheet.pins().filter(|(_, position, _)| *position == Some(contact));
        pins.map(|(pin, ..)| pin.to_string()).collect()
    };
    assert_eq!(on("1"), ["PB7", "PB8", "PB9", "PC14"]);
    assert_eq!(on("4"), ["PA0", "PA1", "PA2", "PF2"]);
    assert_eq!(on("5"), ["PA8", "PA9", "PA11", "PB0", "PB1"]);
    assert_eq!(on("6"), ["PA10", "PA12"]);
    assert_eq!(on("7"), ["PA13"]);
    assert_eq!(on("8"), ["PA14", "PA15", "PB5", "PB6"]);
}
