//! Images for every MCU that has a model, and development builds, judged through the command that
//! users run: `simulate --firmware IMAGE --judge`.
//!
//! A third runs with `SENSEDSL_THOROUGH=2`, all with `SENSEDSL_THOROUGH=3`: it builds and runs dozens of programs.

use sensedsl_tests::is_exhaustive;

use super::bench::folder;
use super::examples::{USB, on_board, on_discovery};
use super::images::{EXAMPLES, alarm_of, judge_all};
use super::trial::System;
use crate::false_alarms::is_wired;
use crate::firmware::chibios::{build, tree};

/// Boards that each have an MCU other than the F407.
const BOARDS: [&str; 9] = [
    "BLACKPILL_F401CC",
    "BLACKPILL_F411CE",
    "BLUEPILL_F103C8",
    "NUCLEO_F103RB",
    "NUCLEO_F401RE",
    "NUCLEO_F412ZG",
    "NUCLEO_F429ZI",
    "NUCLEO_F446RE",
    "NUCLEO_G474RE",
];
/// Devices of most kinds that the smallest of these boards can carry.
const SMALL: &str = "{
    sensor Light returns uint16 { type = analog; }
    sensor Range returns uint16 { driver = srf08; address = 0x70; }
    sensor Wheel returns int32 { type = encoder; }
    sensor Stick returns uint32 { type = icu; mode = width; }
    sensor Touch returns bool { type = digital; debounce = 5 ms; }
    sensor Gyro returns uint16 { type = spi; read = [0]; length = 2; }
    sensor Place returns uint16 { type = uart; length = 2; }
    actuator Servo accepts uint16 { type = pwm; frequency = 50 Hz; }
    actuator Relay accepts bool { type = digital; }
}
";
/// The minimum number of programs that must be judged.
const IMAGES_MIN: usize = 30;

/// The designs that a board can carry, over its own default link, with their names.
fn designs(board: &str, target: &str) -> Vec<(String, String)> {
    let examples = EXAMPLES.iter().map(|example| on_board(example, board, ""));
    let all = std::iter::once(format!("board {board} {SMALL}")).chain(examples);
    let wired = all.filter(|text| is_wired(text, target)).enumerate();
    wired.map(|(place, text)| (format!("mcus_{board}_{place}"), text)).collect()
}

#[test]
fn images_of_all_mcus_agree_with_the_world() {
    if !is_exhaustive() {
        return;
    }
    judge_all(IMAGES_MIN, |target| {
        BOARDS.iter().flat_map(|board| designs(board, target)).collect()
    });
}

/// A shell has the link until a host sends a request, including a host that closes its port and
/// opens it again.
#[test]
fn development_builds_agree_with_the_world() {
    let Some(tree) = tree().filter(|_| is_exhaustive()) else { return };
    for example in ["all_kinds", "fig2"] {
        let (name, text) = (format!("development_{example}"), on_discovery(example, USB));
        let board = folder(&name, &text);
        build(&tree, &board, "development");
        let image = std::fs::read(board.join("build/development/sense.elf")).unwrap();
        assert_eq!(alarm_of(System::Chibios, &name, &text, &image), None);
    }
}
