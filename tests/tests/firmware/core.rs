//! The portable core: compiled by every compiler and for every CPU, then tested wherever the tests
//! can run.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::LazyLock;

use sensedsl_tests::is_exhaustive;

use super::tools::{files, has, root, run, scratch};

const STRICT: &[&str] =
    &["-std=c99", "-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Wshadow", "-Werror", "-O2"];

fn sources() -> Vec<PathBuf> {
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
fn codecs() -> PathBuf {
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

/// The symbols that a source file leaves undefined, compiled for a CPU without floating point.
fn undefined(source: &Path, object: &Path) -> Vec<String> {
    let flags = ["-mcpu=cortex-m0", "-mthumb", "-ffreestanding", "-c"];
    compile("arm-none-eabi-gcc", &flags, &[source.to_owned()], object);
    let output = run(Command::new("arm-none-eabi-nm").arg("-u").arg(object));
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
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
    let flags = ["-g", "-fsanitize=address,undefined", "-fno-sanitize-recover=all"];
    compile(compiler, &flags, &[sources(), tests_with_codecs()].concat(), &program);
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
    let output = run(emulator.arg("-kernel").arg(&program));
    assert!(checks(&output.stdout, vectors().len()) > 10_000);
}

/// A test that cannot fail proves nothing: it must notice a broken core.
#[test]
fn notices_a_broken_core() {
    if !has("gcc") {
        return;
    }
    let folder = scratch("broken");
    let breakages = [
        ("up_encode.c", "(high << 5)", "(high << 6)"),
        ("up_wire.c", "(i ^ (element_bytes - 1U))", "i"),
        ("up_encode.c", "if (head != frame)", "if (false)"),
        ("up_encode.c", "stamp->counter", "0U"),
        ("up_decode.c", "!= UP_HEALTH_REQUEST", "== 0U"),
        ("up_decode.c", "values_bytes <= STAMP_BYTES", "values_bytes < STAMP_BYTES"),
        ("up_decode.c", "values_bytes == decoder->wire->health_bytes", "true"),
        ("up_decode.c", "while (at < limit && !is_digit(bytes[at]))", "while (at < limit)"),
        ("up_decode.c", "length > decoder->payload_bytes_max", "false"),
        ("up_decode.c", "|| (*seen & bit) != 0U", ""),
        ("up_convert.c", "(raw > ranges[type].max) ? ranges[type].max : raw", "raw"),
        ("up_capture.c", "(first_edge_seen ? 1U : 0U)", "0U"),
        ("up_report.c", "memset(store->due, 0, sizeof store->due);", ""),
        ("up_convert.c", "rest > half", "rest >= half"),
        (
            "up_convert.c",
            "remainder >= denominator - remainder",
            "remainder > denominator - remainder",
        ),
        ("up_checksum.c", "is_carried ? polynomial : 0U", "polynomial"),
        ("up_value.c", "at + at / 2U", "at"),
        ("up_value.c", "(how->elements != NULL) ? how->elements[element]", "false ? element"),
        ("up_value.c", "digit > 9U", "false"),
        ("up_value.c", "gathered >> (first % 8U)", "gathered >> (first % 4U)"),
        ("up_value.c", "? greatest + 1U", "? greatest"),
        ("up_formula.c", "gross * 3125", "gross * 3126"),
        ("up_formula.c", "* 131072", "* 65536"),
        ("up_formula.c", "adc != SKIPPED && ", ""),
        ("up_formula.c", "(calibration[29] & 0xF)", "(calibration[29] >> 4)"),
        ("up_formula_ntc.c", "level >= FULL", "level > FULL"),
        ("up_formula_tsl2561.c", "0x02D1U", "0x02C1U"),
        ("up_chip.c", "now_ms - when_ms", "now_ms > when_ms ? 0U : 0x80000000U"),
        ("up_chip.c", "    restart(state);\n    return false;", "    return false;"),
        (
            "up_chip.c",
            "state->is_stranger = state->counts.causes[UP_WRONG_IDENTITY] % LOOKS != 0U;",
            "",
        ),
        ("up_chip.c", "% LOOKS != 0U", "!= 0U"),
        ("up_message.c", "(uint32_t)(now_ms - state->pause_until_ms) >= 0x80000000U", "false"),
        ("up_formula_tsl2561.c", "? parameters[0] : NOMINAL_MS", "? parameters[0] : 101"),
        ("up_chip.c", "step->clock() + ((wait_ms", "step->now_ms + ((wait_ms"),
        ("up_chip.c", "& mask) != 0U", ") != 0U"),
        ("up_chip.c", "state->due_ms += cycle_ms;", "state->due_ms = step->now_ms + cycle_ms;"),
        ("up_chip.c", "now_ms + early_ms(step)", "now_ms"),
        ("up_chip.c", "/ cycle_ms + 1U)", "/ cycle_ms)"),
        ("up_chip.c", "state->in_flight = 0U;\n      if", "if"),
        ("up_chip.c", "state->counts.causes[cause]++;", ""),
        ("up_chip.c", "(up_result_t)step->state->fault", "UP_BUS_ERROR"),
        ("up_value.c", "return UP_WRONG_CRC;", "return UP_INVALID;"),
        ("up_message.c", "state->wrong_checksum++;\n      say_damaged", "say_damaged"),
        ("up_message.c", "UP_WRONG_CRC, NULL", "UP_INVALID, NULL"),
        ("up_filter.c", "(count - 1U) / 2U", "count / 2U"),
        ("up_filter.c", "now.whole + (now.fraction >> 31)", "now.whole"),
        ("up_filter.c", "(low >> 32) + (fraction >> 32)", "(low >> 32)"),
        ("up_filter.c", "interval_ms - interval_ms / 4U", "0U"),
        ("up_filter.c", "state->has_seen ? up_filter_decay", "true ? up_filter_decay"),
        ("up_filter.c", "step - (sum - old)", "0.0F"),
        ("up_filter_double.c", "step - (sum - old)", "0.0"),
        ("up_parse.c", "times(decimal.digits,", "decimal.digits * ("),
        ("up_parse.c", "whole % 100U >= 60U", "false"),
        ("up_parse.c", "angle > (uint64_t)degrees_max * 60U * NANO", "false"),
        (
            "up_message.c",
            "count = (next != NULL) ? (size_t)(next - state->buffer) : state->size",
            "count = state->size",
        ),
        ("up_message.c", "message->checksum_from < at", "false"),
        ("up_message.c", "IBUS_START - ", "0U - "),
        ("up_message.c", "size >= 2U * (size_t)message->start_count", "false"),
        ("up_message.c", "state->is_aligned || ", ""),
        ("up_reporter.c", "channel->room(channel->context) >= channel->room_max", "true"),
        ("up_reporter.c", "drop_old(reporter);", ""),
        ("up_reporter.c", "up_report_restore(reporter->config->store, reporter->taken);", ""),
        ("up_reporter.c", "!reporter->has_answered && answer(reporter)", "answer(reporter)"),
        ("up_reporter.c", "up_silence_heard(&reporter->silence, now_ms(reporter));", ""),
        ("up_reporter.c", "reporter->counter++;", ""),
        ("up_health.c", "(device->counts[fault] < UINT16_MAX)", "1"),
        ("up_health.c", "age / UP_STALE_CYCLES >= cycle_ms", "age >= cycle_ms"),
        ("up_health.c", "if (device->is_ancient)", "if (false)"),
        ("up_silence.c", "silence->is_silent || ", ""),
        (
            "up_silence.c",
            "(uint32_t)(now_ms - silence->heard_ms) <",
            "now_ms < silence->heard_ms +",
        ),
        ("up_ppm.c", "interval_ticks < config->min_ticks", "false"),
        ("up_ppm.c", "raw->is_inside && raw->building_count > 0U", "raw->building_count > 0U"),
        ("up_drive.c", "put(writes, &count, 0U, 0U);\n    put", "put"),
        (
            "up_drive.c",
            "put(writes, &count, low, 0U);\n    put(writes, &count, other, (direction == 0) ? 0U : 1U);",
            "put(writes, &count, other, (direction == 0) ? 0U : 1U);\n    put(writes, &count, low, 0U);",
        ),
    ];
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
    for (file, original, broken) in breakages {
        // One breakage of each file in ordinary runs, all of them in exhaustive runs.
        if !files.insert(file) && !is_exhaustive() {
            continue;
        }
        let source = whole.iter().find(|source| source.ends_with(file)).unwrap();
        let text = std::fs::read_to_string(source).unwrap();
        assert!(text.contains(original), "{file} has no `{original}` any more");
        let copy = folder.join(file);
        // Only the first occurrence is meant; a buffer overrun must be noticed as well.
        std::fs::write(&copy, text.replacen(original, broken, 1)).unwrap();
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
            unnoticed.push(format!("{file}: `{broken}` for `{original}`"));
        }
    }
    assert!(unnoticed.is_empty(), "went unnoticed: {unnoticed:#?}");
}
