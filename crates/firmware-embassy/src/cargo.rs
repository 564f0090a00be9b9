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
const RUNTIME_NEEDS: [&str; 6] = [
    "embassy-futures = \"=0.1.2\"",
    "embassy-sync = \"=0.8.0\"",
    "embassy-time = \"=0.5.1\"",
    "embassy-usb = { version = \"=0.6.0\", default-features = false }",
    "embedded-hal-async = \"=1.0.0\"",
    "embedded-io-async = \"=0.7.0\"",
];

/// What it needs on a Cortex-M beside that.
const CORTEX_M: &str =
    "cortex-m = { version = \"=0.7.7\", features = [\"critical-section-single-core\"] }";

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
    /// The lines of the firmware's dependencies.
    pub(super) needs: BTreeSet<String>,
    /// The crates that every interrupt goes through, with how they are optimised.
    pub(super) speeds: BTreeSet<(&'static str, &'static str)>,
    /// The lines of what `sense-embassy` needs.
    pub(super) runtime_needs: Vec<String>,
    /// All features of `sense-embassy`.
    pub(super) all_features: Vec<&'static str>,
    /// All features of `sense-rt`.
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
        let hal_features = quoted(hal_features.iter().map(String::as_str));
        let features = quoted(["runtime", hal.name].into_iter().chain(versions.iter().copied()));
        let used = features_of_values(context.job).filter(|(_, is_used)| *is_used);
        let uses = quoted(used.map(|(name, _)| name));
        let Package { crate_name, version, tick_hz, core, .. } = hal;
        let needs = core.needs.iter().map(|line| (*line).to_owned()).chain([
            format!("{crate_name} = {{ version = \"={version}\", features = [{hal_features}] }}"),
            "embassy-sync = \"=0.8.0\"".to_owned(),
            format!(
                "embassy-time = {{ version = \"=0.5.1\", features = [\"tick-hz-{tick_hz}\"] }}"
            ),
            format!("sense-embassy = {{ path = \"sense-embassy\", features = [{features}] }}"),
            format!("sense-rt = {{ path = \"sense-rt\", features = [{uses}] }}"),
            "static_cell = \"=2.1.1\"".to_owned(),
        ]);
        Self {
            board: context.job.board.name.value.clone(),
            hal,
            needs: needs.chain(project.needs(context)).collect(),
            speeds: core.speeds.iter().copied().chain([(*crate_name, "\"s\"")]).collect(),
            uf2_family: project.uf2_family(context).map(|family| format!("{family:#010x}")),
            runtime_needs: runtime_needs(hal),
            all_features: runtime_features(hal),
            all_uses: features_of_values(context.job).map(|(name, _)| name).collect(),
        }
    }
}

/// The lines of what `sense-embassy` needs under a HAL, in alphabetical order.
fn runtime_needs(hal: &Package) -> Vec<String> {
    let own = format!(
        "{} = {{ version = \"={}\", features = [{}] }}",
        hal.crate_name,
        hal.version,
        quoted(hal.runtime_asks.iter().copied())
    );
    let core = hal.core.is_cortex_m.then_some(&CORTEX_M);
    let needs = RUNTIME_NEEDS.iter().chain(hal.runtime_needs).chain(core);
    let needs = needs.map(|line| (*line).to_owned());
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
