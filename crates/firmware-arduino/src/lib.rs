//! Arduino sketches: tables for the hand-written runtime, in a folder that the Arduino IDE and PlatformIO open.
//!
//! In: a [`BoardJob`]. Out: a folder with `NAME.ino`, and `src/` with the tables, the runtime and a folder of the user's
//! own. Each kind is a file here and adds a section (`section.rs`); `peripherals.rs` lists them; `plan.rs` combines the
//! sections without looking into any; `changes.rs` puts the handlers of interrupts together, `memory.rs` adds up what is
//! taken; the templates only print. What the framework calls things is in the `system` of a profile's line (`names.rs`).
//!
//! # Example
//!
//! ```
//! use sensedsl_firmware_arduino::Arduino;
//! use sensedsl_job::{Target as _, jobs};
//! use sensedsl_model::{NoFiles, Request, resolve};
//! use sensedsl_wiring::{Search, Solved, Wiring};
//!
//! let text = "board Rover on ARDUINO_UNO_R3 {
//!     sensor Light returns uint16 { id = 1; type = analog; pin = A0; }
//! }";
//! let request = Request { path: "rover.sense", text, ..Request::default() };
//! let design = resolve(&request, &NoFiles).design.unwrap();
//! let solved = Wiring::new(&design, None).solve(&Search::default());
//! let Solved::Wired(wiring) = solved else { panic!("there is a wiring") };
//!
//! let rover = jobs(&design, &wiring).next().unwrap();
//! let files = Arduino.generate(&rover).unwrap();
//! let tables = str::from_utf8(&files.get("src/sense_hw.c").unwrap().bytes).unwrap();
//! assert!(tables.contains(".pin = 14U"));
//! ```

mod analog;
mod bus;
mod changes;
mod context;
mod control;
mod costs;
mod digital;
mod encoder;
mod icu;
mod memory;
mod names;
mod peripherals;
mod plan;
mod pwm;
mod rate;
mod render;
mod runtime;
mod section;
mod uart;

use sensedsl_board::catalog;
use sensedsl_board::profile::TargetProfile;
use sensedsl_diagnostics::Diagnostic;
use sensedsl_files::FileSet;
use sensedsl_job::{BoardJob, JobConnection, Target};
use sensedsl_model::kind::KindName;

use context::Context;
pub use names::{BoardNames, Names};
use peripherals::PERIPHERALS;

/// The target `arduino`.
pub struct Arduino;

impl Target for Arduino {
    fn name(&self) -> &'static str {
        "arduino"
    }

    fn refusal(&self, profile: &TargetProfile, facts: Option<&catalog::Board>) -> Option<String> {
        if let Err(message) = Names::of(profile) {
            return Some(format!("its profile is damaged: {message}"));
        }
        if let Some(Err(message)) = facts.map(BoardNames::of) {
            return Some(format!("the facts of its board are damaged: {message}"));
        }
        // Without a crystal of this frequency, every time would be wrong.
        let crystal_hz = facts.and_then(|facts| facts.crystal.hse_hz)?;
        let wanted_hz = profile.clocks_hz.get("CPU").copied()?;
        (crystal_hz != wanted_hz).then(|| {
            format!("its MCU runs at {} MHz, sketches are made for 16 MHz", crystal_hz / 1_000_000)
        })
    }

    fn problems(&self, profile: &TargetProfile) -> Vec<String> {
        match Names::of(profile) {
            Ok(names) => names.problems(),
            Err(message) => vec![message],
        }
    }

    fn kinds(&self, _: &TargetProfile) -> Vec<KindName> {
        peripherals::kinds()
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
        false
    }

    fn build_option(&self) -> &'static str {
        ""
    }
}
