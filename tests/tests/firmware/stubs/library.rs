//! Every driver of the library and every example: wired, generated for board and hosts, and compiled.

use sensedsl_model::facts::{self, EXAMPLE_BOARD};
use sensedsl_tests::{files, read};

use super::super::facts::Folder;
use super::super::tools::root;
use super::compiler::{Firmware, compile_all, is_here, macros_of};
use super::designs::{Made, make};

/// What no firmware is made of on the board of the examples, with its codes; and a board that it is made for. Both
/// devices invert their wires, which the serial ports of STM32F4 cannot.
const NOT_MADE: [(&str, &str); 2] =
    [("drivers/sbus E0506", "NUCLEO_F303K8"), ("drivers/maxsonar_serial E0506", "NUCLEO_F303K8")];

/// Name and text of what there is: `drivers/bme280`, `examples/fig2`.
pub(super) fn designs() -> Vec<(String, String)> {
    let parts = facts::all();
    let drivers = parts.iter().map(|part| (format!("drivers/{}", part.name), facts::example(part)));
    let examples = files(&root().join("examples"), "sense").into_iter().map(|path| {
        let name = path.file_stem().unwrap().to_string_lossy();
        (format!("examples/{name}"), read(&path))
    });
    drivers.chain(examples).collect()
}

/// The board of the catalog that a board of a file stands on.
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
    for (name, text) in &designs {
        match make(text) {
            Made::Firmware(boards, host_files) => {
                if host_files == 0 {
                    without_host.push(name);
                }
                all.extend(ready(name, text, boards));
            }
            Made::NoWiring(codes) | Made::Refused(codes) => {
                let what = format!("{name} {}", codes.join(" "));
                if let Some((_, board)) = NOT_MADE.iter().find(|(listed, _)| *listed == what) {
                    let text = text.replace(EXAMPLE_BOARD, board);
                    let Made::Firmware(boards, _) = make(&text) else {
                        panic!("{name} has no firmware on {board} either")
                    };
                    all.extend(ready(name, &text, boards));
                }
                not_made.push(what);
            }
        }
    }
    let listed: Vec<&str> = NOT_MADE.iter().map(|(what, _)| *what).collect();
    assert_eq!(not_made, listed, "what has no firmware");
    assert!(without_host.is_empty(), "{without_host:?}");
    if is_here() {
        let (said, read) = compile_all("library", &all);
        eprintln!("{} firmwares, {read} files read", all.len());
        assert!(said.is_empty(), "{} of {}:\n{}", said.len(), all.len(), said.concat());
    }
    assert!(designs.len() > 100, "{}", designs.len());
}
