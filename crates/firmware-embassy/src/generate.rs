//! A board's project from its job. In: the job, and all HALs. Out: the files, or why there are none.

use sensedsl_diagnostics::Diagnostic;
use sensedsl_diagnostics::codes::e0504_no_firmware_target::no_firmware_target;
use sensedsl_files::FileSet;
use sensedsl_job::BoardJob;

use super::context::Context;
use super::hal::Opened;
use super::hal::contract::Hal;
use super::{gaps, plan, render};

/// The files of a board's project.
pub(super) fn generate(
    job: &BoardJob<'_>,
    hals: &[&'static dyn Hal],
) -> Result<FileSet, Vec<Diagnostic>> {
    let board = &job.board.name;
    let lack = |why: &str| vec![no_firmware_target(board.span, &board.value, why)];
    let profile = job.profile.ok_or_else(|| lack("it has no target profile"))?;
    let Opened { names, hal, drivers } =
        Opened::new(profile, hals).map_err(|error| lack(&error))?;
    let chip = job.board.mcu.as_deref().and_then(|mcu| names.chip(mcu));
    let chip = chip.ok_or_else(|| lack("Embassy does not support its MCU"))?;
    if let Some(why) = drivers.project().refusal(job, profile) {
        return Err(lack(&why));
    }
    let served = gaps::served(&*drivers, job);
    let context = Context { job, profile, names: &names, chip, served };
    let mut diagnostics = Vec::new();
    let plan = plan::plan(&context, hal.package(), &*drivers, &mut diagnostics);
    if diagnostics.is_empty() { Ok(render::render(&plan)) } else { Err(diagnostics) }
}
