//! The interface of a system that firmware is generated for.

use sensedsl_board::catalog;
use sensedsl_board::profile::TargetProfile;
use sensedsl_diagnostics::Diagnostic;
use sensedsl_files::FileSet;
use sensedsl_model::kind::KindName;

use crate::{BoardJob, JobConnection};

/// A system that firmware is generated for.
pub trait Target: Sync {
    /// The name on the command line, with which the names of its profiles begin.
    fn name(&self) -> &'static str;
    /// Why there is no firmware for any design on such a board, worded to follow a colon; `None` if there is.
    fn refusal(&self, profile: &TargetProfile, facts: Option<&catalog::Board>) -> Option<String>;
    /// The mistakes in the `[system]` part of a profile, which only this target reads; empty if there are none.
    fn problems(&self, profile: &TargetProfile) -> Vec<String>;
    /// The kinds of devices that it serves on the MCUs of a profile.
    fn kinds(&self, profile: &TargetProfile) -> Vec<KindName>;
    /// What a connection of such a kind needs and this target has no code for, worded to follow "has no code for":
    /// without it the values would be wrong or missing.
    fn lacks(&self, job: &BoardJob<'_>, connection: &JobConnection<'_>) -> Option<&'static str>;
    /// Whether a parameter with `store = true` keeps its value when the board is reset.
    fn keeps_parameters(&self) -> bool;
    /// The firmware of one board, relative to the board's folder.
    ///
    /// # Errors
    ///
    /// Returns what the hardware or the system cannot do. This is called even when there are gaps, so that everything
    /// is reported at once; the plan then leaves out the devices of kinds that the target does not serve.
    fn generate(&self, job: &BoardJob<'_>) -> Result<FileSet, Vec<Diagnostic>>;
    /// The option that `sensedsl build` needs besides the folder; empty if none.
    fn build_option(&self) -> &'static str;
}
