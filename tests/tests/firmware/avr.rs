//! The core on AVR, where constants take RAM unless they are declared for program memory: compiled
//! for a small one, and run on a simulated one.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use sensedsl_tests::{files, has, missing, printed, read, root, run};

use super::core::{codecs, sources};
use super::tools::scratch;

/// Without `-Waddr-space-convert` the compiler takes a pointer to program memory for one to RAM.
pub(super) const STRICT: [&str; 6] =
    ["-std=gnu11", "-Os", "-Wall", "-Wextra", "-Waddr-space-convert", "-Werror"];
/// A table of the values of a `switch` would be in RAM; the core has none that becomes one.
const GENERATED: &str = "-fno-tree-switch-conversion";
/// With little memory.
const SMALL: &str = "atmega328p";
/// With the same instructions, and room for all of the core at once.
pub(super) const LARGE: &str = "atmega1284p";

/// Compiles a file for the small machine.
pub(crate) fn compile(source: &Path, flags: &[&str], object: &Path) {
    let mut command = Command::new("avr-gcc");
    command.arg(format!("-mmcu={SMALL}")).args(STRICT).args(flags);
    command.arg("-I").arg(root().join("crates/firmware-c/runtime"));
    run(command.arg("-c").arg(source).arg("-o").arg(object));
}

/// The sections of an object that take RAM, with their sizes: variables, and constants that nothing
/// has put anywhere else.
pub(crate) fn in_ram(object: &Path) -> Vec<String> {
    let text = printed(Command::new("avr-size").arg("-A").arg(object));
    let is_ram =
        |name: &str| [".data", ".bss", ".rodata"].iter().any(|start| name.starts_with(start));
    let sections = text.lines().filter_map(|line| {
        let mut words = line.split_whitespace();
        let (name, size) = (words.next()?, words.next()?);
        (is_ram(name) && size != "0").then(|| format!("{name} {size}"))
    });
    sections.collect()
}

#[test]
fn the_core_has_nothing_in_ram() {
    if !has("avr-gcc") {
        return;
    }
    let object = scratch("avr").join("core.o");
    // With all parts, and with as little as a program can have.
    let least = [
        "-DUP_USES_HEALTH=0",
        "-DUP_USES_REALS=0",
        "-DUP_USES_WIDE=0",
        "-DUP_USES_COMMANDS=0",
        "-DUP_USES_CAPTURE_TIMES=0",
        "-DUP_USES_CRC32=0",
        "-DUP_WIRE_MEMO=0",
        "-DUP_FIELD_BITMAP_BYTES=2U",
        "-DUP_PPM_CHANNELS_MAX=8U",
    ];
    for flags in [&[][..], &["-DUP_DECODER_WALKS=1U", "-DUP_SHORT_COUNTS=0"], &least] {
        for source in sources() {
            compile(&source, flags, &object);
            assert_eq!(in_ram(&object), <[String; 0]>::default(), "{source:?} {flags:?}");
        }
    }
}

/// A constant that is not declared for program memory is noticed, and so is a pointer to one.
#[test]
fn a_forgotten_constant_is_noticed() {
    if !has("avr-gcc") {
        return;
    }
    let folder = scratch("avr-forgotten");
    let (source, object) = (folder.join("forgotten.c"), folder.join("forgotten.o"));
    std::fs::write(&source, "extern const char word[];\nconst char word[] = \"here\";\n").unwrap();
    compile(&source, &[], &object);
    assert_eq!(in_ram(&object), [".rodata 5"]);
    let text = "#include \"up_rom.h\"\nconst char *word(UP_ROM char *text);\n\
                const char *word(UP_ROM char *text) {\n  return text;\n}\n";
    std::fs::write(&source, text).unwrap();
    let mut command = Command::new("avr-gcc");
    command.args(STRICT).arg("-I").arg(root().join("crates/firmware-c/runtime"));
    let output = command.arg("-c").arg(&source).arg("-o").arg(&object).output().unwrap();
    assert!(String::from_utf8_lossy(&output.stderr).contains("address space"), "{output:?}");
    assert!(!output.status.success());
}

/// What is printed for a wire has no more in RAM than its values. A machine with short doubles has
/// no values of `float64`.
#[test]
fn generated_models_have_only_their_values_in_ram() {
    if !has("avr-gcc") {
        return;
    }
    let folder = scratch("avr-models");
    let is_model = |path: &&PathBuf| {
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        name.ends_with("_model.h") && !read(path).contains(" double ")
    };
    let all = files(&codecs(), "h");
    let models: Vec<&PathBuf> = all.iter().filter(is_model).collect();
    assert!(models.len() > 10, "{}", models.len());
    for header in models {
        let path = header.to_string_lossy();
        let start = path.strip_suffix("_model.h").unwrap();
        for (ending, most) in [("_model.c", 1), ("_codec.c", 0)] {
            let (source, object) = (format!("{start}{ending}"), folder.join("model.o"));
            compile(Path::new(&source), &[GENERATED], &object);
            let found = in_ram(&object);
            assert!(found.len() <= most, "{source}: {found:?}");
            assert!(found.iter().all(|section| section.starts_with(".bss ")), "{found:?}");
        }
    }
}

/// Whether the simulator is here; it has no option that only succeeds.
pub(super) fn has_simavr() -> bool {
    let mut command = Command::new("simavr");
    let command = command.arg("--help").stdin(Stdio::null());
    let found = command.output().is_ok_and(|output| !output.stdout.is_empty());
    if !found {
        missing("simavr");
    }
    found
}

/// What a program sends over its serial port. The simulator prints it in colour, with a point for
/// what ends a line.
pub(super) fn simulated(program: &Path) -> String {
    let mut command = Command::new("simavr");
    let output = run(command.args(["-m", LARGE, "-f", "16000000"]).arg(program));
    let text = String::from_utf8(output.stderr).unwrap();
    let text = text.replace("\u{1b}[32m", "").replace("\u{1b}[0m", "");
    let lines = text.lines().filter_map(|line| line.strip_suffix('.'));
    lines.map(|line| format!("{line}\n")).collect()
}

#[test]
fn a_simulated_avr_says_what_a_computer_says() {
    if !has("gcc") || !has("avr-gcc") || !has_simavr() {
        return;
    }
    let folder = scratch("avr-run");
    let program = |command: &mut Command, name: &str| {
        command.args(["-Wall", "-Wextra", "-Werror", "-I"]);
        command.arg(root().join("crates/firmware-c/runtime"));
        command.arg(root().join("tests/firmware/avr/main.c")).args(sources());
        run(command.arg("-o").arg(folder.join(name)));
        folder.join(name)
    };
    let own = program(Command::new("gcc").args(["-std=c99", "-Wpedantic", "-Wconversion"]), "own");
    let expected = printed(&mut Command::new(own));
    assert!(expected.lines().count() >= 40, "{expected}");
    let machine = format!("-mmcu={LARGE}");
    let sections = ["-ffunction-sections", "-fdata-sections", "-Wl,--gc-sections"];
    for flags in [&["-mcall-prologues", "-flto"][..], &[]] {
        let mut command = Command::new("avr-gcc");
        command.args(STRICT).arg(&machine).args(sections).args(flags);
        assert_eq!(simulated(&program(&mut command, "avr.elf")), expected, "{flags:?}");
    }
}
