//! How well a board carries a design, for sweeps over many boards.

use sensedsl_diagnostics::codes::{e0404_out_of_time, e0506_hardware_limit};
use sensedsl_wiring::assignment::Assignment;
use sensedsl_wiring::{Cancel, Solved, Wiring};

use crate::Snapshot;

/// How good a wiring is; the smaller, the better.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Quality {
    /// The number of soft rules that it violates.
    pub violated: u32,
    /// The number of its pins that are also used on the board.
    pub shared: u32,
    /// Its opportunity cost.
    pub cost: u32,
}

/// Whether a board carries a design.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fit {
    /// It does, and its best wiring has this quality.
    Wired(Quality),
    /// It cannot carry the devices.
    Not,
    /// The solver failed its own check.
    Failed,
    /// There was no search, or it did not finish.
    Open,
}

impl Snapshot {
    /// The quality of the best wiring. Does not look for repairs or warnings, so that thousands of
    /// boards can be queried.
    #[must_use]
    pub fn fit(&self, cancel: Cancel<'_>) -> Fit {
        let Some(design) = self.design() else { return Fit::Not };
        let wiring = Wiring::within(design, None, cancel);
        let Some(best) = wiring.one_of_the_best() else { return Fit::Not };
        match best {
            // The best wiring found so far need not be the best of all.
            Solved::Wired(wiring) if wiring.bound.is_some() => Fit::Open,
            Solved::Wired(wiring) => {
                let Assignment { violated, shared, cost, .. } = *wiring;
                Fit::Wired(Quality { violated, shared, cost })
            }
            Solved::Infeasible(_) => Fit::Not,
            // The best wiring leaves the converters without a stream, so it cannot be built. That
            // is not a failure.
            Solved::Failed(why) if why.code == e0506_hardware_limit::CODE => Fit::Not,
            Solved::Failed(why) if why.code == e0404_out_of_time::CODE => Fit::Open,
            Solved::Failed(_) => Fit::Failed,
        }
    }
}
