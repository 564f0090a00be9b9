//! The systems that firmware is generated for.
//!
//! In: a [`BoardJob`], which names no system. Out: the files of one board, or what cannot be. A system is a folder
//! in `firmware/`, listed in [`TARGETS`]; its profiles are data. What a system lacks is a gap: it is told,
//! and there is no firmware at all, but everything beside the firmware can still be made.

use sensedsl_board::catalog;
use sensedsl_board::profile::TargetProfile;
use sensedsl_diagnostics::Diagnostic;
use sensedsl_diagnostics::codes::{e0501_no_generator, e0504_no_firmware_target};
use sensedsl_model::design::{Design, Device};
use sensedsl_model::kind::KindName;
use sensedsl_model::protocol::Filter;
use sensedsl_wiring::assignment::Assignment;

use crate::fileset::FileSet;
pub use crate::firmware::TARGETS;
use crate::job::{BoardJob, jobs};

/// A system that firmware is generated for.
pub trait Target: Sync {
    /// Its name on the command line and the start of its profiles' names.
    fn name(&self) -> &'static str;
    /// Why there is no firmware for any design on such a board, in words that follow a colon.
    fn refusal(&self, profile: &TargetProfile, facts: Option<&catalog::Board>) -> Option<String>;
    /// What is wrong with the `[system]` part of a profile, which only this target reads; empty when all is well.
    fn problems(&self, profile: &TargetProfile) -> Vec<String>;
    /// The kinds of devices that it serves.
    fn kinds(&self) -> Vec<KindName>;
    /// The firmware of one board, relative to the board's folder.
    ///
    /// # Errors
    ///
    /// What the hardware or the system cannot do. It is asked even where there are gaps, so that everything is
    /// told at once, and leaves out of its plan the devices of a kind that it does not serve.
    fn generate(&self, job: &BoardJob<'_>) -> Result<FileSet, Vec<Diagnostic>>;
    /// The command that builds the firmware in `folder`, which is spelled as a shell takes it.
    fn build(&self, folder: &str) -> String;
}

/// The system of a profile.
#[must_use]
pub fn of(profile: &TargetProfile) -> Option<&'static dyn Target> {
    TARGETS.iter().copied().find(|target| target.name() == profile.system())
}

/// The system that a board gets its firmware from, or why there is none.
///
/// # Errors
///
/// Why there is none, in words that follow a colon.
pub fn serving(
    profile: Option<&TargetProfile>,
    facts: Option<&catalog::Board>,
) -> Result<&'static dyn Target, String> {
    let profile = profile.ok_or("its target is `none`")?;
    let target = of(profile);
    let target = target.ok_or_else(|| format!("there is no generator for {}", profile.system()))?;
    target.refusal(profile, facts).map_or(Ok(target), Err)
}

/// What a board's system lacks for it.
#[must_use]
pub fn gaps(job: &BoardJob<'_>) -> Vec<Diagnostic> {
    let mut gaps = Vec::new();
    if let Err(why) = serving(job.profile, job.board.facts.as_ref()) {
        let name = &job.board.name;
        gaps.push(e0504_no_firmware_target::no_firmware_target(name.span, &name.value, &why));
    }
    if let Some(target) = job.profile.and_then(of) {
        gaps.extend(missing_kinds(target, job));
    }
    // All values of a chip have one thing to say.
    let unmade = job.devices.iter().filter_map(|one| unmade(job.design, one.device));
    for gap in unmade {
        if gaps.last() != Some(&gap) {
            gaps.push(gap);
        }
    }
    gaps
}

/// What a device needs and no system's firmware does yet: without it the values would be wrong, or none.
fn unmade(design: &Design, device: &Device) -> Option<Diagnostic> {
    let part = design.part(device.part)?;
    let coding = &device.coding;
    let (at, what) = if part.chip.is_some() {
        (part.name.span, "chips")
    } else if device.connections.len() > 1 {
        (device.value.span, "arrays with a wire for each element")
    } else if !coding.is_plain() {
        (device.name.span, "values that are part of a word, packed, in a text or with checksums")
    } else if is_filtered(device) {
        (device.name.span, "`invalid`, `median`, `smooth`, `change` and `heartbeat`")
    } else {
        return None;
    };
    let name = if part.chip.is_some() { &part.name.value } else { &device.name.value };
    Some(e0501_no_generator::not_made_yet(at, name, what))
}

/// Whether the board is to hold values back or to change them. What only a driver of a plain device calls invalid
/// is reported as it is measured, as it was before drivers could say so.
fn is_filtered(device: &Device) -> bool {
    let filter = &device.filter;
    let others = Filter { invalid: Vec::new(), invalid_span: None, ..filter.clone() };
    filter.invalid_span.is_some() || !others.is_empty()
}

fn missing_kinds(target: &dyn Target, job: &BoardJob<'_>) -> Vec<Diagnostic> {
    let kinds = target.kinds();
    let can: Vec<&str> = kinds.iter().map(|kind| kind.name()).collect();
    let devices = job.devices.iter().map(|one| one.device);
    let missing = devices.filter(|device| !kinds.contains(&device.kind.name()));
    let tell = |kind: KindName, span| {
        e0501_no_generator::no_generator(span, &kind.with_article(), &can.join(", "))
    };
    missing.map(|device| tell(device.kind.name(), device.kind_span)).collect()
}

/// The firmware of all boards, each in a folder of its name.
///
/// # Errors
///
/// What is lacking for any of them: there is all of the firmware or none.
pub fn firmware(design: &Design, wiring: &Assignment) -> Result<FileSet, Vec<Diagnostic>> {
    let mut files = FileSet::default();
    let mut diagnostics = Vec::new();
    for job in jobs(design, wiring) {
        diagnostics.extend(gaps(&job));
        let Ok(target) = serving(job.profile, job.board.facts.as_ref()) else { continue };
        diagnostics.extend(sensedsl_timing::refusals_of(design, job.board, job.wiring));
        match target.generate(&job) {
            Ok(one) => files.merge_under(&job.board.name.value, one),
            Err(reports) if reports.is_empty() => {
                let (name, why) = (&job.board.name, "a name that it needs is not in its profile");
                let report =
                    e0504_no_firmware_target::no_firmware_target(name.span, &name.value, why);
                diagnostics.push(report);
            }
            Err(reports) => diagnostics.extend(reports),
        }
    }
    if diagnostics.is_empty() { Ok(files) } else { Err(diagnostics) }
}
