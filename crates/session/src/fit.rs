//! How well a board carries a design: the question of a sweep over many boards.

use sensedsl_diagnostics::codes::{e0404_out_of_time, e0506_hardware_limit};
use sensedsl_wiring::assignment::Assignment;
use sensedsl_wiring::{Cancel, Solved, Wiring};

use crate::Snapshot;

/// How good a wiring is, the better before.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Quality {
    /// Soft rules that it violates.
    pub violated: u32,
    /// Pins that something else is on.
    pub shared: u32,
    /// Opportunity cost.
    pub cost: u32,
}

/// Whether a board carries a design.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fit {
    /// The best wiring is that good.
    Wired(Quality),
    /// It cannot carry the devices.
    Not,
    /// The solver failed its own check.
    Failed,
    /// Nobody looked, or not to the end.
    Open,
}

impl Snapshot {
    /// How good the best wiring is. Neither repairs nor warnings are looked for, so that thousands of
    /// boards can be asked.
    #[must_use]
    pub fn fit(&self, cancel: Cancel<'_>) -> Fit {
        let Some(design) = self.design() else { return Fit::Not };
        let wiring = Wiring::within(design, None, cancel);
        let Some(best) = wiring.one_of_the_best() else { return Fit::Not };
        match best {
            // The best so far need not be the best.
            Solved::Wired(wiring) if wiring.bound.is_some() => Fit::Open,
            Solved::Wired(wiring) => {
                let Assignment { violated, shared, cost, .. } = *wiring;
                Fit::Wired(Quality { violated, shared, cost })
            }
            Solved::Infeasible(_) => Fit::Not,
            // The best wiring leaves the converters without a stream: nothing to build, and no fault.
            Solved::Failed(why) if why.code == e0506_hardware_limit::CODE => Fit::Not,
            Solved::Failed(why) if why.code == e0404_out_of_time::CODE => Fit::Open,
            Solved::Failed(_) => Fit::Failed,
        }
    }
}
