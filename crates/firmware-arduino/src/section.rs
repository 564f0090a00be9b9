//! The section of a sketch that one kind adds: a file here. `plan.rs` combines the sections without looking into any.

use sensedsl_board::pin::PinName;
use sensedsl_diagnostics::Diagnostic;
use sensedsl_firmware_c::runtime::File;
use sensedsl_job::{BoardJob, Cycle, JobConnection};
use sensedsl_model::kind::KindName;

use crate::context::Context;

/// A kind that there is code for.
pub(crate) struct Peripheral {
    /// The kind whose devices it serves; `None` for what serves all of them.
    pub(crate) kind: Option<KindName>,
    /// What a connection needs and there is no code for.
    pub(crate) lacks: fn(&BoardJob<'_>, &JobConnection<'_>) -> Option<&'static str>,
    /// Decides everything. What is impossible is reported.
    pub(crate) plan: fn(&Context<'_>, &mut Vec<Diagnostic>) -> Section,
    /// The files that it needs of the core in C.
    pub(crate) core: &'static [&'static [File]],
    /// Its hand-written files.
    pub(crate) runtime: &'static [&'static [File]],
}

/// What a kind adds to the sketch.
#[derive(Clone, Debug, Default)]
pub(crate) struct Section {
    /// Lines of C that set pads up, before anything else.
    pub(crate) pads: Vec<String>,
    /// The work of the loop.
    pub(crate) work: Vec<Work>,
    /// The headers that its tables need.
    pub(crate) headers: Vec<&'static str>,
    /// The C code of its tables.
    pub(crate) tables: String,
    /// Lines of C that start it.
    pub(crate) starts: Vec<String>,
    /// Lines of C that take what interrupts have collected.
    pub(crate) polls: Vec<String>,
    /// Lines of C that empty serial ports.
    pub(crate) drains: Vec<String>,
    /// Lines of C that run when an actuator is set.
    pub(crate) applies: Vec<Apply>,
    /// What brings its actuators to their failsafe state.
    pub(crate) failsafes: Vec<Failsafe>,
    /// What runs when pins change.
    pub(crate) changes: Vec<Change>,
    /// The serial ports of devices.
    pub(crate) ports: Vec<PortPlan>,
    /// Settings of `sense_conf.h`.
    pub(crate) sizes: Vec<(&'static str, u32)>,
    /// Memory that it takes, by what takes it.
    pub(crate) costs: Vec<Cost>,
}

/// A line of C that runs when a device was set.
#[derive(Clone, Debug)]
pub(crate) struct Apply {
    pub(crate) field: String,
    pub(crate) line: String,
}

/// A line of C that brings a device to its failsafe state.
#[derive(Clone, Debug)]
pub(crate) struct Failsafe {
    pub(crate) field: String,
    pub(crate) line: String,
}

/// What runs in the interrupt of a pin.
#[derive(Clone, Debug)]
pub(crate) struct Change {
    pub(crate) pin: PinName,
    pub(crate) line: String,
}

/// A serial port with a device.
#[derive(Clone, Debug)]
pub(crate) struct PortPlan {
    /// The framework's object.
    pub(crate) object: String,
    pub(crate) baud: u32,
    /// The framework's word for the frame.
    pub(crate) frame: String,
}

/// The work of the loop in a cycle.
#[derive(Clone, Debug)]
pub(crate) struct Work {
    pub(crate) title: String,
    pub(crate) function: &'static str,
    pub(crate) table: String,
    pub(crate) cycle: Cycle,
    /// The name of the first device that it serves.
    pub(crate) field: String,
}

/// Memory that something takes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Cost {
    /// For people: `the part Imu`.
    pub(crate) what: String,
    pub(crate) ram_bytes: u32,
    pub(crate) flash_bytes: u32,
}

impl Cost {
    pub(crate) fn new(what: impl Into<String>, ram_bytes: u32, flash_bytes: u32) -> Self {
        Self { what: what.into(), ram_bytes, flash_bytes }
    }
}

/// The `lacks` of a kind that is served whole.
pub(crate) fn nothing(_: &BoardJob<'_>, _: &JobConnection<'_>) -> Option<&'static str> {
    None
}
