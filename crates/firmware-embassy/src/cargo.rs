//! Manifests: which crates are built, with which features; and which lock file goes with them.

use std::collections::BTreeSet;

use askama::Template;
use sensedsl_files::print;

use super::context::Context;
use super::hal::Hal;
use super::lock::lock;
use super::names::Chip;
use sensedsl_job::BoardJob;
use sensedsl_job::part::uses;

/// The manifest of a check.
#[derive(Template)]
#[template(path = "templates/check.toml.txt", escape = "none")]
struct Check<'a> {
    hal: &'a str,
    version: &'static str,
    features: String,
}

/// The manifest of a check on a chip of STM32. `timer`: the one left for the clock.
pub(super) fn check_manifest(job: &BoardJob<'_>, chip: &Chip, timer: Option<&str>) -> String {
    let timer = timer.map(|name| format!("time-driver-{}", name.to_lowercase()));
    let banks = chip.banks.then(|| "dual-bank".to_owned());
    let always = [chip.feature.as_str(), "exti", "time", "unstable-pac"].map(str::to_owned);
    let features: Vec<String> =
        always.into_iter().chain(banks).chain(split(job)).chain(timer).collect();
    let features = quoted(features.iter().map(String::as_str));
    print(&Check { hal: "stm32", version: STM32_VERSION, features })
}

/// The manifest of a check on a chip of RP.
pub(super) fn check_manifest_rp(chip: &Chip) -> String {
    let features = quoted([chip.feature.as_str(), "unstable-pac"].into_iter());
    print(&Check { hal: "rp", version: RP_VERSION, features })
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

/// The versions of the HALs.
const STM32_VERSION: &str = "0.6.0";
const RP_VERSION: &str = "0.10.0";

/// The features of `sense-embassy` that say which versions of the units an MCU has.
const VERSIONS: [&str; 9] =
    ["adc-v2", "can-banks", "can-fd", "gpio-v2", "i2c-v1", "i2c-v2", "otg", "usart-v1", "usart-v3"];

/// The manifests of a firmware and of the two crates in it.
pub(super) struct Manifests {
    pub(super) board: String,
    /// The HAL, as its crate is called behind `embassy-`.
    pub(super) hal: &'static str,
    pub(super) hal_version: &'static str,
    /// Features that the firmware needs of the HAL.
    pub(super) hal_features: String,
    /// Features that `sense-embassy` needs of the HAL.
    pub(super) own_hal_features: String,
    /// Features that the firmware needs of `sense-embassy`, and all that there are.
    pub(super) features: String,
    pub(super) all_features: Vec<&'static str>,
    /// Features that the firmware needs of `sense-rt`, and all that there are.
    pub(super) uses: String,
    pub(super) all_uses: Vec<&'static str>,
}

impl Manifests {
    /// `versions`: the features of `sense-embassy` that the units in use ask for.
    pub(super) fn new(context: &Context<'_>, versions: &BTreeSet<&'static str>) -> Self {
        let chip = context.chip.feature.clone();
        let (hal, hal_version, hal_features) = match context.names.hal {
            Hal::Stm32 => ("stm32", STM32_VERSION, stm32_features(context)),
            Hal::Rp => {
                ("rp", RP_VERSION, vec![chip, "time-driver".to_owned(), "unstable-pac".to_owned()])
            }
        };
        let own: &[&str] = match context.names.hal {
            Hal::Stm32 => &["exti", "unstable-pac"],
            Hal::Rp => &["unstable-pac"],
        };
        let features = ["runtime", hal].into_iter().chain(versions.iter().copied());
        let used = features_of_values(context.job).filter(|(_, is_used)| *is_used);
        Self {
            board: context.job.board.name.value.clone(),
            hal,
            hal_version,
            hal_features: quoted(hal_features.iter().map(String::as_str)),
            own_hal_features: quoted(own.iter().copied()),
            features: quoted(features),
            all_features: ["rp", "stm32"].into_iter().chain(VERSIONS).collect(),
            uses: quoted(used.map(|(name, _)| name)),
            all_uses: features_of_values(context.job).map(|(name, _)| name).collect(),
        }
    }
}

/// A list of TOML without its brackets: `"one", "two"`.
fn quoted<'a>(all: impl Iterator<Item = &'a str>) -> String {
    let quoted: Vec<String> = all.map(|one| format!("\"{one}\"")).collect();
    quoted.join(", ")
}

/// What a firmware needs of `embassy-stm32`.
fn stm32_features(context: &Context<'_>) -> Vec<String> {
    let banks = context.chip.banks.then(|| "dual-bank".to_owned());
    let timer = context.timer.iter().map(|one| format!("time-driver-{}", one.to_lowercase()));
    let always = ["exti", "memory-x", "unstable-pac"].map(str::to_owned);
    std::iter::once(context.chip.feature.clone())
        .chain(banks)
        .chain(split(context.job))
        .chain(timer)
        .chain(always)
        .collect()
}

/// The features that part pins whose analog side is a pin of its own, `PA1_C`, from their digital sides.
fn split(job: &BoardJob<'_>) -> BTreeSet<String> {
    let pads = job.connections.iter().flat_map(|one| &one.pads);
    let pins = pads.filter_map(|pad| pad.pin.name.as_str().strip_suffix("_C"));
    pins.map(|pin| format!("split-{}", pin.to_lowercase())).collect()
}

/// The features of `sense-rt`, and whether the board's values need them.
fn features_of_values(job: &BoardJob<'_>) -> impl Iterator<Item = (&'static str, bool)> {
    std::iter::once(("actuators", job.has_actuators())).chain(uses(job))
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
