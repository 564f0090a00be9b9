//! The portable core: every compiler and CPU, then its tests where they can run.

use std::path::{Path, PathBuf};
use std::process::Command;

use super::tools::{files, has, root, run, scratch};

const STRICT: &[&str] =
    &["-std=c99", "-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Wshadow", "-Werror", "-O2"];

fn sources() -> Vec<PathBuf> {
    files(&root().join("runtime/core"), "c")
}

fn tests() -> Vec<PathBuf> {
    let folder = root().join("tests/firmware");
    ["main.c", "test_units.c", "test_vectors.c"].map(|name| folder.join(name)).to_vec()
}

fn vectors() -> Vec<PathBuf> {
    let vectors = files(&root().join("tests/vectors"), "txt");
    assert!(vectors.len() >= 3, "the shared vectors are missing");
    vectors
}

fn compile(compiler: &str, flags: &[&str], sources: &[PathBuf], output: &Path) {
    let include = |folder: &str| format!("-I{}", root().join(folder).display());
    let mut command = Command::new(compiler);
    command.args(STRICT).args(flags);
    command.args([include("runtime/core"), include("tests/firmware")]);
    run(command.args(sources).arg("-o").arg(output));
}

/// The number of checks of a run whose summary says that none failed.
fn checks(stdout: &[u8], vector_files: usize) -> u32 {
    let text = String::from_utf8_lossy(stdout);
    let summary = text.lines().last().unwrap_or_default();
    let rest = summary.strip_prefix(&format!("{vector_files} vector files, "));
    let number = rest.and_then(|rest| rest.strip_suffix(" checks, 0 failures"));
    number.and_then(|number| number.parse().ok()).unwrap_or_else(|| panic!("{text}"))
}

#[test]
fn compiles_for_every_cortex_m() {
    if !has("arm-none-eabi-gcc") {
        return;
    }
    let folder = scratch("cortex");
    for cpu in ["cortex-m0plus", "cortex-m3", "cortex-m4", "cortex-m7"] {
        for source in sources() {
            let flag = format!("-mcpu={cpu}");
            let flags = [flag.as_str(), "-mthumb", "-ffreestanding", "-c"];
            compile("arm-none-eabi-gcc", &flags, &[source], &folder.join("core.o"));
        }
    }
}

fn runs_on_the_host(compiler: &str) {
    if !has(compiler) {
        return;
    }
    let program = scratch(compiler).join("core");
    let flags = ["-g", "-fsanitize=address,undefined", "-fno-sanitize-recover=all"];
    compile(compiler, &flags, &[sources(), tests()].concat(), &program);
    let output = run(Command::new(&program).args(vectors()));
    assert!(checks(&output.stdout, vectors().len()) > 10_000);
}

#[test]
fn runs_on_the_host_with_gcc_and_sanitizers() {
    runs_on_the_host("gcc");
}

#[test]
fn runs_on_the_host_with_clang_and_sanitizers() {
    runs_on_the_host("clang");
}

#[test]
fn runs_on_an_emulated_cortex_m4() {
    if !has("arm-none-eabi-gcc") || !has("qemu-system-arm") {
        return;
    }
    let program = scratch("qemu").join("core.elf");
    let start = root().join("tests/firmware/vectors_cortex_m.c");
    let flags = [
        "-mcpu=cortex-m4",
        "-mthumb",
        "--specs=rdimon.specs",
        "-Wl,--section-start=.isr_vector=0x0",
        "-Wl,-Tdata=0x20000000",
    ];
    compile("arm-none-eabi-gcc", &flags, &[sources(), tests(), vec![start]].concat(), &program);
    // Semihosting hands on arguments and opens the vector files of the host.
    let arguments = vectors().iter().fold(String::from("arg=core"), |all, path| {
        let name = path.file_name().unwrap().to_string_lossy();
        format!("{all},arg={name}")
    });
    let mut emulator = Command::new("qemu-system-arm");
    emulator.current_dir(root().join("tests/vectors"));
    emulator.args(["-M", "mps2-an386", "-nographic", "-monitor", "none", "-serial", "none"]);
    emulator.arg("-semihosting-config").arg(format!("enable=on,target=native,{arguments}"));
    let output = run(emulator.arg("-kernel").arg(&program));
    assert!(checks(&output.stdout, vectors().len()) > 10_000);
}

/// A test that cannot fail proves nothing: a broken core must be noticed.
#[test]
fn notices_a_broken_core() {
    if !has("gcc") {
        return;
    }
    let folder = scratch("broken");
    let breakages = [
        ("up_encode.c", "(high << 5)", "(high << 6)"),
        ("up_encode.c", "bits >>= 8;", "bits >>= 4;"),
        ("up_decode.c", "while (at < limit && !is_digit(bytes[at]))", "while (at < limit)"),
        ("up_decode.c", "length > decoder->payload_bytes_max", "false"),
        ("up_decode.c", "|| (*seen & bit) != 0U", ""),
        ("up_convert.c", "(raw > ranges[type].max) ? ranges[type].max : raw", "raw"),
        ("up_i2c.c", "!is_reached(now_ms, state->ready_ms)", "now_ms < state->ready_ms"),
        ("up_capture.c", "(first_edge_seen ? 1U : 0U)", "0U"),
        ("up_report.c", "memset(store->due, 0, sizeof store->due);", ""),
    ];
    let compile = |source: &Path, object: &Path| {
        let mut command = Command::new("gcc");
        command.args(["-std=c99", "-O1", "-w", "-fsanitize=address,undefined"]);
        command.arg("-fno-sanitize-recover=all");
        for include in ["runtime/core", "tests/firmware"] {
            command.arg(format!("-I{}", root().join(include).display()));
        }
        run(command.arg("-c").arg(source).arg("-o").arg(object));
    };
    let object = |source: &Path| folder.join(source.file_stem().unwrap()).with_extension("o");
    let whole: Vec<PathBuf> = sources().into_iter().chain(tests()).collect();
    whole.iter().for_each(|source| compile(source, &object(source)));
    for (file, original, broken) in breakages {
        let source = whole.iter().find(|source| source.ends_with(file)).unwrap();
        let text = std::fs::read_to_string(source).unwrap();
        assert!(text.contains(original), "{file} has no `{original}` any more");
        let copy = folder.join(file);
        // The first place is the one meant; a buffer overrun must not go unnoticed either.
        std::fs::write(&copy, text.replacen(original, broken, 1)).unwrap();
        let damaged = folder.join("broken.o");
        compile(&copy, &damaged);
        let objects =
            whole.iter().map(|one| if one == source { damaged.clone() } else { object(one) });
        let program = folder.join("core");
        let mut command = Command::new("gcc");
        command.arg("-fsanitize=address,undefined").args(objects).arg("-o").arg(&program);
        run(&mut command);
        let output = Command::new(&program).args(vectors()).output().unwrap();
        assert!(!output.status.success(), "{file}: `{broken}` went unnoticed");
    }
}
