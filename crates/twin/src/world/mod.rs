//! The world around a board: the quantities for its sensors to measure, and the faults with their times.
//!
//! In: the text of a world and the design it is for. Out: a [`World`] with a signal for each element of each sensor
//! that the text names, in the sensor's own unit, and the faults in the order of time. Errors in the text become
//! diagnostics with places. A sensor that the text does not name has its [usual](usual()) signal.

mod command;
mod course;
mod entry;
mod fault;
mod file;
mod pid;
mod plants;
mod recorded;
mod samples;
mod signal;
mod stand_in;
mod units;
mod usual;

use std::collections::BTreeMap;

use sensedsl_model::design::DeviceIndex;

use crate::commands::Command;
use crate::plants::Plant;

pub use course::Course;
pub use fault::{Fault, FaultKind};
pub use file::{Scene, read};
pub use pid::{Pid, StandIn};
pub use recorded::{Again, Point, Recorded, recorded};
pub use signal::{Shape, Signal, Visit};
pub use usual::usual;

/// The events around a board.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct World {
    /// The seed of the random numbers, if the text gives one.
    pub seed: Option<u64>,
    /// The signals of each sensor that is named, one for each element.
    pub signals: BTreeMap<DeviceIndex, Vec<Signal>>,
    /// The faults, in the order of time.
    pub faults: Vec<Fault>,
    /// The host's commands, in the order of the text.
    pub commands: Vec<Command>,
    /// What turns the board's outputs into what its sensors measure; one that drives another comes before it.
    pub plants: Vec<Plant>,
    /// What stands in for the code of controllers where that cannot run.
    pub stand_ins: Vec<StandIn>,
    /// The length of the run that it is a record of.
    pub lasts_ns: Option<u64>,
}
