//! Mistakes put into the generated C of a rover, one at a time, with what notices them when the
//! program runs in its world.
//!
//! The table is in `docs/seeded-mistakes.md`. `SENSEDSL_THOROUGH=2 SENSEDSL_BLESS=1 cargo test
//! --workspace --test all --features sensedsl-tests/machine firmware::twin::seeded` writes it.
//! Otherwise only the first few mistakes are tested.

use std::path::Path;
use std::process::Command;

use sensedsl_tests::assert_section;

use super::bench::folder;
use super::trial::{System, Trial, rover, rover_world, run};
use crate::firmware::chibios::tree;

const HARDWARE: &str = "generated/sense_hw.c";
const MCU: &str = "cfg/mcuconf.h";
const ENCODER: &str = "uproxy/chibios/up_encoder.c";
const COUNT: usize = 48;
/// The length of each run: in this time the motor is commanded and abandoned, and everything in the
/// world moves.
pub(super) const SECONDS: u64 = 2;

/// A mistake: its name, its file, the text whose first occurrence is replaced, and the replacement.
type Seed = (&'static str, &'static str, &'static str, &'static str);

const SEEDS: [Seed; COUNT] = [
    (
        "pad of an analog sensor: another of its bank",
        HARDWARE,
        "PAL_LINE(GPIOC, 4U), PAL_MODE_INPUT_ANALOG",
        "PAL_LINE(GPIOC, 3U), PAL_MODE_INPUT_ANALOG",
    ),
    (
        "converter channel",
        HARDWARE,
        "ADC_SQR3_SQ2_N(ADC_CHANNEL_IN14)",
        "ADC_SQR3_SQ2_N(ADC_CHANNEL_IN13)",
    ),
    (
        "alternate function of a capture",
        HARDWARE,
        "PAL_LINE(GPIOB, 4U), PAL_MODE_ALTERNATE(2)",
        "PAL_LINE(GPIOB, 4U), PAL_MODE_ALTERNATE(3)",
    ),
    (
        "pad of a capture: another of its bank",
        HARDWARE,
        "/* PB4 */ {PAL_LINE(GPIOB, 4U)",
        "/* PB4 */ {PAL_LINE(GPIOB, 5U)",
    ),
    (
        "alternate function of a bus",
        HARDWARE,
        "PAL_LINE(GPIOB, 8U), PAL_MODE_ALTERNATE(4)",
        "PAL_LINE(GPIOB, 8U), PAL_MODE_ALTERNATE(9)",
    ),
    (
        "a bus is driven",
        HARDWARE,
        "PAL_MODE_ALTERNATE(4) | PAL_STM32_OTYPE_OPENDRAIN",
        "PAL_MODE_ALTERNATE(4)",
    ),
    ("pull of a contact is left out", HARDWARE, "PAL_MODE_INPUT_PULLUP", "PAL_MODE_INPUT"),
    (
        "pull of a contact to the other side",
        HARDWARE,
        "PAL_MODE_INPUT_PULLUP",
        "PAL_MODE_INPUT_PULLDOWN",
    ),
    (
        "pull of a serial input is left out",
        HARDWARE,
        "PAL_MODE_ALTERNATE(7) | PAL_STM32_PUPDR_PULLUP",
        "PAL_MODE_ALTERNATE(7)",
    ),
    ("a pad is left out", HARDWARE, "    /* PD0 */ {", "    // {"),
    (
        "alternate function of the motor",
        HARDWARE,
        "PAL_LINE(GPIOE, 5U), PAL_MODE_ALTERNATE(3)",
        "PAL_LINE(GPIOE, 5U), PAL_MODE_ALTERNATE(1)",
    ),
    (
        "alternate function of a track of the encoder",
        HARDWARE,
        "PAL_LINE(GPIOE, 11U), PAL_MODE_ALTERNATE(1)",
        "PAL_LINE(GPIOE, 11U), PAL_MODE_ALTERNATE(2)",
    ),
    (
        "chip select is an input",
        HARDWARE,
        "PAL_LINE(GPIOC, 13U), PAL_MODE_OUTPUT_PUSHPULL",
        "PAL_LINE(GPIOC, 13U), PAL_MODE_INPUT",
    ),
    (
        "two analog sensors are swapped",
        HARDWARE,
        ".group = 0U, .column = 0U}",
        ".group = 0U, .column = 1U}",
    ),
    (
        "number of samples in the sum",
        HARDWARE,
        ".element = 0U, .samples = 32U",
        ".element = 0U, .samples = 16U",
    ),
    ("full scale", HARDWARE, ".full = 4095U", ".full = 1023U"),
    ("address of a chip", HARDWARE, ".address = 0x70U", ".address = 0x71U"),
    ("register of a chip", HARDWARE, "rear_select_0[] = {0x02U}", "rear_select_0[] = {0x03U}"),
    ("trigger of a chip", HARDWARE, "{0x00U, 0x51U}", "{0x00U, 0x50U}"),
    ("wait for a chip", HARDWARE, ".wait_ms = 65U", ".wait_ms = 6U"),
    (
        "length of a reading",
        HARDWARE,
        ".wait_ms = 65U,\n        .length = 2U",
        ".wait_ms = 65U,\n        .length = 1U",
    ),
    (
        "byte order of a chip",
        HARDWARE,
        ".word_bytes = 2U,\n                .is_signed = true",
        ".word_bytes = 2U,\n                .little_endian = true,\n                .is_signed = true",
    ),
    ("sign of a chip's words", HARDWARE, "                .is_signed = true,\n", ""),
    (
        "where a chip's values begin",
        HARDWARE,
        "imu_select_0[] = {0x3bU}",
        "imu_select_0[] = {0x3dU}",
    ),
    (
        "what is written to set up a chip: another identity",
        HARDWARE,
        "imu_identity_expected[] = {0x68U}",
        "imu_identity_expected[] = {0x70U}",
    ),
    (
        "SCL and SDA for the recovery",
        HARDWARE,
        ".scl = PAL_LINE(GPIOB, 8U)",
        ".scl = PAL_LINE(GPIOB, 7U)",
    ),
    ("clock of a bus", HARDWARE, ".clock_speed = 400000U", ".clock_speed = 100000U"),
    ("register on SPI", HARDWARE, "angle_select_0[] = {0x3fU}", "angle_select_0[] = {0x3eU}"),
    ("mode of SPI", HARDWARE, " | SPI_CR1_CPHA", ""),
    ("byte order of a serial message", HARDWARE, "                .little_endian = true,\n", ""),
    (
        "place in a serial message",
        HARDWARE,
        ".format = UP_FORMAT_BINARY,\n        .byte = 0U",
        ".format = UP_FORMAT_BINARY,\n        .byte = 2U",
    ),
    ("speed of a serial port", HARDWARE, ".speed = 115200U", ".speed = 57600U"),
    ("checksum of a message", HARDWARE, "UP_CHECKSUM_SUM8", "UP_CHECKSUM_XOR8"),
    ("identifier of a CAN frame", HARDWARE, ".identifier = 0x120U", ".identifier = 0x121U"),
    ("filter of a CAN frame", HARDWARE, "0x120U << 21, 0x120U << 21", "0x121U << 21, 0x121U << 21"),
    (
        "place in a CAN frame",
        HARDWARE,
        ".byte = 2U,\n        .is_extended",
        ".byte = 3U,\n        .is_extended",
    ),
    ("bit rate of a CAN bus", HARDWARE, ".bitrate_hz = 500000U", ".bitrate_hz = 250000U"),
    ("divider of a timer that measures", HARDWARE, ".frequency = 1000000U", ".frequency = 500000U"),
    (
        "edge of a measured pulse",
        HARDWARE,
        ".mode = ICU_INPUT_ACTIVE_HIGH,\n    .frequency = 1000000U",
        ".mode = ICU_INPUT_ACTIVE_LOW,\n    .frequency = 1000000U",
    ),
    (
        "capture channel",
        HARDWARE,
        ".width_cb = steering_on_width,\n    .overflow_cb = up_icu_on_overflow,\n    .channel = ICU_CHANNEL_1",
        ".width_cb = steering_on_width,\n    .overflow_cb = up_icu_on_overflow,\n    .channel = ICU_CHANNEL_2",
    ),
    ("another timer", HARDWARE, "up_icu_start(&ICUD3, ", "up_icu_start(&ICUD2, "),
    ("phase of the encoder", ENCODER, "timer->CCER = 0U;", "timer->CCER = STM32_TIM_CCER_CC1P;"),
    ("edges of one track only", ENCODER, "STM32_TIM_SMCR_SMS(3U)", "STM32_TIM_SMCR_SMS(1U)"),
    ("level of a contact", HARDWARE, ".is_low_active = true", ".is_low_active = false"),
    ("inverted pulses", HARDWARE, "PWM_OUTPUT_ACTIVE_HIGH", "PWM_OUTPUT_ACTIVE_LOW"),
    ("shortest pulse", HARDWARE, ".width = {3000U, 6000U}", ".width = {3300U, 6000U}"),
    (
        "failsafe",
        HARDWARE,
        "void sense_failsafe(void) {\n  up_pwm_set_level(&motor_pwm, 5000U)",
        "void sense_failsafe(void) {\n  up_pwm_set_level(&motor_pwm, 0U)",
    ),
    (
        "DMA stream without the request",
        MCU,
        "STM32_DMA_STREAM_ID(2, 4)",
        "STM32_DMA_STREAM_ID(2, 1)",
    ),
];

/// Mistakes that nothing notices here, and why.
const UNSEEN: &[(&str, &str)] = &[
    (
        "number of samples in the sum",
        "without noise the mean of 16 is that of 32; the reader of `mutants.md` sees it.",
    ),
    (
        "full scale",
        "a converter of 12 bits has the full scale that the runtime computes with, so that nothing reads it.",
    ),
    (
        "SCL and SDA for the recovery",
        "only a bus that hangs is recovered; the reader of `mutants.md` sees it.",
    ),
];

/// The checks that noticed the mistake, in words; empty if none did.
fn noticed(tree: &Path, board: &Path) -> String {
    match made(tree, board) {
        None => "compiler".to_owned(),
        Some(image) => noticed_by(System::Chibios, &image),
    }
}

/// The image built from a board's folder; `None` if the compiler refuses it or warns.
pub(super) fn made(tree: &Path, board: &Path) -> Option<Vec<u8>> {
    let mut make = Command::new("make");
    make.current_dir(board).args(["-j2", "UP_MODE=production", "USE_LTO=no"]);
    let output = make.arg(format!("CHIBIOS={}", tree.display())).output().unwrap();
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    let is_made = output.status.success() && !said.contains("warning");
    is_made.then(|| super::trial::image(board))
}

/// The checks that noticed that a program is wrong, in words; empty if none did.
pub(super) fn noticed_by(system: System, image: &[u8]) -> String {
    noticed_in(&run(system, (&rover(), &rover_world()), image, SECONDS, &[]))
}

/// The checks that noticed a mistake in a run; empty if none did.
pub(super) fn noticed_in(trial: &Trial) -> String {
    if let Some(halt) = &trial.halt {
        return format!("the program stops: {}", halt.why);
    }
    let mut all = Vec::new();
    let misled: Vec<String> =
        trial.misled.iter().map(|one| format!("{} of {}", one.place, one.title)).collect();
    if !misled.is_empty() {
        all.push(format!("pads and ports ({})", misled.join(", ")));
    }
    for one in &trial.misled {
        eprintln!("    {} of {} is {}, not {}", one.place, one.title, one.found, one.expected);
    }
    trial.wrong().iter().chain(&trial.outputs).for_each(|one| eprintln!("    {one}"));
    let wrong = trial.judged.iter().filter(|one| one.wrong > 0 || one.reports == 0);
    let wrong: Vec<&str> = wrong.map(|one| one.name.as_str()).collect();
    if !wrong.is_empty() {
        all.push(format!("judge ({})", wrong.join(", ")));
    }
    if !trial.outputs.is_empty() {
        all.push("outputs (Motor)".to_owned());
    }
    all.join(", ")
}

/// The table of a section, and the mistakes in it that nothing notices.
pub(super) fn table(rows: &[(&str, String)], unseen: &[(&str, &str)]) -> String {
    let mut table = "| mistake | noticed by |\n| --- | --- |\n".to_owned();
    for (what, by) in rows {
        table.push_str(&format!("| {what} | {} |\n", if by.is_empty() { "nobody" } else { by }));
    }
    let of_all = rows.len();
    let survivors: Vec<&str> =
        rows.iter().filter(|row| row.1.is_empty()).map(|row| row.0).collect();
    table.push_str(&format!("\n{} of {of_all} are noticed.\n", of_all - survivors.len()));
    for what in survivors {
        let why = unseen.iter().find(|one| one.0 == what).map_or("", |one| one.1);
        assert!(!why.is_empty(), "nobody notices {what}");
        table.push_str(&format!("\n- **{what}**: {why}"));
    }
    format!("{}\n", table.trim_end())
}

const HEADING: &str = "In C, when it runs";

const INTRO: &str = "\
A rover with one device of each kind (`tests/firmware/trial/rover.sense`) is generated for ChibiOS. Each mistake is put
into that code, alone; the program is built and runs on the [twin](twin.md) for two seconds, in a world where everything
moves. Written by `tests/tests/firmware/twin/seeded.rs`. What a reader of the files notices without running them is in
[mutants.md](mutants.md).

";

#[test]
fn mistakes_are_noticed() {
    let Some(tree) = tree() else { return };
    let board = folder("seeded", &rover());
    let is_whole = sensedsl_tests::is_exhaustive();
    assert_eq!(noticed(&tree, &board), "", "the rover is wrong without a mistake");
    let mut rows = Vec::new();
    for (what, file, find, with) in SEEDS.iter().take(if is_whole { COUNT } else { 3 }) {
        let path = board.join(file);
        let text = std::fs::read_to_string(&path).unwrap();
        assert!(text.contains(find), "{what}: {file} has no `{find}`");
        std::fs::write(&path, text.replacen(find, with, 1)).unwrap();
        let by = noticed(&tree, &board);
        std::fs::write(&path, text).unwrap();
        eprintln!("{what}: {by}");
        rows.push((*what, by));
    }
    let table = table(&rows, UNSEEN);
    if is_whole {
        assert_section("docs/seeded-mistakes.md", HEADING, &format!("{INTRO}{table}"));
    }
}

/// The text that each mistake replaces must exist, so that the list follows the templates.
#[test]
fn mistakes_are_of_texts_that_are_there() {
    let board = folder("seeded-texts", &rover());
    for (what, file, find, _) in SEEDS {
        let text = std::fs::read_to_string(board.join(file)).unwrap();
        assert!(text.contains(find), "{what}: {file} has no `{find}`");
    }
}
