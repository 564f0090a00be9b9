//! The tables of all drivers on AVR: in program memory, and none of them in RAM.

use std::fmt::Write as _;

use sensedsl_firmware_c::{Wiring, tables};
use sensedsl_tests::has;

use super::library::{Unit, units};
use super::program::plan;
use crate::firmware::avr::{compile, in_ram};
use crate::firmware::tools::scratch;

const HEADERS: [&str; 6] = ["chip", "compose", "drive", "exchange", "filter", "ppm"];

/// The tables of a part. They are not `static`, so that the compiler keeps those that nothing uses.
fn text(unit: &Unit) -> Option<String> {
    let tables = tables(&plan(unit)?, Wiring::default());
    let mut text: String =
        HEADERS.iter().map(|name| format!("#include \"up_{name}.h\"\n")).collect();
    let names = unit.devices().map(|device| format!("SENSE_FIELD_{}", device.name.value));
    writeln!(text, "enum {{ {} }};", names.collect::<Vec<_>>().join(", ")).unwrap();
    text.push_str(&tables.replace("\nstatic ", "\n"));
    Some(text)
}

#[test]
fn tables_have_only_states_in_ram() {
    if !has("avr-gcc") {
        return;
    }
    let folder = scratch("avr-tables");
    let (source, object) = (folder.join("tables.c"), folder.join("tables.o"));
    let mut count = 0;
    for text in units().iter().filter_map(text) {
        std::fs::write(&source, &text).unwrap();
        compile(&source, &["-DUP_DMA_BUFFER="], &object);
        let found = in_ram(&object);
        assert!(!found.iter().any(|section| section.starts_with(".rodata")), "{found:?}\n{text}");
        count += 1;
    }
    assert!(count > 50, "{count}");
}
