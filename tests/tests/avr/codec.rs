//! The generated codec beside one that is written by hand for the same report: the same bytes, and how large both are.

use std::path::{Path, PathBuf};
use std::process::Command;

use sensedsl_firmware_arduino::Arduino;
use sensedsl_job::Target as _;
use sensedsl_tests::{printed, root, run, text};

use super::tools::is_possible;
use crate::embassy::with_job;
use crate::firmware::tools::empty;

/// The generated codec may be larger by this much, in per cent.
const MORE_PERCENT: u32 = 20;

/// The generated model of Fig. 2 on an Uno, with the core.
fn generated(folder: &Path) -> Vec<PathBuf> {
    let text =
        text("examples/fig2.sense").replacen("board ", "board Car on ARDUINO_UNO_R3 { //", 1);
    with_job(&text, None, |job| {
        for (path, file) in Arduino.generate(job).unwrap().iter() {
            if let Some(name) = path.strip_prefix("src/").filter(|name| !name.contains('/')) {
                std::fs::write(folder.join(name), &file.bytes).unwrap();
            }
        }
    });
    ["sense_codec.c", "sense_model.c", "up_encode.c", "up_schema.c", "up_wire.c"]
        .map(|name| folder.join(name))
        .into()
}

fn compile(compiler: &str, how: &str, folder: &Path, sources: &[PathBuf]) -> PathBuf {
    let program = folder.join(format!("{compiler}-{how}"));
    let mut command = Command::new(compiler);
    command.args(["-std=gnu11", "-Os", "-flto", "-ffunction-sections", "-fdata-sections"]);
    command.args(["-Wl,--gc-sections", "-Wall", "-Wextra", "-Werror", "-DARDUINO=10819"]);
    if compiler == "avr-gcc" {
        command.arg("-mmcu=atmega328p");
    }
    command.arg(format!("-D{how}")).arg("-I").arg(folder);
    command.arg(root().join("tests/avr/programs/codec.c"));
    run(command.args(sources).arg("-o").arg(&program));
    program
}

#[test]
fn the_codec_is_about_as_small_as_one_written_by_hand() {
    if !is_possible() {
        return;
    }
    let folder = empty("avr-codec");
    let sources = generated(&folder);
    let flash = |how: &str, sources: &[PathBuf]| {
        let program = compile("avr-gcc", how, &folder, sources);
        let sizes = printed(Command::new("avr-size").arg(&program));
        let words = sizes.lines().nth(1).unwrap().split_whitespace();
        let sizes: Vec<u32> = words.filter_map(|word| word.parse().ok()).collect();
        sizes[0] + sizes[1]
    };
    let without = flash("NOTHING", &[]);
    let [made, by_hand] =
        [flash("GENERATED", &sources), flash("BY_HAND", &[])].map(|bytes| bytes - without);
    println!("codec of Fig. 2: {made} bytes of flash, {by_hand} by hand");
    assert!(made * 100 <= by_hand * (100 + MORE_PERCENT), "{made} bytes, {by_hand} by hand");
    let said = |how: &str, sources: &[PathBuf]| {
        printed(&mut Command::new(compile("cc", how, &folder, sources)))
    };
    assert_eq!(said("GENERATED", &sources), said("BY_HAND", &[]));
}
