//! Manifests and lock files: which crates are built, in which versions, with which features.
//!
//! The lock files are part of this program, so that a project is built from the same sources everywhere and for good.

use std::collections::BTreeSet;

use super::context::Context;
use super::hal::Hal;
use super::names::Chip;
use sensedsl_job::BoardJob;
use sensedsl_job::part::uses;

/// The crates of a check.
const CHECK: &str = include_str!("templates/check.lock.txt");
/// As that, with the crates that the HAL takes for the high-resolution timers of STM32G4 and of STM32F3.
const CHECK_G4: &str = include_str!("templates/check-g4.lock.txt");
const CHECK_F3: &str = include_str!("templates/check-f3.lock.txt");
/// Those on the HAL of RP.
pub(super) const CHECK_RP: &str = include_str!("templates/check-rp.lock.txt");
/// What the lock file lacks where no timer is left for the clock.
const CLOCK: &str = " \"embassy-time-driver\",\n \"embassy-time-queue-utils\",\n";

/// The manifest of a check.
pub(super) fn check_manifest(job: &BoardJob<'_>, chip: &Chip, timer: Option<&str>) -> String {
    let timer = timer.map(|name| format!("time-driver-{}", name.to_lowercase()));
    let banks = chip.banks.then(|| "dual-bank".to_owned());
    let features = banks.into_iter().chain(split(job)).chain(timer);
    let features: Vec<String> = features.map(|one| format!(", \"{one}\"")).collect();
    format!(
        "[package]\nname = \"wiring-check\"\nversion = \"0.0.0\"\nedition = \"2024\"\npublish = false\n\n\
         [dependencies]\n\
         embassy-stm32 = {{ version = \"=0.6.0\", default-features = false, features = [\"{}\", \"exti\", \"time\", \
         \"unstable-pac\"{}] }}\n\
         embassy-time = \"=0.5.1\"\n\
         embassy-time-driver = {{ version = \"=0.2.2\", features = [\"tick-hz-1_000_000\"] }}\n\
         embassy-time-queue-utils = \"=0.3.2\"\n\n\
         [profile.dev]\npanic = \"abort\"\n\n[workspace]\n",
        chip.feature,
        features.concat(),
    )
}

/// The manifest of a check on the HAL of RP.
pub(super) fn check_manifest_rp(chip: &Chip) -> String {
    format!(
        "[package]\nname = \"wiring-check\"\nversion = \"0.0.0\"\nedition = \"2024\"\npublish = false\n\n\
         [dependencies]\n\
         embassy-rp = {{ version = \"=0.10.0\", default-features = false, features = [\"{}\", \"unstable-pac\"] }}\n\n\
         [profile.dev]\npanic = \"abort\"\n\n[workspace]\n",
        chip.feature,
    )
}

/// The lock file of a check.
pub(super) fn check_lock(chip: &Chip, timer: Option<&str>) -> String {
    let starts = |starts: &[&str]| starts.iter().any(|start| chip.feature.starts_with(start));
    let text = if starts(&["stm32g474", "stm32g484"]) {
        CHECK_G4
    } else if starts(&["stm32f334"]) {
        CHECK_F3
    } else {
        CHECK
    };
    if timer.is_some() { text.to_owned() } else { text.replacen(&hal_clock(text), "", 1) }
}

/// The lines of the clock's crates among those that the HAL needs.
fn hal_clock(text: &str) -> String {
    let of_hal = text.split_once("name = \"embassy-stm32\"").map_or("", |(_, rest)| rest);
    if of_hal.split("[[package]]").next().is_some_and(|own| own.contains(CLOCK)) {
        CLOCK.to_owned()
    } else {
        String::new()
    }
}

/// The crates of a firmware, and further ones of two families.
const FIRMWARE: &str = include_str!("templates/firmware.lock.txt");
const FIRMWARE_G4: &str = include_str!("templates/firmware-g4.lock.txt");
const FIRMWARE_F3: &str = include_str!("templates/firmware-f3.lock.txt");
/// Those on another HAL.
const FIRMWARE_RP: &str = include_str!("templates/firmware-rp.lock.txt");
/// How the manifest goes on behind the package.
const MANIFEST: &str = include_str!("templates/Cargo.toml.txt");

/// The manifest of a firmware.
pub(super) fn manifest(context: &Context<'_>) -> String {
    let hal = match context.names.hal {
        Hal::Stm32 => {
            let banks = if context.chip.banks { "\"dual-bank\", " } else { "" };
            let timer =
                context.timer.iter().map(|one| format!("\"time-driver-{}\", ", one.to_lowercase()));
            let split = split(context.job).into_iter().map(|one| format!("\"{one}\", "));
            format!(
                "embassy-stm32 = {{ version = \"=0.6.0\", features = [\"{}\", {banks}{}\"exti\", \"memory-x\", \
                 \"unstable-pac\"] }}",
                context.chip.feature,
                split.chain(timer).collect::<String>(),
            )
        }
        Hal::Rp => format!(
            "embassy-rp = {{ version = \"=0.10.0\", features = [\"{}\", \"time-driver\", \"unstable-pac\"] }}",
            context.chip.feature
        ),
    };
    let more = match context.names.hal {
        Hal::Stm32 => "embedded-can = \"=0.4.1\"\n",
        Hal::Rp => "fixed = \"=1.31.0\"\n",
    };
    MANIFEST
        .replace("{board}", &context.job.board.name.value)
        .replace("{hal}", &hal)
        .replace("{more}", more)
        .replace("{uses}", &used(context).join(", "))
}

/// The features that part pins whose analog side is a pin of its own, `PA1_C`, from their digital sides.
fn split(job: &BoardJob<'_>) -> BTreeSet<String> {
    let pads = job.connections.iter().flat_map(|one| &one.pads);
    let pins = pads.filter_map(|pad| pad.pin.name.as_str().strip_suffix("_C"));
    pins.map(|pin| format!("split-{}", pin.to_lowercase())).collect()
}

/// The features of the runtime, and whether the board needs them.
fn features(job: &BoardJob<'_>) -> impl Iterator<Item = (&'static str, bool)> {
    std::iter::once(("actuators", job.has_actuators())).chain(uses(job))
}

/// What the values need of the runtime.
fn used(context: &Context<'_>) -> Vec<String> {
    let used = features(context.job).filter(|(_, is_used)| *is_used);
    used.map(|(name, _)| format!("\"{name}\"")).collect()
}

/// The manifest of the runtime in a project.
pub(super) fn runtime_manifest(context: &Context<'_>) -> String {
    let mut text = "[package]\nname = \"sense-rt\"\nversion = \"0.1.0\"\nedition = \"2024\"\n\
                    license = \"MIT OR Apache-2.0\"\npublish = false\n\n[features]\n"
        .to_owned();
    for (name, _) in features(context.job) {
        text.push_str(&format!("{name} = []\n"));
    }
    text
}

/// The lock file of a firmware.
pub(super) fn lock(context: &Context<'_>) -> String {
    if context.names.hal == Hal::Rp {
        return FIRMWARE_RP.to_owned();
    }
    let starts =
        |starts: &[&str]| starts.iter().any(|start| context.chip.feature.starts_with(start));
    let text = if starts(&["stm32g474", "stm32g484"]) {
        FIRMWARE_G4
    } else if starts(&["stm32f334"]) {
        FIRMWARE_F3
    } else {
        FIRMWARE
    };
    text.to_owned()
}
