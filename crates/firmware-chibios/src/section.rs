//! The section of a board's firmware that one driver adds. A driver is a folder here, a version of it a file.
//!
//! In: a [`Context`]. Out: a [`Section`]. The code common to all drivers combines the sections without looking into
//! any: firmware for another kind is a folder and a line in `peripherals.rs`.

use std::collections::BTreeSet;

use sensedsl_board::signal::UnitName;
use sensedsl_diagnostics::Diagnostic;
use sensedsl_firmware_c::runtime::File;
use sensedsl_model::kind::KindName;

use super::context::{Context, PadPlan};
use super::names::{Drivers, Setting};
use super::stacks::Depth;
use sensedsl_job::{BoardJob, Cycle, JobConnection};

/// A driver of the system that has code here.
pub(super) struct Peripheral {
    /// The name for people.
    pub(super) name: &'static str,
    /// The kind of device that it serves by itself.
    pub(super) kind: Option<KindName>,
    /// The version that an MCU has.
    pub(super) version: fn(&Drivers) -> &str,
    /// The versions that have code here.
    pub(super) versions: &'static [Version],
    /// The function for what a connection needs and there is no code for; [`nothing`] if there is code for everything.
    pub(super) lacks: Lacks,
    /// The files that it needs from the core in C.
    pub(super) core: &'static [&'static [File]],
    /// Its hand-written files: path below `uproxy/`, and content.
    pub(super) runtime: &'static [File],
}

/// The type of a driver's part of [`sensedsl_job::Target::lacks`].
pub(super) type Lacks = fn(&BoardJob<'_>, &JobConnection<'_>) -> Option<&'static str>;

/// The code for one version of a driver.
pub(super) struct Version {
    /// The system's name for it: `ADCv2`.
    pub(super) name: &'static str,
    /// Decides everything. What is impossible is reported.
    pub(super) plan: fn(&Context<'_>, &mut Vec<Diagnostic>) -> Section,
}

/// The section that a driver adds.
#[derive(Clone, Debug, Default)]
pub(super) struct Section {
    /// The pads and their setup.
    pub(super) pads: Vec<PadPlan>,
    /// The units that it uses.
    pub(super) units: BTreeSet<UnitName>,
    /// For `mcuconf.h`: options that turn on what is not a unit of its own, such as the outputs of a timer.
    pub(super) switches: Vec<String>,
    /// For `halconf.h`: whether the driver is compiled.
    pub(super) switch: Option<Setting>,
    /// For `halconf.h`: the options that it is compiled with.
    pub(super) hal: Vec<Setting>,
    /// For `mcuconf.h`, besides switches and streams of the units.
    pub(super) mcu: Vec<Setting>,
    /// For `up_conf.h`: the sizes that the runtime is compiled with.
    pub(super) sizes: Vec<Size>,
    /// The threads.
    pub(super) work: Vec<Work>,
    /// The conditions for the C compiler to check.
    pub(super) guards: Vec<GuardPlan>,
    /// The clocks whose frequencies the computations used.
    pub(super) clocks: BTreeSet<String>,
    /// The headers that its tables need; `peripherals.rs` fills them in.
    pub(super) headers: Vec<&'static str>,
    /// The C code of its tables.
    pub(super) tables: String,
    /// Lines of C that start it, after the pads are set up.
    pub(super) starts: Vec<String>,
    /// Lines of C that process what its interrupts have collected: in each cycle of the reporter.
    pub(super) polls: Vec<String>,
    /// Lines of C that run at once when the host has set an actuator.
    pub(super) applies: Vec<Apply>,
    /// Its counters besides the health of devices.
    pub(super) counters: Vec<Counter>,
    /// The buses that can be scanned for addresses.
    pub(super) probes: Vec<Probe>,
    /// What brings its actuators to their failsafe state when whoever sets them falls silent.
    pub(super) failsafes: Vec<Failsafe>,
}

/// A bus that can be scanned for addresses: an `up_probe_t`.
#[derive(Clone, Debug)]
pub(super) struct Probe {
    /// `I2C1`
    pub(super) title: String,
    /// The runtime's function that probes one address, and its argument.
    pub(super) function: &'static str,
    pub(super) table: String,
    /// The addresses that the design has there.
    pub(super) expected: Vec<u8>,
}

/// A counter, shown to people.
#[derive(Clone, Debug)]
pub(super) struct Counter {
    /// `I2C1 was freed`
    pub(super) title: String,
    /// The `uint32_t` variable in C.
    pub(super) variable: String,
}

/// The action when the host has set an actuator.
#[derive(Clone, Debug)]
pub(super) struct Apply {
    /// The device's name, as in `SENSE_FIELD_`.
    pub(super) field: String,
    /// A line of C; `value` points to the value.
    pub(super) line: String,
}

/// The action when whoever sets an actuator has fallen silent.
#[derive(Clone, Debug)]
pub(super) struct Failsafe {
    /// The device's name; none if it is for all that goes over a line or a bus, and for the host's silence alone.
    pub(super) field: Option<String>,
    /// A line of C.
    pub(super) line: String,
}

/// A size that the runtime is compiled with.
#[derive(Clone, Debug)]
pub(super) struct Size {
    /// The comment for people.
    pub(super) comment: &'static str,
    pub(super) setting: Setting,
}

/// The work of one thread.
#[derive(Clone, Debug)]
pub(super) struct Work {
    /// The name for people: `ADC1`.
    pub(super) unit: String,
    pub(super) cycle: Cycle,
    /// The function that runs one cycle, and its table.
    pub(super) function: &'static str,
    pub(super) table: String,
    /// The identifier of the first device that it serves.
    pub(super) device: u8,
    pub(super) depth: Depth,
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

/// The `lacks` of a driver that serves everything that the language has.
pub(super) fn nothing(_: &BoardJob<'_>, _: &JobConnection<'_>) -> Option<&'static str> {
    None
}
