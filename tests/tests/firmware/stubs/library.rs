//! Every driver of the library and every example: wired, generated for board and hosts, and compiled.

use std::collections::BTreeSet;

use sensedsl_model::facts;
use sensedsl_tests::{files, is_thorough, one_in, read, root};

use super::super::facts::Folder;
use super::super::{chibios, tools::scratch};
use super::compiler::{Firmware, compile_all, is_here, macros_of};
use super::designs::{Made, make};

/// Names and texts of all designs: `drivers/bme280`, `examples/fig2` and so on.
pub(super) fn designs() -> Vec<(String, String)> {
    let parts = facts::all();
    let drivers = parts.iter().map(|part| (format!("drivers/{}", part.name), facts::example(part)));
    let examples = files(&root().join("examples"), "sense").into_iter().map(|path| {
        let name = path.file_stem().unwrap().to_string_lossy();
        (format!("examples/{name}"), read(&path))
    });
    drivers.chain(examples).collect()
}

/// A board of each family.
const BOARDS: [&str; 9] = [
    "NUCLEO_F446RE",
    "NUCLEO_F303RE",
    "NUCLEO_L476RG",
    "NUCLEO_F767ZI",
    "NUCLEO_G474RE",
    "NUCLEO_F103RB",
    "NUCLEO_F072RB",
    "NUCLEO_G071RB",
    "NUCLEO_H743ZI",
];

/// The firmware that is built with the real tree: all examples, and a driver of each kind, each on
/// a board of the next family that has firmware for it; every driver in a thorough run.
fn with_the_tree() -> Vec<(String, Vec<(String, Folder)>)> {
    let mut made = Vec::new();
    for (name, text) in designs() {
        let is_asked = name.starts_with("examples/") || is_thorough();
        if let (true, Made::Firmware(boards, _)) = (is_asked, make(&text)) {
            made.push((name, boards));
        }
    }
    let mut kinds = BTreeSet::new();
    let mut turn = 0;
    for part in facts::all() {
        if kinds.is_superset(&part.kinds.iter().copied().collect()) {
            continue;
        }
        let on = |board: &&str| match make(&facts::example_on(&part, board)) {
            Made::Firmware(boards, _) => Some((format!("{} on {board}", part.name), boards)),
            Made::NoWiring(_) | Made::Refused(_) => None,
        };
        if let Some(one) = BOARDS.iter().cycle().skip(turn).take(BOARDS.len()).find_map(on) {
            made.push(one);
            kinds.extend(part.kinds.iter().copied());
            turn += 1;
        }
    }
    made
}

#[test]
fn examples_and_a_driver_of_each_kind_build_with_the_tree() {
    let Some(tree) = chibios::tree() else { return };
    for (index, (name, boards)) in with_the_tree().into_iter().enumerate() {
        for (board, files) in boards {
            let folder = scratch(&format!("library-tree/{index}-{board}"));
            for (path, text) in files {
                let path = folder.join(path);
                std::fs::create_dir_all(path.parent().unwrap()).unwrap();
                std::fs::write(path, text).unwrap();
            }
            let size = chibios::build(&tree, &folder, "development");
            eprintln!("{name} {board}: text/data/bss {size}");
        }
    }
}

/// The board of the catalog that a board of a file is based on.
fn catalog_board<'a>(text: &'a str, board: &'a str) -> &'a str {
    let head = format!("board {board} on ");
    let rest = text.lines().find_map(|line| line.trim().strip_prefix(&head));
    rest.and_then(|rest| rest.split([' ', '{']).next()).unwrap_or(board)
}

/// The firmware of all boards of a design, ready for the compiler.
fn ready(name: &str, text: &str, boards: Vec<(String, Folder)>) -> Vec<Firmware> {
    let of_board = |(board, files): (String, _)| Firmware {
        title: format!("{name} {board}"),
        macros: macros_of(catalog_board(text, &board)),
        files,
    };
    boards.into_iter().map(of_board).collect()
}

#[test]
fn every_driver_and_every_example_has_firmware_and_hosts() {
    let (mut all, mut not_made, mut without_host) = (Vec::new(), Vec::new(), Vec::new());
    let designs = designs();
    for (name, text) in one_in(30, &designs) {
        match make(text) {
            Made::Firmware(boards, host_files) => {
                if host_files == 0 {
                    without_host.push(name);
                }
                all.extend(ready(name, text, boards));
            }
            Made::NoWiring(codes) | Made::Refused(codes) => {
                not_made.push(format!("{name} {}", codes.join(" ")));
            }
        }
    }
    assert!(not_made.is_empty(), "{not_made:#?}");
    assert!(without_host.is_empty(), "{without_host:?}");
    if is_here() {
        let (reported, read) = compile_all("library", &all);
        eprintln!("{} firmwares, {read} files read", all.len());
        assert!(reported.is_empty(), "{} of {}:\n{}", reported.len(), all.len(), reported.concat());
    }
    assert!(designs.len() > 100, "{}", designs.len());
}
