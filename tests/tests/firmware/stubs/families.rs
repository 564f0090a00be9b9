//! Every family of MCUs with every kind, and with combinations that no design of a single kind has.

use std::collections::BTreeSet;

use sensedsl_board::catalog;
use sensedsl_tests::{files, is_exhaustive, is_thorough, one_in, read, root};

use super::compiler::{Firmware, compile_all, is_here, macros_of, profile_of};
use super::designs::{Made, make};

/// The designs that are not generated for the first board of each family, with their codes: the MCU
/// lacks the unit or the board lacks the pins (E0401), the MCU's clocks do not fit (E0620), or its
/// link is not available (E0504).
const NOT_MADE: [&str; 11] = [
    "BLACKPILL_F401CC kinds/can E0401",
    "BLACKPILL_F401CC kinds/dac E0401",
    "BLUEPILL_F103C8 kinds/can E0401",
    "BLUEPILL_F103C8 kinds/dac E0401",
    "NUCLEO_F030R8 kinds/can E0401",
    "NUCLEO_F030R8 kinds/dac E0401",
    "NUCLEO_F030R8 mixed/motors E0401",
    "NUCLEO_F030R8 mixed/usb E0504",
    "NUCLEO_G0B1RE kinds/can E0401",
    "NUCLEO_H7A3ZI_Q mixed/chips E0620",
    "NUCLEO_H7A3ZI_Q mixed/usb E0504",
];

/// A board of each family and of each choice of drivers in it: the first in the catalog, or all in
/// a thorough run.
fn boards() -> Vec<String> {
    let mut seen = BTreeSet::new();
    let mut boards = Vec::new();
    for entry in catalog::all() {
        let Some(profile) = profile_of(entry.mcu) else { continue };
        if entry.board().is_ok_and(|board| board.system.contains_key("chibios")) {
            let name = entry.name.replace('-', "_");
            let mut drivers = macros_of(&name);
            drivers.retain(|one| one.starts_with("-DSTUB_"));
            if is_exhaustive() || seen.insert((profile.family.clone(), drivers)) {
                boards.push(name);
            }
        }
    }
    boards
}

/// The designs, with the names of their files.
fn designs() -> Vec<(String, String)> {
    let mut designs = Vec::new();
    for folder in ["kinds", "mixed"] {
        for path in files(&root().join("tests/firmware").join(folder), "sense") {
            let name = path.file_stem().unwrap().to_string_lossy().into_owned();
            designs.push((format!("{folder}/{name}"), read(&path)));
        }
    }
    designs
}

#[test]
fn every_family_and_kind_compiles_with_the_stubs() {
    if !is_here() {
        return;
    }
    let designs = designs();
    let (mut all, mut not_made) = (Vec::new(), Vec::new());
    for (number, name) in one_in(2, boards().into_iter().enumerate()) {
        let macros = macros_of(&name);
        // Each design on a few of the boards in a quick run.
        let from = if is_thorough() { 0 } else { number % 15 };
        for (design, text) in one_in(40, designs.iter().skip(from)) {
            let title = format!("{name} {design}");
            match make(&text.replace("BOARD", &name)) {
                Made::Firmware(boards, _) => {
                    let of_board = |(_, files)| Firmware {
                        title: title.clone(),
                        macros: macros.clone(),
                        files,
                    };
                    all.extend(boards.into_iter().map(of_board));
                }
                Made::NoWiring(codes) | Made::Refused(codes) => {
                    not_made.push(format!("{title} {}", codes.join(" ")));
                }
            }
        }
    }
    let (reported, read) = compile_all("families", &all);
    eprintln!("{} firmwares, {read} files read", all.len());
    assert!(reported.is_empty(), "{} of {}:\n{}", reported.len(), all.len(), reported.concat());
    if is_thorough() && !is_exhaustive() {
        assert_eq!(not_made, NOT_MADE);
    }
    let least = if is_thorough() { 140 } else { 4 };
    assert!(all.len() >= least && read >= least * 3, "{} firmwares, {read} files", all.len());
}
