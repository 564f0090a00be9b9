//! The core with less in it: what a program leaves out changes nothing of what is left.

use std::path::{Path, PathBuf};
use std::process::Command;

use sensedsl_tests::{files, has, is_thorough, printed, root, run};

use super::avr;
use super::core::sources;
use super::tools::scratch;

/// Values of at most 32 bits.
const NARROW: [&str; 2] = ["WIDE", "REALS"];
/// And nothing that such values, one chip with one triggered transfer and a host that only asks do
/// without.
const LEAST: [&str; 18] = [
    "CODES",
    "WORD_BITS",
    "WORD_CRC",
    "LAMPS",
    "LETTERS",
    "MEDIAN",
    "SMOOTH",
    "CHANGE",
    "CAPTURE_TIMES",
    "COMMANDS",
    "CHIP_INIT",
    "CHIP_IDENTITY",
    "CHIP_READS",
    "CHIP_TURNS",
    "CHIP_FORMULAS",
    "CHIP_COMMANDS",
    "CHIP_EXCHANGES",
    "CRC32",
];
/// What a program may say of itself besides.
const KNOWN: [&str; 5] = [
    "-DUP_REPORTER_CONFIG=config",
    "-DUP_DECODER_WIRE=commands",
    "-DUP_WIRE_MEMO=0",
    "-DUP_WIRE_STAMPS=0",
    "-DUP_WIRE_BOOLS=0",
];

fn without(parts: &[&str]) -> Vec<String> {
    parts.iter().map(|part| format!("-DUP_USES_{part}=0")).collect()
}

/// Compiles the program with the core.
fn program(command: &mut Command, flags: &[String], output: &Path) {
    let folder = root().join("tests/firmware/avr");
    let is_own = |path: &PathBuf| path.file_name().unwrap().to_string_lossy().starts_with("less");
    command.args(["-Wall", "-Wextra", "-Werror", "-I"]);
    command.arg(root().join("crates/firmware-c/runtime")).args(flags);
    command.args(files(&folder, "c").into_iter().filter(is_own)).args(sources());
    run(command.arg("-o").arg(output));
}

/// What the program says on this computer.
fn said(flags: &[String]) -> String {
    let output = scratch("less").join("own");
    let mut command = Command::new("gcc");
    command.args(["-std=c99", "-Wpedantic", "-Wconversion", "-O1"]);
    program(&mut command, flags, &output);
    printed(&mut Command::new(output))
}

#[test]
fn what_is_left_out_changes_nothing() {
    if !has("gcc") {
        return;
    }
    // Each takes four programs.
    let links = if is_thorough() { &["CRC16", "NONE", "CRC32"][..] } else { &["CRC16"] };
    for &link in links {
        let all = vec![format!("-DLINK=UP_LINK_{link}")];
        let whole = said(&all);
        assert!(whole.lines().count() >= 40, "{whole}");
        assert_eq!(said(&[all.clone(), without(&NARROW)].concat()), whole, "{link}");
        let least = [all, vec!["-DLEAST".to_owned()]].concat();
        let whole = said(&least);
        assert!(whole.lines().count() >= 30, "{whole}");
        let left_out = LEAST.iter().filter(|part| (link, **part) != ("CRC32", "CRC32"));
        let left_out: Vec<&str> = left_out.chain(&NARROW).copied().collect();
        let known = KNOWN.map(str::to_owned).to_vec();
        assert_eq!(said(&[least, without(&left_out), known].concat()), whole, "{link}");
    }
}

/// On AVR the widest type is as wide as a long, and an int has 16 bits.
#[test]
fn a_simulated_avr_makes_the_same_of_narrow_values() {
    if !has("gcc") || !has("avr-gcc") || !avr::has_simavr() {
        return;
    }
    let short = vec!["-DUP_SHORT_COUNTS=1".to_owned()];
    let whole = said(&short);
    let output = scratch("less-avr").join("less.elf");
    let machine = format!("-mmcu={}", avr::LARGE);
    let mut command = Command::new("avr-gcc");
    command.args(avr::STRICT).arg(machine);
    command.args(["-flto", "-ffunction-sections", "-fdata-sections", "-Wl,--gc-sections"]);
    program(&mut command, &[short, without(&NARROW)].concat(), &output);
    assert_eq!(avr::simulated(&output), whole);
}
