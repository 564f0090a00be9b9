//! Validation: a problem in, the weights of its objective out, or an error if the problem refers to
//! something that it does not have.
//!
//! Everything after this relies on it: ids are not checked a second time.

use crate::answer::Fault;
use crate::model::Weights;
use crate::problem::{Claim, Device, Problem};
use std::cmp::Reverse;

/// The weights that turn an objective into one number, or [`Fault::TooLarge`] if it does not fit.
pub(crate) fn weights(problem: &Problem) -> Result<Weights, Fault> {
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
    Ok(Weights { moved, rule, shared: of_shared, cost })
}

/// The most pins that can be in use at once.
fn wires(problem: &Problem) -> usize {
    let roles = |device: &Device| device.alternatives.iter().map(|a| a.roles.len()).max();
    problem.devices.iter().filter_map(roles).sum()
}

/// Returns [`Fault::Malformed`] if the problem refers to something that it does not have.
pub(crate) fn validate(problem: &Problem) -> Result<(), Fault> {
    let bad = |what| Err(Fault::Malformed(what));
    let resource = |claims: &[Claim]| claims.iter().all(|c| c.resource.0 < problem.resources);
    let boards = problem.boards.len();
    if problem.pins.iter().any(|p| p.board.0 as usize >= boards) {
        return bad("board of a pin");
    }
    for a in problem.devices.iter().flat_map(|d| &d.alternatives) {
        if a.board.0 as usize >= boards {
            return bad("board of an alternative");
        }
        if a.violates.iter().any(|r| r.0 >= problem.rules) {
            return bad("rule of an alternative");
        }
        if a.dma.iter().any(|u| u.0 as usize >= problem.dma.len()) {
            return bad("DMA user of an alternative");
        }
        if !resource(&a.claims) {
            return bad("resource of an alternative");
        }
        for c in a.roles.iter().flat_map(|r| &r.candidates) {
            if problem.pins.get(c.pin.0 as usize).is_none_or(|p| p.board != a.board) {
                return bad("pin of a candidate");
            }
            if c.violates.iter().any(|r| r.0 >= problem.rules) {
                return bad("rule of a candidate");
            }
            if !resource(&c.claims) {
                return bad("resource of a candidate");
            }
        }
    }
    let mut requests = problem.dma.iter().flat_map(|u| &u.requests).flat_map(|r| &r.streams);
    if requests.any(|s| s.0 >= problem.streams) { bad("stream of a DMA request") } else { Ok(()) }
}
