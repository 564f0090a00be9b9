//! Manifests: which crates are built, with which features; and which lock file goes with them.

use std::collections::BTreeSet;

use super::context::Context;
use super::hal::Hal;
use super::lock::lock;
use super::names::Chip;
use sensedsl_job::BoardJob;
use sensedsl_job::part::uses;

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

/// The lock file of a check on a chip of STM32.
pub(super) fn check_lock(chip: &Chip, timer: Option<&str>) -> String {
    let clock = timer.map(|_| "clock");
    let all: Vec<&str> = ["check", "stm32"].into_iter().chain(timers(chip)).chain(clock).collect();
    lock("wiring-check", &all)
}

/// That of a check on a chip of RP.
pub(super) fn check_lock_rp() -> String {
    lock("wiring-check", &["check", "rp"])
}

/// The high-resolution timers of a chip, for which the HAL takes further crates.
fn timers(chip: &Chip) -> Option<&'static str> {
    let starts = |starts: &[&str]| starts.iter().any(|start| chip.feature.starts_with(start));
    if starts(&["stm32g474", "stm32g484"]) {
        Some("g4")
    } else if starts(&["stm32f334"]) {
        Some("f3")
    } else {
        None
    }
}

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
pub(super) fn firmware_lock(context: &Context<'_>) -> String {
    let hal = match context.names.hal {
        Hal::Stm32 => "stm32",
        Hal::Rp => "rp",
    };
    let all: Vec<&str> =
        ["firmware", "clock", hal].into_iter().chain(timers(&context.chip)).collect();
    lock("firmware", &all)
}
