//! What the firmware of one driver adds to a board: its section. A driver is a folder here, a version of it a file.
//!
//! In: a [`Context`]. Out: a [`Section`]. What is common to all drivers puts the sections together and looks into
//! none of them: a kind that gets firmware is a folder and a line in [`PERIPHERALS`].

use std::collections::BTreeSet;

use sensedsl_board::signal::UnitName;
use sensedsl_diagnostics::Diagnostic;
use sensedsl_firmware_c::runtime::File;
use sensedsl_model::kind::KindName;

use super::PERIPHERALS;
use super::context::{Context, PadPlan};
use super::names::{Drivers, Setting};
use super::stacks::Depth;
use sensedsl_job::{BoardJob, Cycle, JobConnection};

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
    /// What a connection needs and is not made: [`nothing`] where everything is.
    pub(super) lacks: Lacks,
    /// What it needs of the core in C.
    pub(super) core: &'static [&'static [File]],
    /// Its hand-written files: path below `uproxy/`, and text.
    pub(super) runtime: &'static [File],
}

/// See [`sensedsl_job::Target::lacks`].
pub(super) type Lacks = fn(&BoardJob<'_>, &JobConnection<'_>) -> Option<&'static str>;

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
    /// For `mcuconf.h`: options that turn on what is no unit of its own, such as the outputs of a timer.
    pub(super) switches: Vec<String>,
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
    /// The headers that its tables need; [`sections`] fills them in.
    pub(super) headers: Vec<&'static str>,
    /// The C of its tables.
    pub(super) tables: String,
    /// Lines of C that start it, after the pads.
    pub(super) starts: Vec<String>,
    /// Lines of C that look at what its interrupts have gathered: in each cycle of the reporter.
    pub(super) polls: Vec<String>,
    /// What is done at once when the host has set an actuator.
    pub(super) applies: Vec<Apply>,
    /// What it counts beside the health of devices.
    pub(super) counters: Vec<Counter>,
    /// Buses on which addresses can be searched for.
    pub(super) probes: Vec<Probe>,
    /// Lines of C that bring its actuators to safety when the host is silent.
    pub(super) failsafes: Vec<String>,
}

/// A bus on which addresses can be searched for: an `up_probe_t`.
#[derive(Clone, Debug)]
pub(super) struct Probe {
    /// `I2C1`
    pub(super) title: String,
    /// The runtime's function that asks one address, and what it is told.
    pub(super) function: &'static str,
    pub(super) table: String,
    /// Those that the design has there.
    pub(super) expected: Vec<u8>,
}

/// A number for people.
#[derive(Clone, Debug)]
pub(super) struct Counter {
    /// `I2C1 was freed`
    pub(super) title: String,
    /// The `uint32_t` in C.
    pub(super) variable: String,
}

/// What is done when the host has set an actuator.
#[derive(Clone, Debug)]
pub(super) struct Apply {
    /// The device, as in `SENSE_FIELD_` and its name.
    pub(super) field: String,
    /// A line of C; `value` points to the value.
    pub(super) line: String,
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
    /// The function that does one cycle, and the table it works on.
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

/// The kinds of devices that code is made for.
pub(super) fn kinds(drivers: &Drivers) -> Vec<KindName> {
    let served = PERIPHERALS.iter().filter(|one| one.serving(drivers).is_some());
    served.filter_map(|one| one.kind).collect()
}

/// The driver of an MCU's pins, where there is no code for it, in words.
pub(super) fn unserved(drivers: &Drivers) -> Option<String> {
    let is_missing = |one: &&&Peripheral| one.kind.is_none() && one.serving(drivers).is_none();
    let missing = PERIPHERALS.iter().find(is_missing)?;
    let known: Vec<&str> = missing.versions.iter().map(|version| version.name).collect();
    Some(format!(
        "its {} driver is {}, code is made for {} only",
        missing.name,
        (missing.version)(drivers),
        known.join(" and ")
    ))
}

/// Of a driver that serves whatever the language has.
pub(super) fn nothing(_: &BoardJob<'_>, _: &JobConnection<'_>) -> Option<&'static str> {
    None
}

/// The sections of a board.
pub(super) fn sections(context: &Context<'_>, diagnostics: &mut Vec<Diagnostic>) -> Vec<Section> {
    let drivers = &context.names.drivers;
    let serving = PERIPHERALS.iter().filter_map(|one| Some((one, one.serving(drivers)?)));
    let section = |(peripheral, version): (&&Peripheral, &Version)| {
        let mut section = (version.plan)(context, diagnostics);
        if !section.tables.is_empty() {
            let files = peripheral.runtime.iter();
            let names = files.filter_map(|(path, _)| path.strip_prefix("chibios/"));
            section.headers = names.filter(|name| name.ends_with(".h")).collect();
        }
        section
    };
    serving.map(section).collect()
}
