//! The solver's answers: plain data, found by the search and verified by [`crate::check()`].

use crate::check::Violation;
use crate::problem::{DeviceId, DmaUserId, PinId, ResourceId, StreamId};
use num_bigint::BigUint;
use std::fmt;

/// The choice for one device.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Choice {
    /// Index into the device's alternatives.
    pub alternative: usize,
    /// For each role the index of its candidate.
    pub candidates: Vec<usize>,
}

/// The objective, compared in field order.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Objective {
    /// Wires that differ from the wiring to keep.
    pub moved: u32,
    /// Soft rules violated.
    pub violated: u32,
    /// Shared pins used.
    pub shared: u32,
    /// Sum of the costs of the pins used.
    pub cost: u32,
    /// Spare boards used.
    pub spares: u32,
}

/// How good an answer is known to be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Optimality {
    /// Proved: no better answer exists.
    Proved,
    /// Valid, but not proved best: any answer was asked for, or time ran out.
    Feasible,
}

/// One valid answer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Answer {
    /// One choice per device, in order.
    pub choices: Vec<Choice>,
    /// Streams of each used DMA user, one per request.
    pub dma: Vec<(DmaUserId, Vec<StreamId>)>,
    /// Its objective value.
    pub objective: Objective,
    /// How good it is known to be.
    pub optimality: Optimality,
}

/// Why there is no answer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Conflict {
    /// A minimal set, in order: without any one of these devices, the others have an answer.
    pub devices: Vec<DeviceId>,
    /// Pins that all alternatives of those devices compete for, in order.
    pub pins: Vec<PinId>,
    /// Resources that they compete for, in order.
    pub resources: Vec<ResourceId>,
    /// Streams that they compete for, in order.
    pub streams: Vec<StreamId>,
    /// False when the search was stopped before the devices were known to be a minimal set.
    pub minimal: bool,
}

/// Result of a search for one answer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// An answer.
    Solved(Answer),
    /// Proved to have no answer.
    Infeasible(Conflict),
    /// The caller stopped the search before the proof was complete.
    Stopped {
        /// The best answer so far; `None` does not mean that there is none.
        answer: Option<Answer>,
        /// Proved: no answer is better than this.
        bound: Objective,
    },
}

/// A question that cannot be answered. None of these is the fault of whoever wrote the file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Fault {
    /// The problem names a pin, board, resource, rule, DMA user or stream that it does not have.
    Malformed(&'static str),
    /// The objective's parts do not fit into 63 bits together.
    TooLarge,
    /// The caller's [`crate::Cancel`] ended the search before an answer was found.
    Cancelled,
    /// The checker rejected the answer of the search: a bug in this crate.
    Rejected(Violation),
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Malformed(what) => write!(f, "the pin problem is malformed: {what}"),
            Self::TooLarge => f.write_str("the pin problem's costs are too large"),
            Self::Cancelled => f.write_str("the search was cancelled"),
            Self::Rejected(violation) => {
                write!(f, "the solver's answer failed its check: {violation}")
            }
        }
    }
}

impl std::error::Error for Fault {}

/// Exact number of answers.
pub type Count = BigUint;
