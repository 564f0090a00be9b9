//! Tests that the manifests leave out to save time do not exist.

use std::fs;
use std::path::{Path, PathBuf};

use sensedsl_tests::{read, root};

/// All Rust files below a folder.
fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
        if entry.is_dir() {
            sources(&entry, found);
        } else if entry.extension().is_some_and(|end| end == "rs") {
            found.push(entry);
        }
    }
}

/// A library without tests in its sources is not compiled a second time for them, and one without
/// examples in its documentation is not searched for them. A library that has some must run them.
#[test]
fn tests_that_are_left_out_are_not_there() {
    let crates = fs::read_dir(root().join("crates")).unwrap();
    let crates = crates.map(|entry| entry.unwrap().path());
    let (mut untested, mut undocumented) = (0, 0);
    for folder in crates.chain([root().join("tests"), root().join("tests/fuzz")]) {
        let manifest = read(&folder.join("Cargo.toml"));
        let leaves_out =
            |what: &str| manifest.lines().any(|line| line == format!("{what} = false"));
        let mut files = Vec::new();
        sources(&folder.join("src"), &mut files);
        let has = |signs: &[&str]| {
            let line = |line: &str| signs.iter().any(|sign| line.trim_start().starts_with(sign));
            files.iter().find(|file| read(file).lines().any(line)).cloned()
        };
        if leaves_out("test") {
            assert_eq!(has(&["#[test]", "proptest!"]), None, "{}", folder.display());
            untested += 1;
        }
        if leaves_out("doctest") {
            assert_eq!(has(&["/// ```", "//! ```"]), None, "{}", folder.display());
            undocumented += 1;
        }
    }
    assert!(untested >= 6 && undocumented >= 3, "{untested} {undocumented}");
}
