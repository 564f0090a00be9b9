//! The portable core: compiled by every compiler and for every CPU, then tested wherever the tests
//! can run.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::LazyLock;

use sensedsl_tests::{files, has, is_exhaustive, is_thorough, mistakes, printed, read, root, run};

use super::tools::scratch;

const STRICT: &[&str] =
    &["-std=c99", "-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Wshadow", "-Werror", "-O2"];

pub(super) fn sources() -> Vec<PathBuf> {
    files(&root().join("crates/firmware-c/runtime"), "c")
}

fn tests() -> Vec<PathBuf> {
    let is_test = |path: &PathBuf| {
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        ["main.c", "rig.c"].contains(&name.as_str()) || name.starts_with("test_")
    };
    files(&root().join("tests/firmware"), "c").into_iter().filter(is_test).collect()
}

fn vectors() -> Vec<PathBuf> {
    let vectors = files(&root().join("tests/vectors"), "txt");
    assert!(vectors.len() >= 10, "the shared vectors are missing");
    vectors
}

/// The generated codecs that the tests need, in their own folder: see `codecs.rs`.
pub(super) fn codecs() -> PathBuf {
    static FOLDER: LazyLock<PathBuf> = LazyLock::new(|| {
        let folder = scratch("codecs");
        super::codecs::write(&folder, &vectors());
        folder
    });
    FOLDER.clone()
}

fn tests_with_codecs() -> Vec<PathBuf> {
    [tests(), files(&codecs(), "c")].concat()
}

fn compile(compiler: &str, flags: &[&str], sources: &[PathBuf], output: &Path) {
    let include = |folder: &str| format!("-I{}", root().join(folder).display());
    let mut command = Command::new(compiler);
    command.args(STRICT).args(flags);
    command.args([include("crates/firmware-c/runtime"), include("tests/firmware")]);
    command.arg(format!("-I{}", codecs().display()));
    command.args(sources).arg("-o").arg(output);
    // The tests compare with functions of the C library; the core itself uses none of them.
    run(if flags.contains(&"-c") { &mut command } else { command.arg("-lm") });
}

/// The number of checks of a run whose summary says that none failed.
fn checks(text: &str, vector_files: usize) -> u32 {
    let summary = text.lines().last().unwrap_or_default();
    let rest = summary.strip_prefix(&format!("{vector_files} vector files, "));
    let number = rest.and_then(|rest| rest.strip_suffix(" checks, 0 failures"));
    number.and_then(|number| number.parse().ok()).unwrap_or_else(|| panic!("{text}"))
}

#[test]
fn compiles_for_every_cortex_m() {
    if !is_thorough() || !has("arm-none-eabi-gcc") {
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

/// The symbols that a source file leaves undefined, compiled for a CPU without floating point.
fn undefined(source: &Path, object: &Path) -> Vec<String> {
    let flags = ["-mcpu=cortex-m0", "-mthumb", "-ffreestanding", "-c"];
    compile("arm-none-eabi-gcc", &flags, &[source.to_owned()], object);
    let text = printed(Command::new("arm-none-eabi-nm").arg("-u").arg(object));
    text.split_whitespace().filter(|word| *word != "U").map(str::to_owned).collect()
}

/// Emulated doubles cost kilobytes and hundreds of cycles for each operation, so only the filter of
/// a `float64` and the shell's text use any. The only functions of the C library in use copy and
/// compare memory.
#[test]
fn needs_neither_doubles_nor_a_library() {
    if !has("arm-none-eabi-gcc") {
        return;
    }
    let object = scratch("undefined").join("core.o");
    let mut with_doubles = Vec::new();
    for source in sources() {
        let words = undefined(&source, &object);
        let name = source.file_name().unwrap().to_string_lossy().into_owned();
        let is_double = |word: &String| {
            let helper = word.strip_prefix("__aeabi_").unwrap_or_default();
            helper.starts_with('d') || helper.contains("2d")
        };
        let is_own = |word: &String| word.starts_with("up_") || word.starts_with("__");
        let is_memory = |word: &String| {
            ["memchr", "memcmp", "memcpy", "memmove", "memset", "strlen"].contains(&word.as_str())
        };
        let others: Vec<_> =
            words.iter().filter(|word| !is_own(word) && !is_memory(word)).collect();
        assert!(others.is_empty(), "{name}: {others:?}");
        if words.iter().any(is_double) {
            with_doubles.push(name);
        }
    }
    assert_eq!(with_doubles, ["up_filter_double.c", "up_text.c"]);
}

fn runs_on_the_host(compiler: &str) {
    if !has(compiler) {
        return;
    }
    let program = scratch(compiler).join("core");
    let level = if is_thorough() { "-O2" } else { "-O0" };
    // Of a quick run, the sanitizers would take longer than all else.
    let sanitized = ["-g", "-fsanitize=address,undefined", "-fno-sanitize-recover=all"];
    let flags: Vec<&str> =
        std::iter::once(level).chain(sanitized.into_iter().filter(|_| is_thorough())).collect();
    compile(compiler, &flags, &[sources(), tests_with_codecs()].concat(), &program);
    let log = printed(Command::new(&program).args(vectors()));
    assert!(checks(&log, vectors().len()) > 10_000);
}

#[test]
fn runs_on_the_host_with_gcc_and_sanitizers() {
    runs_on_the_host("gcc");
}

#[test]
fn runs_on_the_host_with_clang_and_sanitizers() {
    if is_thorough() {
        runs_on_the_host("clang");
    }
}

#[test]
fn runs_on_an_emulated_cortex_m4() {
    if !is_thorough() || !has("arm-none-eabi-gcc") || !has("qemu-system-arm") {
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
    compile(
        "arm-none-eabi-gcc",
        &flags,
        &[sources(), tests_with_codecs(), vec![start]].concat(),
        &program,
    );
    // Semihosting passes arguments and opens the vector files of the host.
    let arguments = vectors().iter().fold(String::from("arg=core"), |all, path| {
        let name = path.file_name().unwrap().to_string_lossy();
        format!("{all},arg={name}")
    });
    let mut emulator = Command::new("qemu-system-arm");
    emulator.current_dir(root().join("tests/vectors"));
    emulator.args(["-M", "mps2-an386", "-nographic", "-monitor", "none", "-serial", "none"]);
    emulator.arg("-semihosting-config").arg(format!("enable=on,target=native,{arguments}"));
    let log = printed(emulator.arg("-kernel").arg(&program));
    assert!(checks(&log, vectors().len()) > 10_000);
}

/// A test that cannot fail proves nothing: it must notice a broken core.
#[test]
fn notices_a_broken_core() {
    if !is_thorough() || !has("gcc") {
        return;
    }
    let folder = scratch("broken");
    let compile = |source: &Path, object: &Path| {
        let mut command = Command::new("gcc");
        command.args(["-std=c99", "-O1", "-w", "-fsanitize=address,undefined"]);
        command.arg("-fno-sanitize-recover=all");
        for include in ["crates/firmware-c/runtime", "tests/firmware"] {
            command.arg(format!("-I{}", root().join(include).display()));
        }
        command.arg(format!("-I{}", codecs().display()));
        run(command.arg("-c").arg(source).arg("-o").arg(object));
    };
    let object = |source: &Path| folder.join(source.file_stem().unwrap()).with_extension("o");
    let whole: Vec<PathBuf> = sources().into_iter().chain(tests_with_codecs()).collect();
    whole.iter().for_each(|source| compile(source, &object(source)));
    let mut files = BTreeSet::new();
    let mut unnoticed = Vec::new();
    let breakages = mistakes("core.txt");
    assert!(breakages.len() > 70, "{}", breakages.len());
    for place in breakages.iter().flat_map(|breakage| &breakage.places) {
        // One breakage of each file; all of them in exhaustive runs.
        if !files.insert(&place.name) && !is_exhaustive() {
            continue;
        }
        let source = whole.iter().find(|source| source.ends_with(&place.name)).unwrap();
        let copy = folder.join(&place.name);
        // Only the first occurrence is meant; a buffer overrun must be noticed as well.
        std::fs::write(&copy, place.once(&read(source))).unwrap();
        let damaged = folder.join("broken.o");
        compile(&copy, &damaged);
        let objects =
            whole.iter().map(|one| if one == source { damaged.clone() } else { object(one) });
        let program = folder.join("core");
        let mut command = Command::new("gcc");
        command.arg("-fsanitize=address,undefined").args(objects).arg("-o").arg(&program);
        run(command.arg("-lm"));
        let output = Command::new(&program).args(vectors()).output().unwrap();
        if output.status.success() {
            unnoticed.push(place);
        }
    }
    assert!(unnoticed.is_empty(), "went unnoticed: {unnoticed:#?}");
}
