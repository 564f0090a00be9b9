//! Generated applications, built with the user's ChibiOS tree: our files must not give any warning.

use std::path::{Path, PathBuf};
use std::process::Command;

use sensedsl_tests::{has, printed, run, write_all};

use super::applications::{self, CAR, FIG2, ODD, PINS, TWO};
use super::tools::scratch;

/// The tree, if the machine has one. No registry has ChibiOS, so its absence is not a failure.
pub(crate) fn tree() -> Option<PathBuf> {
    let Ok(tree) = std::env::var("CHIBIOS") else {
        eprintln!("SKIPPED: CHIBIOS names no ChibiOS tree, generated firmware is not built");
        return None;
    };
    (has("make") && has("arm-none-eabi-gcc")).then(|| PathBuf::from(tree))
}

pub(crate) fn write(name: &str, text: &str) -> PathBuf {
    let folder = scratch(name);
    write_all(&folder, applications::files(text));
    folder
}

/// Builds one board and returns the output of `size`.
pub(crate) fn build(tree: &Path, board: &Path, mode: &str) -> String {
    let mut make = Command::new("make");
    make.current_dir(board).arg("-j2").arg(format!("UP_MODE={mode}"));
    let output = run(make.arg(format!("CHIBIOS={}", tree.display())));
    let log = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(!log.contains("warning"), "{log}");
    let program = board.join("build").join(mode).join("sense.elf");
    let size = printed(Command::new("arm-none-eabi-size").arg(program));
    let line = size.lines().nth(1).unwrap_or_default().split_whitespace();
    line.take(3).collect::<Vec<_>>().join("/")
}

fn builds(name: &str, text: &str, boards: &[&str]) {
    let Some(tree) = tree() else { return };
    let folder = write(name, text);
    for board in boards {
        for mode in ["development", "production"] {
            let size = build(&tree, &folder.join(board), mode);
            eprintln!("{name}/{board} {mode}: text/data/bss {size}");
        }
    }
}

#[test]
fn fig2_builds() {
    builds("fig2", FIG2, &["STM32F4DiscoveryBoard"]);
}

#[test]
fn the_car_builds() {
    builds("car", CAR, &["STM32F4DiscoveryBoard"]);
}

#[test]
fn words_of_c_as_names_and_every_property_build() {
    builds("odd", ODD, &["Odd"]);
}

#[test]
fn two_boards_build() {
    builds("two", TWO, &["Front", "Rear"]);
}

#[test]
fn timers_and_pins_build() {
    builds("pins", PINS, &["Pins"]);
}

/// The guards stop the build for a tree that differs from what the wiring was made for.
#[test]
fn guards_stop_a_tree_that_does_not_fit() {
    let Some(tree) = tree() else { return };
    let breakages = [
        ("STM32_DMA_STREAM_ID(1, 4)", "STM32_DMA_STREAM_ID(1, 2)", "one DMA stream"),
        (
            "#define STM32_ICU_USE_TIM3",
            "#undef STM32_PLLN_VALUE\n#define STM32_PLLN_VALUE 330\n#define STM32_ICU_USE_TIM3",
            "STM32_TIMCLK1 is not",
        ),
    ];
    for (original, broken, message) in breakages {
        let board = write("guards", FIG2).join("STM32F4DiscoveryBoard");
        let path = board.join("cfg/mcuconf.h");
        let text = std::fs::read_to_string(&path).unwrap();
        assert!(text.contains(original), "{text}");
        std::fs::write(&path, text.replacen(original, broken, 1)).unwrap();
        let mut make = Command::new("make");
        make.current_dir(&board).arg("-k").arg(format!("CHIBIOS={}", tree.display()));
        let output = make.arg("./build/development/obj/sense_hw.o").output().unwrap();
        let log = String::from_utf8_lossy(&output.stderr);
        assert!(!output.status.success() && log.contains(message), "{log}");
    }
}
