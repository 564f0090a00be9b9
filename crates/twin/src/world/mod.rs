//! The world around a board: what its sensors have to measure, and what breaks when.
//!
//! In: the text of a world and the design it is for. Out: a [`World`] with a signal for each element of each sensor
//! that the text names, in the sensor's own unit, and the faults in the order of time; what is wrong with the text is
//! diagnostics with places in it. What the text does not name does what is [usual](usual()).

mod command;
mod entry;
mod fault;
mod file;
mod samples;
mod signal;
mod usual;

use std::collections::BTreeMap;

use sensedsl_model::design::DeviceIndex;

use crate::commands::Command;

pub use fault::{Fault, FaultKind};
pub use file::{Scene, read};
pub use signal::{Shape, Signal, Visit};
pub use usual::usual;

/// What happens around a board.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct World {
    /// What chance begins with, where the text says it.
    pub seed: Option<u64>,
    /// What each sensor that is named does, an element each.
    pub signals: BTreeMap<DeviceIndex, Vec<Signal>>,
    /// What breaks, in the order of time.
    pub faults: Vec<Fault>,
    /// What the host sets, in the order of the text.
    pub commands: Vec<Command>,
}
