//! Everything that `generate` writes for a few designs, byte for byte, as reviewed and accepted.
//!
//! The runtimes' own files are copied unchanged and left out here. So are lock files, which a table
//! determines. Content that is in a tree several times is stored once; `same.txt` lists the other
//! places. After an intended change: run `cargo xtask bless`, and read the difference.

use std::collections::BTreeMap;

use sensedsl_tests::{TempDir, assert_tree, sensedsl, tree};

/// Whether a file is the same for all designs.
fn is_runtime(path: &str) -> bool {
    let folders = [
        "/uproxy/",
        "/include/sensedsl/",
        "/include/sensedsl.",
        "/src/sensedsl/",
        "/src/sensedsl.",
        "/_sensedsl/",
        "/sense-embassy/src/",
        "/sense-rt/src/",
        "/sensedsl-host/",
        "/sensedsl-wire/",
        "host/c/sensedsl.",
        "host/matlab/read_record.m",
    ];
    folders.iter().any(|folder| path.contains(folder)) || path.ends_with("/Cargo.lock")
}

/// Removes files whose content is already in the tree, and lists them.
fn once(files: &mut BTreeMap<String, Vec<u8>>) {
    let mut first: BTreeMap<Vec<u8>, String> = BTreeMap::new();
    let mut same = String::new();
    files.retain(|path, bytes| match first.get(bytes) {
        Some(other) => {
            same.push_str(&format!("{path} = {other}\n"));
            false
        }
        None => {
            first.insert(bytes.clone(), path.clone());
            true
        }
    });
    if !same.is_empty() {
        files.insert("same.txt".to_owned(), same.into_bytes());
    }
}

fn generated(file: &str, arguments: &[&str]) -> BTreeMap<String, Vec<u8>> {
    let scratch = TempDir::new("golden");
    let call = sensedsl(["generate", file, "-q", "-o"]).arg(scratch.join("out")).args(arguments);
    let _ = call.run().exits(0);
    let mut files = tree(&scratch.join("out"));
    files.retain(|path, _| !is_runtime(path));
    // The SHA-256 values of the list only repeat what the files contain.
    if let Some(list) = files.get_mut(".sensedsl-files") {
        let text = String::from_utf8_lossy(list).into_owned();
        let name = |line: &str| match line.split_once("  ") {
            Some((digest, name)) if digest.len() == 64 => format!("{name}\n"),
            _ => format!("{line}\n"),
        };
        *list = text.lines().map(name).collect::<String>().into_bytes();
    }
    files
}

/// Compares the output for `folder/example.sense` with the tree of that name.
fn agrees(folder: &str, example: &str, arguments: &[&str]) {
    agrees_as(example, &format!("{folder}/{example}.sense"), arguments);
}

/// Compares the output for a file with the tree named `example`.
fn agrees_as(example: &str, file: &str, arguments: &[&str]) {
    let mut files = generated(file, arguments);
    once(&mut files);
    assert_tree(&format!("tests/golden/{example}"), &files);
}

#[test]
fn fig2() {
    agrees("examples", "fig2", &[]);
}

#[test]
fn miniature_car() {
    agrees("examples", "miniature_car", &[]);
}

#[test]
fn curves() {
    agrees("tests/hosts", "curves", &["--without", "firmware"]);
}

#[test]
fn embassy_stm32() {
    let arguments = ["--target", "embassy", "--without", "host"];
    agrees_as("embassy_stm32", "examples/all_kinds.sense", &arguments);
}

#[test]
fn embassy_rp() {
    agrees_as("embassy_rp", "tests/firmware/embassy/pico.sense", &["--without", "host"]);
}

#[test]
fn embassy_esp() {
    agrees_as("embassy_esp", "tests/firmware/embassy/esp32c6.sense", &["--without", "host"]);
}

#[test]
fn embassy_nrf() {
    agrees_as("embassy_nrf", "tests/firmware/embassy/nrf52840.sense", &["--without", "host"]);
}
