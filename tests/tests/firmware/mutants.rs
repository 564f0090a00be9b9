//! Mistakes put into generated files, one at a time, with the checks that notice them: the second
//! reader (`facts`, `details`), and a compiler with the stub headers (`stubs`). Golden files see
//! every change, so they are not counted here.
//!
//! `docs/mutants.md` has the table; `SENSEDSL_BLESS=1 cargo test --workspace --test all
//! firmware::mutants` writes it. A mistake that only a compiler with the real tree notices counts
//! as unnoticed, because most machines have no tree; `-- --ignored firmware::mutants --nocapture`
//! checks with the tree too (`CHIBIOS`).

use std::path::Path;
use std::process::Command;

use super::applications::{CAR, FIG2};
use super::facts::{self, Folder};
use super::tools::{root, scratch};
use super::{chibios, stubs};

const HARDWARE: &str = "generated/sense_hw.c";
const MODEL: &str = "generated/sense_model.c";
const MODEL_H: &str = "generated/sense_model.h";
const MCU: &str = "cfg/mcuconf.h";
const CONF: &str = "cfg/up_conf.h";

/// A mistake: its name, its file, the text whose first occurrence is replaced, and the replacement.
type Mutant = (&'static str, &'static str, &'static str, &'static str);

/// Mistakes in the files of Fig. 2.
const MUTANTS: &[Mutant] = &[
    ("pad of another number", HARDWARE, "PAL_LINE(GPIOB, 1U)", "PAL_LINE(GPIOB, 2U)"),
    ("pad of another port", HARDWARE, "PAL_LINE(GPIOB, 4U)", "PAL_LINE(GPIOC, 4U)"),
    ("alternate function of a capture", HARDWARE, "PAL_MODE_ALTERNATE(2)", "PAL_MODE_ALTERNATE(3)"),
    ("alternate function of a bus", HARDWARE, "PAL_MODE_ALTERNATE(4)", "PAL_MODE_ALTERNATE(9)"),
    (
        "alternate function of the link",
        HARDWARE,
        "PAL_MODE_ALTERNATE(10)",
        "PAL_MODE_ALTERNATE(11)",
    ),
    ("a bus is driven", HARDWARE, " | PAL_STM32_OTYPE_OPENDRAIN", ""),
    ("an input that is not analog", HARDWARE, "PAL_MODE_INPUT_ANALOG", "PAL_MODE_INPUT"),
    ("a pad that is left out", HARDWARE, "    /* PB1 */", "    // /* PB1 */"),
    ("converter channel", HARDWARE, "ADC_CHANNEL_IN9", "ADC_CHANNEL_IN8"),
    ("channel of the sampling time", HARDWARE, "_SMP_AN9", "_SMP_AN7"),
    ("length of the sequence", HARDWARE, "ADC_SQR1_NUM_CH(1U)", "ADC_SQR1_NUM_CH(2U)"),
    ("another converter", HARDWARE, ".driver = &ADCD1", ".driver = &ADCD2"),
    (
        "field of a conversion",
        HARDWARE,
        ".field = SENSE_FIELD_IRFrontRight",
        ".field = SENSE_FIELD_IRFront",
    ),
    ("samples", HARDWARE, ".samples = 32U", ".samples = 31U"),
    ("address", HARDWARE, ".address = 0x73U", ".address = 0x72U"),
    ("register", HARDWARE, "us_rear_select_0[] = {0x02U}", "us_rear_select_0[] = {0x03U}"),
    ("trigger", HARDWARE, "{0x00U, 0x51U}", "{0x00U, 0x50U}"),
    ("order of a trigger's bytes", HARDWARE, "{0x00U, 0x51U}", "{0x51U, 0x00U}"),
    ("byte order", HARDWARE, ".word_bytes = 2U,", ".word_bytes = 2U,\n.little_endian = true,"),
    ("wait", HARDWARE, ".wait_ms = 65U", ".wait_ms = 6U"),
    ("length of a reading", HARDWARE, ".length = 2U", ".length = 1U"),
    ("another bus", HARDWARE, ".driver = &I2CD3", ".driver = &I2CD1"),
    ("clock of a bus", HARDWARE, ".clock_speed = 400000U", ".clock_speed = 40000U"),
    ("duty cycle of a bus", HARDWARE, "FAST_DUTY_CYCLE_2", "STD_DUTY_CYCLE"),
    (
        "SCL and SDA for the recovery",
        HARDWARE,
        ".scl = PAL_LINE(GPIOA, 8U)",
        ".scl = PAL_LINE(GPIOC, 9U)",
    ),
    ("time-out of a bus", HARDWARE, ".timeout_ms = 11U", ".timeout_ms = 1U"),
    ("buffer of a bus", HARDWARE, "_work[3]", "_work[2]"),
    ("another timer", HARDWARE, ".driver = &ICUD3", ".driver = &ICUD4"),
    ("capture channel", HARDWARE, "ICU_CHANNEL_1", "ICU_CHANNEL_2"),
    ("edge", HARDWARE, "ICU_INPUT_ACTIVE_HIGH", "ICU_INPUT_ACTIVE_LOW"),
    ("both edges", HARDWARE, ".both_edges = false", ".both_edges = true"),
    ("divider of a timer", HARDWARE, ".frequency = 10000U", ".frequency = 11000U"),
    ("ticks that the runtime computes with", HARDWARE, ".tick_hz = 10000U", ".tick_hz = 1000U"),
    ("cycle time", HARDWARE, ".delay_ms = 60U", ".delay_ms = 600U"),
    ("priority", HARDWARE, ".prio = 2", ".prio = -2"),
    ("work of another thread", HARDWARE, ".work = &adc1_60ms,", ".work = &adc1_1000ms,"),
    ("device of a thread", HARDWARE, ".device = 18U", ".device = 17U"),
    ("a driver that is not started", HARDWARE, "  up_i2c_start(", "  // up_i2c_start("),
    ("a capture that nobody looks at", HARDWARE, "  up_icu_poll(", "  // up_icu_poll("),
    ("level of the button", HARDWARE, ".button_pressed = PAL_HIGH", ".button_pressed = PAL_LOW"),
    ("invalid value of a filter", HARDWARE, ".low.u = UINT64_C(0)", ".low.u = UINT64_C(1)"),
    (
        "filter of another field",
        HARDWARE,
        "    {NULL, NULL},\n    {&us_rear_filter",
        "    {&us_rear_filter",
    ),
    ("identifier", MODEL, ".id = 18U", ".id = 21U"),
    ("type", MODEL, "UP_TYPE_UINT32", "UP_TYPE_INT32"),
    ("width of a type", MODEL, "UP_TYPE_UINT8", "UP_TYPE_UINT16"),
    ("direction", MODEL, "UP_TO_HOST", "UP_TO_BOARD"),
    (
        "place of a value",
        MODEL,
        "offsetof(sense_values_t, SENSE_IRFrontRight)",
        "offsetof(sense_values_t, SENSE_IRFront)",
    ),
    ("schema hash", MODEL, ".hash = 0xb2d2a70bU", ".hash = 0xb2d2a70cU"),
    ("checksum", MODEL, ".checksum = \"none\"", ".checksum = \"crc16\""),
    ("number of fields", MODEL, ".fields_count = 4U", ".fields_count = 3U"),
    ("number of a field", MODEL_H, "SENSE_FIELD_USRear = 2", "SENSE_FIELD_USRear = 1"),
    (
        "type of a stored value",
        MODEL_H,
        "uint32_t SENSE_WheelEncoder",
        "uint16_t SENSE_WheelEncoder",
    ),
    ("DMA stream of another unit", MCU, "STM32_DMA_STREAM_ID(2, 4)", "STM32_DMA_STREAM_ID(1, 2)"),
    (
        "DMA stream without the request",
        MCU,
        "STM32_DMA_STREAM_ID(2, 4)",
        "STM32_DMA_STREAM_ID(2, 1)",
    ),
    ("the kernel's timer", MCU, "STM32_ST_USE_TIMER 2", "STM32_ST_USE_TIMER 3"),
    ("a unit that is off", MCU, "STM32_ICU_USE_TIM3 TRUE", "STM32_ICU_USE_TIM3 FALSE"),
    ("watchdog's clock", MCU, "STM32_LSI_ENABLED TRUE", "STM32_LSI_ENABLED FALSE"),
    ("number of fields in the sizes", CONF, "UP_FIELDS_COUNT 4U", "UP_FIELDS_COUNT 3U"),
    ("number of threads", CONF, "UP_TASKS_COUNT 3U", "UP_TASKS_COUNT 2U"),
];

/// Mistakes that nothing notices, and the reason: only a board on the bench would show them.
const UNSEEN: &[(&str, &str)] = &[];

/// Mistakes that once survived, or that only the tree noticed; the checks that notice them were
/// written later.
const SURVIVED: [&str; 15] = [
    "alternate function of the link",
    "samples",
    "duty cycle of a bus",
    "SCL and SDA for the recovery",
    "time-out of a bus",
    "buffer of a bus",
    "a driver that is not started",
    "a capture that nobody looks at",
    "level of the button",
    "invalid value of a filter",
    "filter of another field",
    "watchdog's clock",
    "work of another thread",
    "device of a thread",
    "the kernel's timer",
];

/// The files compiled with the tree: the generated ones, and those of the tree that read the
/// generated settings.
const OBJECTS: [&str; 7] =
    ["sense_hw", "sense_model", "up_rt", "up_report", "hal_st_lld", "hal_adc_lld", "hal_icu_lld"];

fn write(folder: &Path, files: &Folder) {
    for (path, text) in files {
        let path = folder.join(path);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        // An unchanged file keeps its time, so that make compiles only what has changed.
        if std::fs::read_to_string(&path).is_ok_and(|there| there == *text) {
            continue;
        }
        std::fs::write(path, text).unwrap();
    }
}

/// Whether the compiler with the real tree, or a guard, stops or warns.
fn tree_notices(tree: &Path, folder: &Path) -> bool {
    let mut make = Command::new("make");
    make.current_dir(folder).arg("-j2").arg(format!("CHIBIOS={}", tree.display()));
    make.args(OBJECTS.map(|name| format!("./build/development/obj/{name}.o")));
    let output = make.output().unwrap();
    !output.status.success() || String::from_utf8_lossy(&output.stderr).contains("warning")
}

/// Puts one mutant after the other into a design's files, and passes each result to `then`.
fn each(name: &str, mut then: impl FnMut(&'static Mutant, [bool; 2], &Path)) {
    facts::with(FIG2, |design, wiring, folder| {
        let macros = stubs::macros_of("STM32F4DiscoveryBoard");
        let place = scratch(name);
        write(&place, &folder);
        let sources = stubs::sources(&folder);
        assert_eq!(stubs::compile(&place, &macros, "development", &sources), "");
        assert_eq!(facts::differences(design, wiring, &folder), [] as [&str; 0]);
        for mutant in MUTANTS {
            let (what, path, find, with) = mutant;
            let mut mutated = folder.clone();
            let text = mutated.get_mut(*path).unwrap();
            assert!(text.contains(find), "{what}: {path} has no `{find}`");
            *text = text.replacen(find, with, 1);
            write(&place, &mutated);
            // A header is included in many files; a source is compiled by itself.
            let changed = if path.ends_with(".c") { vec![*path] } else { sources.clone() };
            let notices = [
                // If the reader cannot read the files at all, it has noticed as well.
                std::panic::catch_unwind(|| {
                    !facts::differences(design, wiring, &mutated).is_empty()
                })
                .unwrap_or(true),
                !stubs::compile(&place, &macros, "development", &changed).is_empty(),
            ];
            then(mutant, notices, &place);
        }
    });
}

const INTRO: &str = "# Mistakes that are noticed

Does anything notice when the generator writes something wrong? Each line is a mistake that is put into the generated
files of Fig. 2 (`examples/fig2.sense`), alone, and who notices it on a machine without a ChibiOS tree:

- **reader**: a second reader of the generated files, which shares nothing with the generator and holds them against
  wiring, design and data of the part (`tests/tests/firmware/facts.rs`, `details.rs`);
- **compiler**: a C compiler with stub headers in the place of ChibiOS, with all warnings as errors
  (`tests/firmware/stubs`).

Golden files would notice every one and say nothing about who is right, so they do not count. A mistake with a star
survived once, or only the real tree noticed it, and the check that notices it was written after that: it proves less
than the others, because the check was made for it. The page is written by the test that makes the mistakes.
";

/// The subject of a file.
fn class(path: &str) -> &'static str {
    match path {
        HARDWARE => "Wires, drivers and threads",
        MODEL | MODEL_H => "Schema and values",
        MCU => "Units and streams",
        _ => "Sizes",
    }
}

fn page(rows: &[(&Mutant, [bool; 2])]) -> String {
    let mut page = INTRO.to_owned();
    let mut of = "";
    for ((what, path, ..), notices) in rows {
        if class(path) != of {
            of = class(path);
            page.push_str(&format!(
                "\n## {of}\n\n| mistake | reader | compiler |\n| --- | --- | --- |\n"
            ));
        }
        let star = if SURVIVED.contains(what) { "*" } else { "" };
        let marks = notices.map(|noticed| if noticed { "yes" } else { "" });
        page.push_str(&format!("| {what}{star} | {} | {} |\n", marks[0], marks[1]));
    }
    let seen = |at: usize| rows.iter().filter(|(_, notices)| notices[at]).count();
    page.push_str(&format!(
        "\n## Nobody notices\n\nOf {} mistakes the reader notices {}, the compiler {}, and nobody {}.\n",
        rows.len(),
        seen(0),
        seen(1),
        UNSEEN.len()
    ));
    for (what, why) in UNSEEN {
        page.push_str(&format!("\n- **{what}**: {why}\n"));
    }
    page
}

#[test]
fn mutants_of_generated_files_are_noticed() {
    let mut rows = Vec::new();
    each("mutants-stubs", |mutant, notices, _| rows.push((mutant, notices)));
    let unseen = rows.iter().filter(|(_, notices)| !notices.contains(&true));
    let unseen: Vec<&str> = unseen.map(|(mutant, _)| mutant.0).collect();
    let known: Vec<&str> = UNSEEN.iter().map(|(what, _)| *what).collect();
    assert_eq!(unseen, known, "nobody notices these");
    let all: Vec<&str> = MUTANTS.iter().map(|mutant| mutant.0).collect();
    assert!(SURVIVED.iter().all(|what| all.contains(what)));
    let path = root().join("docs/mutants.md");
    let page = page(&rows);
    if std::env::var("SENSEDSL_BLESS").is_ok() {
        std::fs::write(&path, &page).unwrap();
    }
    assert_eq!(sensedsl_tests::read(&path), page, "docs/mutants.md is old: SENSEDSL_BLESS=1");
}

#[test]
#[ignore = "compiles with the tree a hundred times"]
fn mutants_are_noticed_by_the_tree() {
    let Some(tree) = chibios::tree() else { return };
    let mut seen = 0;
    each("mutants-tree", |(what, ..), notices, place| {
        let noticed = tree_notices(&tree, place);
        seen += usize::from(noticed);
        let marks = [notices[0], notices[1], noticed].map(|one| if one { "yes" } else { "-" });
        eprintln!("| {what} | {} |", marks.join(" | "));
    });
    let whole = chibios::write("mutants-none", FIG2).join("STM32F4DiscoveryBoard");
    assert!(!tree_notices(&tree, &whole), "the files are wrong without a mutant");
    eprintln!("the tree notices {seen} of {}", MUTANTS.len());
    assert!(seen >= 8, "{seen}");
}

/// The text that each mutant replaces must exist, so that the list follows the templates.
#[test]
fn mutants_are_of_texts_that_are_there() {
    facts::with(FIG2, |_, _, folder| {
        for (what, path, find, _) in MUTANTS {
            assert!(folder[*path].contains(find), "{what}: {path} has no `{find}`");
        }
    });
    facts::with(CAR, |_, _, folder| assert!(folder.contains_key(HARDWARE)));
}
