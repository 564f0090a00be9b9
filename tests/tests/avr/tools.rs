//! What the boards are made with: the emulator, programs for the C library, sketches for the Arduino core.

use std::path::{Path, PathBuf};
use std::process::Command;

use sensedsl_tests::{compiled_once, files, has, missing, root, run};

use crate::firmware::tools::empty;

const HEADERS: &str = "/usr/include/simavr/sim_avr.h";
pub(super) const CORE: &str = "/usr/share/arduino/hardware/arduino/avr";
const FLAGS: [&str; 5] =
    ["-Os", "-ffunction-sections", "-fdata-sections", "-flto", "-DF_CPU=16000000UL"];

fn folder() -> PathBuf {
    root().join("tests/avr")
}

/// Whether programs for an AVR can be compiled and run here.
pub(super) fn is_possible() -> bool {
    if !Path::new(HEADERS).exists() {
        missing("libsimavr-dev");
        return false;
    }
    has("cc") && has("avr-gcc")
}

/// Whether sketches can be compiled as well.
pub(super) fn can_compile_sketches() -> bool {
    if !Path::new(CORE).exists() {
        missing("arduino-core-avr");
        return false;
    }
    is_possible()
}

/// The board's program.
pub(super) fn emulator() -> PathBuf {
    compiled_once("board with an AVR".to_owned(), || {
        let program = empty("avr").join("board");
        let mut command = Command::new("cc");
        command.args(["-std=gnu11", "-O2", "-Wall", "-Wextra", "-Werror"]);
        run(command.args(files(&folder(), "c")).arg("-o").arg(&program).arg("-lsimavr"));
        program
    })
}

/// A program of `tests/avr/programs`, for an ATmega328P.
pub(super) fn program(name: &str) -> PathBuf {
    compiled_once(format!("AVR program {name}"), || {
        let program = empty(&format!("avr-{name}")).join("program.elf");
        let mut command = Command::new("avr-gcc");
        command.args(["-mmcu=atmega328p", "-std=gnu99", "-Wall", "-Wextra", "-Werror"]).args(FLAGS);
        command.arg(folder().join("programs").join(name).with_extension("c"));
        run(command.arg("-o").arg(&program));
        program
    })
}

/// A sketch of `tests/avr/programs` with the Arduino core, for a Leonardo.
pub(super) fn sketch(name: &str) -> PathBuf {
    compiled_once(format!("AVR sketch {name}"), || {
        let scratch = empty(&format!("avr-{name}"));
        let core = Path::new(CORE).join("cores/arduino");
        let compile = |compiler: &str, standard: &str, sources: &[PathBuf]| {
            let mut command = Command::new(compiler);
            command
                .args(["-mmcu=atmega32u4", standard, "-w", "-fno-threadsafe-statics", "-c"])
                .args(FLAGS);
            command.args(["-DARDUINO=10819", "-DARDUINO_AVR_LEONARDO", "-DARDUINO_ARCH_AVR"]);
            command.args(["-DUSB_VID=0x2341", "-DUSB_PID=0x8036", "-DDECIMAL_DIG=17"]);
            command.arg("-I").arg(&core);
            command.arg("-I").arg(Path::new(CORE).join("variants/leonardo"));
            run(command.args(sources).current_dir(&scratch));
        };
        let mut sources = files(&core, "cpp");
        sources.push(folder().join("programs").join(name).with_extension("cpp"));
        compile("avr-g++", "-std=gnu++11", &sources);
        compile("avr-gcc", "-std=gnu11", &files(&core, "c"));
        let program = scratch.join("sketch.elf");
        let mut command = Command::new("avr-g++");
        command.args(["-mmcu=atmega32u4", "-w", "-fuse-linker-plugin"]).args(FLAGS);
        command.arg("-Wl,--gc-sections").arg("-o").arg(&program);
        run(command.args(files(&scratch, "o")).arg("-lm"));
        program
    })
}
