//! Manifests: which crates are built, with which features; and which lock file goes with them.
//!
//! In: the board, and what its HAL asks for. Out: the lines of the manifests, which templates print.

use std::collections::BTreeSet;

use askama::Template;
use sensedsl_files::print;

use super::context::Context;
use super::hal::HALS;
use super::hal::contract::types::Types;
use super::hal::contract::{Package, Project};
use super::lock::lock;
use sensedsl_job::BoardJob;
use sensedsl_job::part::uses;

/// What `sense-embassy` needs under any HAL, besides what its template has.
const RUNTIME_NEEDS: [&str; 7] = [
    "cortex-m = { version = \"=0.7.7\", features = [\"critical-section-single-core\"] }",
    "embassy-futures = \"=0.1.2\"",
    "embassy-sync = \"=0.8.0\"",
    "embassy-time = \"=0.5.1\"",
    "embassy-usb = { version = \"=0.6.0\", default-features = false }",
    "embedded-hal-async = \"=1.0.0\"",
    "embedded-io-async = \"=0.7.0\"",
];

/// The manifest of a check of types.
#[derive(Template)]
#[template(path = "templates/check.toml.txt", escape = "none")]
struct Check<'a> {
    hal: &'a Package,
    features: String,
}

/// The manifest of a check of types.
pub(super) fn check_manifest(context: &Context<'_>, hal: &Package, types: &dyn Types) -> String {
    let features = types.features(context);
    print(&Check { hal, features: quoted(features.iter().map(String::as_str)) })
}

/// The lock file of a check of types.
pub(super) fn check_lock(context: &Context<'_>, hal: &Package, types: &dyn Types) -> String {
    let own = types.lock_tags(context);
    let all: Vec<&str> = ["check", hal.name].into_iter().chain(own).collect();
    lock("wiring-check", &all)
}

/// The lock file of a firmware.
pub(super) fn firmware_lock(context: &Context<'_>, hal: &Package, project: &dyn Project) -> String {
    let own = project.lock_tags(&context.chip);
    let all: Vec<&str> = ["firmware", "clock", hal.name].into_iter().chain(own).collect();
    lock("firmware", &all)
}

/// The manifests of a firmware and of the two crates in it.
pub(super) struct Manifests {
    pub(super) board: String,
    pub(super) hal: &'static Package,
    /// The family of the chip in UF2 files, as a number of TOML.
    pub(super) uf2_family: Option<String>,
    /// The features that the firmware needs of the HAL.
    pub(super) hal_features: String,
    /// The lines of what `sense-embassy` needs.
    pub(super) runtime_needs: Vec<String>,
    /// The features that the firmware needs of `sense-embassy`, and all that there are.
    pub(super) features: String,
    pub(super) all_features: Vec<&'static str>,
    /// The features that the firmware needs of `sense-rt`, and all that there are.
    pub(super) uses: String,
    pub(super) all_uses: Vec<&'static str>,
}

impl Manifests {
    /// The manifests. `versions` has the features of `sense-embassy` that the units in use ask for.
    pub(super) fn new(
        context: &Context<'_>,
        hal: &'static Package,
        project: &dyn Project,
        versions: &BTreeSet<&'static str>,
    ) -> Self {
        let hal_features = project.features(context);
        let features = ["runtime", hal.name].into_iter().chain(versions.iter().copied());
        let used = features_of_values(context.job).filter(|(_, is_used)| *is_used);
        Self {
            board: context.job.board.name.value.clone(),
            hal,
            uf2_family: project.uf2_family(context).map(|family| format!("{family:#010x}")),
            hal_features: quoted(hal_features.iter().map(String::as_str)),
            runtime_needs: runtime_needs(hal),
            features: quoted(features),
            all_features: runtime_features(hal),
            uses: quoted(used.map(|(name, _)| name)),
            all_uses: features_of_values(context.job).map(|(name, _)| name).collect(),
        }
    }
}

/// The lines of what `sense-embassy` needs under a HAL, in alphabetical order.
fn runtime_needs(hal: &Package) -> Vec<String> {
    let own = format!(
        "embassy-{} = {{ version = \"={}\", features = [{}] }}",
        hal.name,
        hal.version,
        quoted(hal.runtime_asks.iter().copied())
    );
    let needs = RUNTIME_NEEDS.iter().chain(hal.runtime_needs).map(|line| (*line).to_owned());
    let lines: BTreeSet<String> = needs.chain([own]).collect();
    lines.into_iter().collect()
}

/// All features of `sense-embassy`: one for each HAL, and those for the versions of units.
fn runtime_features(hal: &'static Package) -> Vec<&'static str> {
    let all = || HALS.iter().map(|one| one.package()).chain([hal]);
    let names: BTreeSet<&str> = all().map(|one| one.name).collect();
    let versions: BTreeSet<&str> =
        all().flat_map(|one| one.runtime_features.iter().copied()).collect();
    names.into_iter().chain(versions).collect()
}

/// A list of TOML without its brackets: `"one", "two"`.
fn quoted<'a>(all: impl Iterator<Item = &'a str>) -> String {
    let quoted: Vec<String> = all.map(|one| format!("\"{one}\"")).collect();
    quoted.join(", ")
}

/// The features of `sense-rt`, and whether the board's values need them.
fn features_of_values(job: &BoardJob<'_>) -> impl Iterator<Item = (&'static str, bool)> {
    std::iter::once(("actuators", job.has_actuators())).chain(uses(job))
}
