//! Embassy firmware: a Cargo project in Rust, with the HAL's typed pins.
//!
//! In: a [`BoardJob`]. Out: a folder with a manifest, a lock file, `src/wiring.rs`, `src/main.rs`, `src/user.rs` and a copy of the
//! runtime. `names.rs` reads how the HAL spells what a profile knows; `typed.rs` puts a wiring, of whatever target, into
//! types that the Rust compiler judges.

mod cargo;
mod clock;
mod link;
mod names;
mod typed;

use sensedsl_board::catalog;
use sensedsl_board::profile::TargetProfile;
use sensedsl_diagnostics::Diagnostic;
use sensedsl_model::kind::KindName;

use crate::fileset::FileSet;
use crate::job::{BoardJob, JobConnection};
use crate::target::Target;
pub use names::{Chip, Names};
pub use typed::{Judged, TypeCheck, profile_of, type_check};

/// The target `embassy`.
pub struct Embassy;

impl Target for Embassy {
    fn name(&self) -> &'static str {
        "embassy"
    }

    fn refusal(&self, profile: &TargetProfile, _facts: Option<&catalog::Board>) -> Option<String> {
        Names::of(profile).err().map(|message| format!("its profile is damaged: {message}"))
    }

    fn problems(&self, profile: &TargetProfile) -> Vec<String> {
        match Names::of(profile) {
            Ok(names) => names.problems(profile),
            Err(message) => vec![message],
        }
    }

    fn kinds(&self, _profile: &TargetProfile) -> Vec<KindName> {
        vec![KindName::Analog, KindName::I2c, KindName::Icu]
    }

    fn lacks(&self, _job: &BoardJob<'_>, _one: &JobConnection<'_>) -> Option<&'static str> {
        None
    }

    fn generate(&self, _job: &BoardJob<'_>) -> Result<FileSet, Vec<Diagnostic>> {
        Err(Vec::new())
    }

    fn build(&self, folder: &str) -> String {
        format!("cargo build --release --manifest-path {folder}/Cargo.toml")
    }
}
