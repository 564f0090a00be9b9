//! What the firmware of one driver adds to a board: its section. A driver is a folder here, a version of it a file.
//!
//! In: a [`Context`]. Out: a [`Section`]. What is common to all drivers puts the sections together and looks into
//! none of them: a kind that gets firmware is a folder and a line in [`PERIPHERALS`].

use std::collections::BTreeSet;

use sensedsl_board::signal::UnitName;
use sensedsl_diagnostics::Diagnostic;
use sensedsl_model::kind::KindName;

use super::PERIPHERALS;
use super::context::{Context, PadPlan};
use super::names::{Drivers, Setting};
use crate::job::Cycle;

/// A driver of the system that code is made for.
pub(super) struct Peripheral {
    /// For people.
    pub(super) name: &'static str,
    /// The kind of device that it serves by itself.
    pub(super) kind: Option<KindName>,
    /// Which version an MCU has.
    pub(super) version: fn(&Drivers) -> &str,
    /// The versions that code is made for.
    pub(super) versions: &'static [Version],
    /// Its hand-written files: path below `uproxy/`, and text.
    pub(super) runtime: &'static [(&'static str, &'static str)],
}

/// The code for one version of a driver.
pub(super) struct Version {
    /// As the system names it: `ADCv2`.
    pub(super) name: &'static str,
    /// Decides everything. What cannot be goes to the diagnostics.
    pub(super) plan: fn(&Context<'_>, &mut Vec<Diagnostic>) -> Section,
}

/// What a driver adds.
#[derive(Clone, Debug, Default)]
pub(super) struct Section {
    /// How pads are set up.
    pub(super) pads: Vec<PadPlan>,
    /// The units that it takes.
    pub(super) units: BTreeSet<UnitName>,
    /// For `halconf.h`: whether the driver is compiled.
    pub(super) switch: Option<Setting>,
    /// For `halconf.h`: how it is compiled.
    pub(super) hal: Vec<Setting>,
    /// For `mcuconf.h`, beside switches and streams of the units.
    pub(super) mcu: Vec<Setting>,
    /// For `up_conf.h`.
    pub(super) sizes: Vec<Size>,
    /// The threads.
    pub(super) work: Vec<Work>,
    /// What the C compiler is to check.
    pub(super) guards: Vec<GuardPlan>,
    /// The clocks whose frequencies were computed with.
    pub(super) clocks: BTreeSet<String>,
    /// The C of its tables.
    pub(super) tables: String,
    /// The tables that the runtime is told: `adcs`.
    pub(super) arrays: Vec<&'static str>,
}

/// A size that the runtime is compiled with.
#[derive(Clone, Debug)]
pub(super) struct Size {
    /// For people.
    pub(super) comment: &'static str,
    pub(super) setting: Setting,
}

/// What one thread has to do.
#[derive(Clone, Debug)]
pub(super) struct Work {
    /// For people: `ADC1`.
    pub(super) unit: String,
    pub(super) cycle: Cycle,
    /// The runtime's function and the table it works on.
    pub(super) function: &'static str,
    pub(super) table: String,
}

/// `_Static_assert(condition, message)`
#[derive(Clone, Debug)]
pub(super) struct GuardPlan {
    pub(super) condition: String,
    pub(super) message: String,
}

impl Peripheral {
    /// The code for the version that an MCU has.
    pub(super) fn serving(&self, drivers: &Drivers) -> Option<&'static Version> {
        self.versions.iter().find(|version| version.name == (self.version)(drivers))
    }
}

/// The kinds of devices that code is made for.
pub(super) fn kinds() -> impl Iterator<Item = KindName> {
    PERIPHERALS.iter().filter_map(|peripheral| peripheral.kind)
}

/// A driver of an MCU that there is no code for, in words.
pub(super) fn unserved(drivers: &Drivers) -> Option<String> {
    let mut all = PERIPHERALS.iter();
    let missing = all.find(|peripheral| peripheral.serving(drivers).is_none())?;
    let known: Vec<&str> = missing.versions.iter().map(|version| version.name).collect();
    Some(format!(
        "its {} driver is {}, code is made for {} only",
        missing.name,
        (missing.version)(drivers),
        known.join(" and ")
    ))
}

/// The sections of a board.
pub(super) fn sections(context: &Context<'_>, diagnostics: &mut Vec<Diagnostic>) -> Vec<Section> {
    let drivers = &context.names.drivers;
    let serving = PERIPHERALS.iter().filter_map(|peripheral| peripheral.serving(drivers));
    serving.map(|version| (version.plan)(context, diagnostics)).collect()
}
