//! The systems that firmware is generated for.
//!
//! In: a [`BoardJob`], which depends on no system. Out: the files of one board, or what is impossible. A system is a
//! crate that implements [`Target`], and a line of [`TARGETS`]; its profiles are data. What a system lacks is a gap: it
//! is reported, and then no firmware is generated, but everything besides the firmware still can be.

use sensedsl_board::catalog;
use sensedsl_board::profile::{self, TargetProfile};
use sensedsl_diagnostics::codes::{
    e0501_no_generator, e0504_no_firmware_target, e0574_does_not_fit, w0601_unused_property,
    w0615_no_firmware,
};
use sensedsl_diagnostics::{Diagnostic, Severity};
use sensedsl_model::design::{Design, Device};
use sensedsl_model::{drop_allowed, sort};
use sensedsl_wiring::assignment::Assignment;

use sensedsl_files::FileSet;
use sensedsl_firmware_arduino::Arduino;
use sensedsl_firmware_chibios::Chibios;
use sensedsl_firmware_embassy::Embassy;
use sensedsl_job::{BoardJob, JobConnection, Target, jobs};

/// All systems, in the order in which they are documented.
pub const TARGETS: &[&dyn Target] = &[&Chibios, &Embassy, &Arduino];

/// The system of a profile.
#[must_use]
pub fn of(profile: &TargetProfile) -> Option<&'static dyn Target> {
    TARGETS.iter().copied().find(|target| target.name() == profile.system())
}

/// The system that generates a board's firmware.
///
/// # Errors
///
/// The reason why there is none, worded to follow a colon.
pub fn serving(
    profile: Option<&TargetProfile>,
    facts: Option<&catalog::Board>,
) -> Result<&'static dyn Target, String> {
    let profile = profile.ok_or("its target is `none`")?;
    let target = of(profile);
    let target = target.ok_or_else(|| format!("there is no generator for {}", profile.system()))?;
    target.refusal(profile, facts).map_or(Ok(target), Err)
}

/// The systems for which there is firmware for a built-in board, with their versions, the usual one first.
#[must_use]
pub fn systems_of(board: &catalog::Entry) -> Vec<&'static str> {
    let facts = board.board().ok();
    let names = profile::names();
    let mut systems = Vec::new();
    for name in names.iter().filter_map(|name| profile::full_name(name)) {
        if !systems.contains(&name) {
            systems.push(name);
        }
    }
    systems.retain(|name| match profile::find(name, board.mcu) {
        Ok(profile::Target::Profile(profile)) => serving(Some(&profile), facts.as_ref()).is_ok(),
        Ok(profile::Target::None) | Err(_) => false,
    });
    systems
}

/// The gaps of a board: what its system lacks for it.
#[must_use]
pub fn gaps(job: &BoardJob<'_>) -> Vec<Diagnostic> {
    let mut gaps = Vec::new();
    if let Err(why) = serving(job.profile, job.board.facts.as_ref()) {
        let name = &job.board.name;
        gaps.push(e0504_no_firmware_target::no_firmware_target(name.span, &name.value, &why));
    }
    if let Some((target, profile)) = job.profile.and_then(|one| Some((of(one)?, one))) {
        gaps.extend(missing_kinds(target, profile, job));
        // All wires of a chip or an array give the same report.
        for gap in job.connections.iter().filter_map(|one| unmade(target, job, one)) {
            if gaps.last() != Some(&gap) {
                gaps.push(gap);
            }
        }
    }
    gaps
}

/// A diagnostic for what a connection needs and the target does not support.
fn unmade(
    target: &dyn Target,
    job: &BoardJob<'_>,
    connection: &JobConnection<'_>,
) -> Option<Diagnostic> {
    let what = target.lacks(job, connection)?;
    let name = &connection.part.name;
    Some(e0501_no_generator::not_made_yet(name.span, &name.value, what))
}

/// The parameters that should be kept over a reset and are not.
fn forgotten(job: &BoardJob<'_>, profile: &TargetProfile) -> Vec<Diagnostic> {
    if of(profile).is_none_or(Target::keeps_parameters) {
        return Vec::new();
    }
    let stored = job.devices.iter().map(|one| one.device);
    let stored = stored.filter(|one| one.kind.code().is_some_and(|code| code.is_stored));
    let warn = |one: &Device| {
        w0601_unused_property::not_stored(one.name.span, &one.name.value, profile.system())
    };
    stored.map(warn).collect()
}

/// What does not fit the MCU's memory is wrong whatever generates; all else may have firmware of another system.
fn foreseen(gap: Diagnostic, system: &str) -> Diagnostic {
    if gap.code == e0574_does_not_fit::CODE {
        gap
    } else {
        w0615_no_firmware::no_firmware(gap, system)
    }
}

fn missing_kinds(
    target: &dyn Target,
    profile: &TargetProfile,
    job: &BoardJob<'_>,
) -> Vec<Diagnostic> {
    let kinds = target.kinds(profile);
    let can: Vec<&str> = kinds.iter().map(|kind| kind.name()).collect();
    let is_missing = |one: &&JobConnection<'_>| !kinds.contains(&one.connection.kind.name());
    let missing = job.connections.iter().filter(is_missing);
    let mut all: Vec<Diagnostic> = Vec::new();
    for one in missing {
        let device = job.design.device(one.connection.device);
        let at = device.map_or(one.part.name.span, |device| device.kind_span);
        let kind = one.connection.kind.name().with_article();
        let gap = e0501_no_generator::no_generator(at, &kind, &can.join(", "));
        if all.last() != Some(&gap) {
            all.push(gap);
        }
    }
    all
}

/// The firmware of all boards, each in a folder named after it.
///
/// # Errors
///
/// Returns what is lacking for any of them: firmware is generated for all boards or for none.
pub fn firmware(design: &Design, wiring: &Assignment) -> Result<FileSet, Vec<Diagnostic>> {
    let mut files = FileSet::default();
    let mut diagnostics = Vec::new();
    for job in jobs(design, wiring) {
        match of_board(&job) {
            Ok(one) => files.merge_under(&job.board.name.value, one),
            Err(reports) => diagnostics.extend(reports),
        }
    }
    if diagnostics.is_empty() { Ok(files) } else { Err(diagnostics) }
}

/// The firmware of one board.
fn of_board(job: &BoardJob<'_>) -> Result<FileSet, Vec<Diagnostic>> {
    let mut diagnostics = gaps(job);
    let Ok(target) = serving(job.profile, job.board.facts.as_ref()) else {
        return Err(diagnostics);
    };
    diagnostics.extend(sensedsl_timing::refusals_of(job.design, job.board, job.wiring));
    match target.generate(job) {
        Ok(files) if diagnostics.is_empty() => return Ok(files),
        Ok(_) => {}
        Err(reports) if reports.is_empty() => {
            let (name, why) = (&job.board.name, "a name that it needs is not in its profile");
            let report = e0504_no_firmware_target::no_firmware_target(name.span, &name.value, why);
            diagnostics.push(report);
        }
        Err(reports) => diagnostics.extend(reports),
    }
    Err(diagnostics)
}

/// Adds what [`firmware`] would reject to the diagnostics of a design, as warnings for users who do not generate yet, and
/// what it would not do. A board whose target is `none` wants no firmware, and a design with errors gets none.
pub fn foresee(design: &Design, wiring: &Assignment, reported: &mut Vec<Diagnostic>) {
    if reported.iter().any(|one| one.severity == Severity::Error) {
        return;
    }
    let is_known = |gap: &Diagnostic| {
        reported.iter().any(|one| (one.code, one.primary.span) == (gap.code, gap.primary.span))
    };
    let mut found = Vec::new();
    for job in jobs(design, wiring) {
        let Some(profile) = job.profile else { continue };
        let gaps = of_board(&job).err().unwrap_or_default();
        let gaps = gaps.into_iter().filter(|gap| !is_known(gap));
        found.extend(gaps.map(|gap| foreseen(gap, profile.system())));
        found.extend(forgotten(&job, profile));
    }
    drop_allowed(design, &mut found);
    if !found.is_empty() {
        reported.append(&mut found);
        sort(reported);
    }
}
