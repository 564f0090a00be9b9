//! A choice that a node splits on.
//!
//! In: an alternative, a candidate, a rule, a board or a facility. Out: one word for each of them,
//! which those who choose, those who learn from it and those who record it have in common.

use crate::index::{AltId, CandId, FacilityId};
use crate::problem::{BoardId, RuleId};

/// A choice that a node splits on: taken first, then refused.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Branch {
    /// The device takes the alternative.
    Alt(AltId),
    /// The role takes the candidate.
    Cand(CandId),
    /// No device violates the rule.
    Rule(RuleId),
    /// No device uses the spare board.
    Board(BoardId),
    /// At least one device uses the facility.
    Facility(FacilityId),
}
