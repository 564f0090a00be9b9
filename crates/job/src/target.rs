//! What a system is that firmware is generated for.

use sensedsl_board::catalog;
use sensedsl_board::profile::TargetProfile;
use sensedsl_diagnostics::Diagnostic;
use sensedsl_files::FileSet;
use sensedsl_model::kind::KindName;

use crate::{BoardJob, JobConnection};

/// A system that firmware is generated for.
pub trait Target: Sync {
    /// Its name on the command line and the start of its profiles' names.
    fn name(&self) -> &'static str;
    /// Why there is no firmware for any design on such a board, in words that follow a colon.
    fn refusal(&self, profile: &TargetProfile, facts: Option<&catalog::Board>) -> Option<String>;
    /// What is wrong with the `[system]` part of a profile, which only this target reads; empty when all is well.
    fn problems(&self, profile: &TargetProfile) -> Vec<String>;
    /// The kinds of devices that it serves on the MCUs of a profile.
    fn kinds(&self, profile: &TargetProfile) -> Vec<KindName>;
    /// What a connection of such a kind needs and no code is made for, in words that follow "has no code for": without
    /// it the values would be wrong, or none.
    fn lacks(&self, job: &BoardJob<'_>, connection: &JobConnection<'_>) -> Option<&'static str>;
    /// The firmware of one board, relative to the board's folder.
    ///
    /// # Errors
    ///
    /// What the hardware or the system cannot do. It is asked even where there are gaps, so that everything is
    /// told at once, and leaves out of its plan the devices of a kind that it does not serve.
    fn generate(&self, job: &BoardJob<'_>) -> Result<FileSet, Vec<Diagnostic>>;
    /// What `sensedsl build` has to be told beside the folder; empty where nothing.
    fn build_option(&self) -> &'static str;
}
