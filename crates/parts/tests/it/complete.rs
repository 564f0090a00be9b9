//! Tables without usages: what they get from their MCU, and what is reported if they get none.

use sensedsl_board::pin::PinName;
use sensedsl_board::{catalog, table};
use sensedsl_model::Resolved;
use sensedsl_parts::{Completion, complete, find};
use sensedsl_wiring::{Solved, Wiring};

use super::designs;

const ONE_ANALOG: &str = "board Own on \"own.csv\" {
    sensor Light returns uint16 { id = 1; type = analog; }
}";

fn resolved(table: &'static str) -> Resolved {
    designs::resolved(ONE_ANALOG, Some("none"), Some(table))
}

fn codes(table: &'static str) -> Vec<&'static str> {
    resolved(table).diagnostics.iter().map(|diagnostic| diagnostic.code.name()).collect()
}

/// The pin of the only device.
fn wired(table: &'static str) -> String {
    let resolved = resolved(table);
    let design = resolved.design.unwrap();
    let Solved::Wired(wiring) = Wiring::new(&design, None).solve_only(false) else {
        panic!("{:?}", resolved.diagnostics)
    };
    let wire = &wiring.boards[0].devices[0].wires[0];
    wire.pin(&design.boards[0]).unwrap().name.to_string()
}

#[test]
fn usages_come_from_the_part() {
    let text =
        "# mcu = STM32F407VGT6\nPin,Header,Position,Onboard\nPA0,P1,12,\nPB6,P2,3,Codec:bus\n";
    let mut found = table::load(text).board;
    assert!(
        matches!(complete(&mut found), Completion::Part { strangers, .. } if strangers.is_empty())
    );
    let own = table::load(&find("STM32F407VGT6").unwrap().csv()).board;
    for pin in &found.pins {
        let of_part = own.pin(&pin.name).unwrap();
        let signals = |pin: &table::Pin| -> Vec<_> {
            pin.usages.iter().map(|usage| (usage.signal.clone(), usage.alternate)).collect()
        };
        assert_eq!(signals(pin), signals(of_part), "{}", pin.name);
        assert!(pin.usages.iter().all(|usage| usage.range == pin.range));
    }
    assert_eq!(found.pins[0].position_at("P1"), Some("12"));
    // The printed table has the same content.
    let printed = table::load(&found.to_csv());
    assert_eq!(printed.findings, []);
    let usages = |table: &table::Table| -> Vec<_> {
        table.pins.iter().map(|pin| (pin.name.clone(), pin.cost(), pin.onboard.clone())).collect()
    };
    assert_eq!(usages(&printed.board), usages(&found));
}

#[test]
fn one_column_of_usages_is_the_whole_truth() {
    let mut own = table::load("# mcu = STM32F407VGT6\nPin,ADC\nPA0,-\nPA1,ADC123_IN1\n").board;
    assert_eq!(complete(&mut own), Completion::Own);
    assert_eq!(own.pins[0].cost(), 0);
    assert_eq!(wired("# mcu = STM32F407VGT6\nPin,ADC\nPA0,-\nPA1,ADC123_IN1\n"), "PA1");
}

#[test]
fn a_table_of_pins_is_wired() {
    assert_eq!(codes("# mcu = STM32F407VGT6\nPin,Onboard\nPC4,\nPC5,LED\n"), [""; 0]);
    assert_eq!(wired("# mcu = STM32F407VGT6\nPin,Onboard\nPC4,\nPC5,LED\n"), "PC4");
}

#[test]
fn pins_on_one_contact_exclude_each_other() {
    let mut small = table::load("# mcu = STM32G031J6M6\nPin\nPA11\nPB0\nPA13\n").board;
    assert!(matches!(complete(&mut small), Completion::Part { .. }));
    let place = |name: &str| small.pin(&PinName::parse(name).unwrap()).unwrap().package_position();
    assert_eq!(place("PA11"), place("PB0"));
    assert!(place("PB0").is_some());
    assert_eq!(place("PA13"), None, "alone on its contact");
}

#[test]
fn what_is_not_known_is_told() {
    assert_eq!(codes("# mcu = STM32F407VGT6\nPin\nPC4\nPZ9\n"), ["W0608"]);
    assert_eq!(codes("# mcu = PIC16F84\nPin\nRA1\n")[0], "W0608");
    assert_eq!(codes("Pin\nPC4\n")[0], "W0608");
    // The part number is not complete, and packages differ.
    assert!(codes("# mcu = STM32WBA65\nPin\nPA1\n").contains(&"W0608"));
}

#[test]
fn boards_take_their_usages_from_their_part() {
    let short = catalog::all().iter().filter(|entry| {
        let mut table = entry.table();
        matches!(complete(&mut table), Completion::Part { .. })
    });
    assert!(short.count() >= 1);
}
