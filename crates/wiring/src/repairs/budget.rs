//! The budget for repairs, and the results of spending it.

use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

use sensedsl_diagnostics::codes::e0404_out_of_time;
use sensedsl_model::design::Design;

use super::repair::Repair;
use crate::Cancel;
use crate::answers::Solved;
use crate::wiring::Wiring;

/// Steps of the search that a change may take, in the first round and in the second.
pub(super) const SHARES: [u64; 2] = [400, 3_000];

/// Steps that all changes may take together.
const STEPS_MAX: u64 = 12_000;

/// The result of trying a change.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum TrialResult {
    /// There is a wiring after it that costs this much.
    Helps { cost: u32, is_best: bool },
    /// There is no wiring after it.
    IsNoHelp,
    /// It takes more than its share of the steps to tell.
    Unknown,
}

/// The budget that is left for repairs. It counts steps of the search, so that the same file gets
/// the same repairs on every machine; the time limit of the command bounds it in addition.
pub(super) struct Budget<'a> {
    steps: u64,
    cancel: Cancel<'a>,
}

impl<'a> Budget<'a> {
    pub(super) const fn new(cancel: Cancel<'a>) -> Self {
        Self { steps: STEPS_MAX, cancel }
    }

    pub(super) fn tried(&mut self, design: &Design, repair: &Repair, share: u64) -> TrialResult {
        self.spend(&repair.applied(design), share, |wiring| match wiring.one_of_the_best() {
            Some(Solved::Wired(found)) => {
                TrialResult::Helps { cost: found.cost, is_best: found.bound.is_none() }
            }
            Some(Solved::Failed(why)) if why.code == e0404_out_of_time::CODE => {
                TrialResult::Unknown
            }
            None | Some(Solved::Infeasible(_) | Solved::Failed(_)) => TrialResult::IsNoHelp,
        })
    }

    /// Whether it is quickly known that the design has no wiring.
    pub(super) fn is_impossible(&mut self, design: &Design) -> bool {
        let tried = self.spend(design, SHARES[0], |wiring| {
            if wiring.is_impossible() { TrialResult::IsNoHelp } else { TrialResult::Unknown }
        });
        tried == TrialResult::IsNoHelp
    }

    /// Asks within the share of the steps.
    fn spend(
        &mut self,
        design: &Design,
        share: u64,
        ask: impl Fn(&Wiring<'_>) -> TrialResult,
    ) -> TrialResult {
        let share = share.min(self.steps);
        if share == 0 || self.cancel.is_over() {
            return TrialResult::Unknown;
        }
        let spent = AtomicU64::new(0);
        // Putting the problem does not count as a step.
        let is_put = AtomicBool::new(false);
        let over = || {
            let counts = is_put.load(Ordering::Relaxed);
            counts && spent.fetch_add(1, Ordering::Relaxed) >= share || self.cancel.is_over()
        };
        let wiring = Wiring::within(design, None, Cancel::when(&over));
        is_put.store(true, Ordering::Relaxed);
        let tried = ask(&wiring);
        drop(wiring);
        self.steps -= spent.into_inner().min(share);
        tried
    }
}
