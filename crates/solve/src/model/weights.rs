//! The weights of the objective: a problem in, out the weights by which the order of one number is
//! the order of the objective, or an error if that number does not fit.

use crate::answer::{Fault, Objective};
use crate::problem::{Device, Problem};
use std::cmp::Reverse;

/// The weights that pack an [`Objective`] into one number.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Weights {
    pub(crate) moved: u64,
    pub(crate) rule: u64,
    pub(crate) shared: u64,
    pub(crate) cost: u64,
}

impl Weights {
    /// The weights that turn an objective into one number, or [`Fault::TooLarge`] if it does not fit.
    pub(crate) fn new(problem: &Problem) -> Result<Self, Fault> {
        let spares = problem.boards.iter().filter(|b| b.spare).count() as u64;
        let wires = wires(problem).min(problem.pins.len());
        let shared = problem.pins.iter().filter(|p| p.shared).count().min(wires) as u64;
        let mut costs: Vec<u64> = problem.pins.iter().map(|p| u64::from(p.cost)).collect();
        costs.sort_unstable_by_key(|cost| Reverse(*cost));
        let total: u64 = costs.iter().take(wires).sum();
        if u32::try_from(total).is_err() {
            return Err(Fault::TooLarge);
        }
        let weight = |below: u64, most: u64| below.checked_mul(most + 1).ok_or(Fault::TooLarge);
        let cost = spares + 1;
        let of_shared = weight(cost, total)?;
        let rule = weight(of_shared, shared)?;
        let moved = weight(rule, u64::from(problem.rules))?;
        let most = weight(moved, wires as u64)?;
        // The bounds add up such numbers, some of them scaled by powers of two.
        if most > 1 << 44 {
            return Err(Fault::TooLarge);
        }
        Ok(Self { moved, rule, shared: of_shared, cost })
    }

    pub(crate) fn unpack(self, weight: u64) -> Objective {
        Objective {
            moved: (weight / self.moved) as u32,
            violated: (weight % self.moved / self.rule) as u32,
            shared: (weight % self.rule / self.shared) as u32,
            cost: (weight % self.shared / self.cost) as u32,
            spares: (weight % self.cost) as u32,
        }
    }
}

/// The most pins that can be in use at once.
fn wires(problem: &Problem) -> usize {
    let roles = |device: &Device| device.alternatives.iter().map(|a| a.roles.len()).max();
    problem.devices.iter().filter_map(roles).sum()
}
