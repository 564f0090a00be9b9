//! Embassy firmware: a Cargo project in Rust, with the HAL's typed pins.
//!
//! In: a [`BoardJob`]. Out: a folder with a manifest, a lock file, `src/wiring.rs`, `src/main.rs`, `src/user/` and a
//! copy of the runtime. What one HAL of Embassy needs is in its folder of `hal/`; a file for each kind of device plans
//! what is the same under all HALs. `typed.rs` puts a wiring of any target into types that the Rust compiler judges.
//!
//! # Example
//!
//! ```
//! use sensedsl_firmware_embassy::Embassy;
//! use sensedsl_job::{Target as _, jobs};
//! use sensedsl_model::{NoFiles, Request, resolve};
//! use sensedsl_wiring::{Search, Solved, Wiring};
//!
//! let text = "board Rover on STM32F4DiscoveryBoard {
//!     sensor Light returns uint16 { id = 1; type = analog; }
//! }";
//! let target = Some("embassy");
//! let request = Request { path: "rover.sense", text, target, ..Request::default() };
//! let design = resolve(&request, &NoFiles).design.unwrap();
//! let solved = Wiring::new(&design, None).solve(&Search::default());
//! let Solved::Wired(wiring) = solved else { panic!("there is a wiring") };
//!
//! let rover = jobs(&design, &wiring).next().unwrap();
//! let files = Embassy.generate(&rover).unwrap();
//! let wires = str::from_utf8(&files.get("src/wiring.rs").unwrap().bytes).unwrap();
//! assert!(wires.contains("light: hal::adc::AdcChannel::degrade_adc(p.PB0),"));
//! ```

mod actuators;
mod analog;
mod bridge;
mod can;
mod cargo;
mod chip;
mod chips;
mod contacts;
mod context;
mod control;
mod counters;
mod fallback;
mod filter;
mod gaps;
mod generate;
mod hal;
mod i2c;
mod icu;
mod inputs;
mod item;
mod levels;
mod line;
mod link;
mod lock;
mod message;
mod missing;
mod names;
mod onewire;
mod outputs;
mod plan;
mod pulse;
mod pwm;
mod render;
mod section;
mod serial;
mod spi;
mod stepper;
#[cfg(test)]
mod tests;
mod typed;

use sensedsl_board::catalog;
use sensedsl_board::profile::TargetProfile;
use sensedsl_diagnostics::Diagnostic;
use sensedsl_model::kind::KindName;

use hal::{HALS, Opened};
use sensedsl_files::FileSet;
use sensedsl_job::Target;
use sensedsl_job::{BoardJob, JobConnection};
pub use typed::{Judged, TypeCheck, is_judged, type_check};

/// The target `embassy`.
pub struct Embassy;

impl Target for Embassy {
    fn name(&self) -> &'static str {
        "embassy"
    }

    fn refusal(&self, profile: &TargetProfile, _facts: Option<&catalog::Board>) -> Option<String> {
        let damage = Opened::new(profile, HALS).err()?;
        Some(format!("its profile is damaged: {damage}"))
    }

    fn problems(&self, profile: &TargetProfile) -> Vec<String> {
        match Opened::new(profile, HALS) {
            Ok(opened) => opened.problems(profile),
            Err(message) => vec![message],
        }
    }

    fn kinds(&self, profile: &TargetProfile) -> Vec<KindName> {
        match Opened::new(profile, HALS) {
            Ok(opened) => gaps::kinds(&*opened.drivers),
            // The damage is reported; there is no need to report every device as well.
            Err(_) => gaps::KINDS.to_vec(),
        }
    }

    fn lacks(&self, job: &BoardJob<'_>, connection: &JobConnection<'_>) -> Option<&'static str> {
        let opened = Opened::new(job.profile?, HALS).ok()?;
        gaps::lacks(&*opened.drivers, job, connection)
    }

    fn generate(&self, job: &BoardJob<'_>) -> Result<FileSet, Vec<Diagnostic>> {
        generate::generate(job, HALS)
    }

    fn keeps_parameters(&self) -> bool {
        false
    }

    fn build_option(&self) -> &'static str {
        ""
    }
}
