//! The shipped table: what is in it, and wirings on it.
#![allow(clippy::unwrap_used, clippy::panic, clippy::indexing_slicing, reason = "a test may panic")]

use std::collections::BTreeSet;
use std::io;

use sensedsl_board::remap::Blocks;
use sensedsl_board::table;
use sensedsl_model::{Files, Request, resolve};
use sensedsl_parts::{all, find, nearest_name, packed_bytes};
use sensedsl_wiring::{Solved, Wiring};

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

/// A part's number leads to itself, and its table reads as its pins without a warning.
#[test]
fn every_part_is_a_table() {
    for part in all() {
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

struct NoFiles;

impl Files for NoFiles {
    fn read(&self, _: &str) -> Result<String, String> {
        Err(io::ErrorKind::NotFound.to_string())
    }
}

/// The cost of the best wiring of devices on the pins of a part; none where there is none.
fn cost(part: &str, devices: &str) -> Option<u32> {
    let mut text = format!("board X on {part} {{\n");
    for (id, device) in (1..).zip(devices.split(';').map(str::trim)) {
        let (kind, rest) = device.split_once(' ').unwrap_or((device, ""));
        let extra = match kind {
            "i2c" => format!("address = {}; register = 0;", 0x10 + id),
            "uart" => "start = 0x0A; length = 4;".to_owned(),
            "spi" => "read = [0x80]; length = 2;".to_owned(),
            "can" => format!("bitrate = 500 kHz; frame = {id};"),
            _ => String::new(),
        };
        let pins: String =
            rest.split(' ').filter(|s| !s.is_empty()).map(|s| format!("{s}; ")).collect();
        let head = match kind {
            "pwm" => format!("actuator D{id} accepts uint16"),
            "digital" => format!("sensor D{id} returns bool"),
            _ => format!("sensor D{id} returns uint16"),
        };
        text.push_str(&format!("{head} {{ id = {id}; type = {kind}; {extra} {pins} }}\n"));
    }
    text.push_str("}\n");
    let request = Request { path: "x.sense", text: &text, board: None, target: Some("none") };
    let resolved = resolve(&request, &NoFiles);
    let design = resolved.design.unwrap_or_else(|| panic!("{text}{:#?}", resolved.diagnostics));
    match Wiring::new(&design, None).solve_only(false) {
        Solved::Wired(wiring) => {
            // No two pins in use are on one contact.
            let board = &design.boards[0];
            let wires = wiring.boards[0].devices.iter().flat_map(|device| &device.wires);
            let pins: BTreeSet<usize> = wires.map(|wire| wire.pin).collect();
            let places: Vec<&String> =
                pins.iter().filter_map(|pin| board.table.pins[*pin].position.as_ref()).collect();
            assert_eq!(places.iter().collect::<BTreeSet<_>>().len(), places.len(), "{text}");
            Some(wiring.cost)
        }
        Solved::Infeasible(_) => None,
        Solved::Failed(why) => panic!("{why:?}"),
    }
}

#[test]
fn requests_that_a_package_decides() {
    // I2C2 is on PB10 and PB11, and on 48 pins USART3 is nowhere else.
    assert_eq!(cost("STM32F103C8", "i2c unit=I2C2; uart unit=USART3"), None);
    assert!(cost("STM32F103C8", "i2c unit=I2C2").is_some());
    assert!(cost("STM32F103C8", "uart unit=USART3").is_some());
    assert!(cost("STM32F103R8", "i2c unit=I2C2; uart unit=USART3").is_some());
    // The CAN controller of the 36-pin part is on the USB pins alone.
    let usb = "digital pin=PA11; digital pin=PA12";
    assert_eq!(cost("STM32F103T8", &format!("{usb}; can")), None);
    assert!(cost("STM32F103T8", "can").is_some());
    assert!(cost("STM32F103C8", &format!("{usb}; can")).is_some());
    // Two signals on one contact of eight.
    assert_eq!(cost("STM32G031J6", "digital pin=PB7; digital pin=PB8"), None);
    assert!(cost("STM32G031K6", "digital pin=PB7; digital pin=PB8").is_some());
    assert_eq!(cost("STM32G031J6", "i2c scl=PB8 sda=PB9"), None);
    assert!(cost("STM32G031K6", "i2c scl=PB8 sda=PB9").is_some());
    // Six contacts beside the supply carry six wires and not seven.
    assert!(cost("STM32G031J6", &["digital"; 6].join("; ")).is_some());
    assert_eq!(cost("STM32G031J6", &["digital"; 7].join("; ")), None);
    // One SPI and one GPIO need five contacts with the select line.
    assert!(cost("STM32G031J6", "spi").is_some());
}

/// The cost by looking at all ways, for requests with few of them.
#[test]
fn the_cost_is_that_of_all_ways() {
    for part in ["STM32G031J6", "STM32C011J6", "STM32F042F6", "STM32F103T8", "STM32L011F4"] {
        assert_eq!(cost(part, "analog; i2c"), by_hand(part), "{part}");
    }
}

/// The least cost of an ADC input and an I2C bus on three contacts.
fn by_hand(part: &str) -> Option<u32> {
    let found = find(part)?;
    let pins: Vec<_> = found.sheet.pins().collect();
    let named = |at: usize, name: &str| {
        let mut usages = pins[at].2.iter().map(|(usage, _)| Blocks::split(usage));
        usages.find(|(usage, _)| *usage == name).map(|(_, blocks)| blocks)
    };
    let has = |at: usize, name: &str| named(at, name).is_some();
    let in_one_block = |one: Option<Option<Blocks>>, other: Option<Option<Blocks>>| {
        let both = one.flatten().zip(other.flatten());
        both.is_none_or(|(one, other)| one.and(other).is_some())
    };
    let cost = |at: usize| u32::try_from(pins[at].2.len()).unwrap();
    let apart = |a: usize, b: usize| a != b && (pins[a].1.is_none() || pins[a].1 != pins[b].1);
    let is_input = |at: usize| {
        let input = |usage: &str| {
            let line = usage.strip_prefix("ADC").and_then(|rest| rest.split_once('_'));
            line.is_some_and(|(_, line)| line.starts_with("IN") && !line.starts_with("INN"))
        };
        pins[at].2.iter().any(|(usage, _)| input(usage))
    };
    let mut best = None;
    for unit in 1..=4 {
        let (scl, sda) = (format!("I2C{unit}_SCL"), format!("I2C{unit}_SDA"));
        for a in (0..pins.len()).filter(|at| has(*at, &scl)) {
            for b in (0..pins.len()).filter(|at| has(*at, &sda) && apart(a, *at)) {
                if !in_one_block(named(a, &scl), named(b, &sda)) {
                    continue;
                }
                for c in (0..pins.len()).filter(|at| is_input(*at)) {
                    if apart(a, c) && apart(b, c) {
                        let sum = cost(a) + cost(b) + cost(c);
                        best = Some(best.map_or(sum, |best: u32| best.min(sum)));
                    }
                }
            }
        }
    }
    best
}
