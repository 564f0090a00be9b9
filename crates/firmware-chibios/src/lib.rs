//! ChibiOS firmware: tables for the hand-written runtime, and configuration as changes to the user's tree.
//!
//! In: a [`BoardJob`]. Out: a folder with a Makefile, `cfg/`, `generated/`, `user/` and a copy of the runtime. Each
//! driver of the system is a folder here and adds a section (`section.rs`); `peripherals.rs` lists them; `plan.rs`
//! combines the sections without looking into any; the templates only print. Names of the system are in the `[system]`
//! part of a profile (`names.rs`). What the hardware or the system cannot do is returned as diagnostics, and then there
//! are no files.
//!
//! # Example
//!
//! ```
//! use sensedsl_firmware_chibios::Chibios;
//! use sensedsl_job::{Target as _, jobs};
//! use sensedsl_model::{NoFiles, Request, resolve};
//! use sensedsl_wiring::{Search, Solved, Wiring};
//!
//! let text = "board Rover on STM32F4DiscoveryBoard {
//!     sensor Light returns uint16 { id = 1; type = analog; }
//! }";
//! let request = Request { path: "rover.sense", text, ..Request::default() };
//! let design = resolve(&request, &NoFiles).design.unwrap();
//! let solved = Wiring::new(&design, None).solve(&Search::default());
//! let Solved::Wired(wiring) = solved else { panic!("there is a wiring") };
//!
//! let rover = jobs(&design, &wiring).next().unwrap();
//! let files = Chibios.generate(&rover).unwrap();
//! let tables = str::from_utf8(&files.get("generated/sense_hw.c").unwrap().bytes).unwrap();
//! assert!(tables.contains("PAL_LINE(GPIOB, 0U), PAL_MODE_INPUT_ANALOG"));
//! ```

mod adc;
mod board;
mod can;
mod chips;
mod context;
mod control;
mod dac;
mod digital;
mod doctor;
mod encoder;
mod facts;
mod fallback;
mod gpio;
mod i2c;
mod icu;
mod link;
mod missed;
mod names;
mod onewire;
mod parts;
mod peripherals;
mod plan;
mod pulse;
mod pwm;
mod render;
mod runtime;
mod section;
mod settings;
mod spi;
mod stacks;
mod stepper;
mod timers;
mod uart;

use sensedsl_board::catalog;
use sensedsl_board::profile::TargetProfile;
use sensedsl_diagnostics::Diagnostic;
use sensedsl_model::kind::KindName;

use context::Context;
pub use facts::Facts;
pub use names::Names;
use peripherals::PERIPHERALS;
use sensedsl_files::FileSet;
use sensedsl_job::Target;
use sensedsl_job::{BoardJob, JobConnection};

/// The target `chibios`.
pub struct Chibios;

impl Target for Chibios {
    fn name(&self) -> &'static str {
        facts::NAME
    }

    /// An MCU is served if there is code for its pins; a kind, if there is code for the version of its driver.
    fn refusal(&self, profile: &TargetProfile, facts: Option<&catalog::Board>) -> Option<String> {
        match facts.map(Facts::of) {
            Some(Ok(Some(_))) => unserved(profile),
            Some(Err(message)) => Some(format!("the facts of its board are damaged: {message}")),
            None | Some(Ok(None)) => Some("no ChibiOS board is known for its MCU".to_owned()),
        }
    }

    fn problems(&self, profile: &TargetProfile) -> Vec<String> {
        match Names::of(profile) {
            Ok(names) => names.problems(profile),
            Err(message) => vec![message],
        }
    }

    fn kinds(&self, profile: &TargetProfile) -> Vec<KindName> {
        Names::of(profile).map(|names| peripherals::kinds(&names.drivers)).unwrap_or_default()
    }

    fn lacks(&self, job: &BoardJob<'_>, connection: &JobConnection<'_>) -> Option<&'static str> {
        let kind = connection.connection.kind.name();
        let peripheral = PERIPHERALS.iter().find(|one| one.kind == Some(kind))?;
        (peripheral.lacks)(job, connection)
    }

    fn generate(&self, job: &BoardJob<'_>) -> Result<FileSet, Vec<Diagnostic>> {
        let mut diagnostics = Vec::new();
        let context = Context::new(job);
        let plan = context.and_then(|context| plan::plan(&context, &mut diagnostics));
        match plan {
            Some(plan) if diagnostics.is_empty() => Ok(render::render(&plan)),
            _ => Err(diagnostics),
        }
    }

    fn keeps_parameters(&self) -> bool {
        true
    }

    fn build_option(&self) -> &'static str {
        " --chibios /path/to/ChibiOS"
    }
}

/// A driver of the profile's MCUs that has no code here, in words.
fn unserved(profile: &TargetProfile) -> Option<String> {
    match Names::of(profile) {
        Ok(names) => peripherals::unserved(&names.drivers),
        Err(message) => Some(format!("its profile is damaged: {message}")),
    }
}

/// Whether there is code for the drivers of the profile's MCUs.
#[must_use]
pub fn is_served(profile: &TargetProfile) -> bool {
    unserved(profile).is_none()
}
