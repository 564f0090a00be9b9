//! Whether a problem is one: ids that exist and costs that fit; the weights of its objective.

use crate::answer::Fault;
use crate::model::Weights;
use crate::problem::{Claim, Problem};

/// The weights by which an objective becomes one number; [`Fault::TooLarge`] where it does not fit.
pub(crate) fn weights(problem: &Problem) -> Result<Weights, Fault> {
    let spares = problem.boards.iter().filter(|b| b.spare).count() as u64;
    let total: u64 = problem.pins.iter().map(|p| u64::from(p.cost)).sum();
    if u32::try_from(total).is_err() {
        return Err(Fault::TooLarge);
    }
    let cost = spares + 1;
    let rule = (total + 1).checked_mul(cost).ok_or(Fault::TooLarge)?;
    let moved = rule.checked_mul(u64::from(problem.rules) + 1).ok_or(Fault::TooLarge)?;
    let most = moved.checked_mul(problem.pins.len() as u64 + 1).ok_or(Fault::TooLarge)?;
    // The bounds add such numbers up, some of them in fractions.
    if most > 1 << 44 {
        return Err(Fault::TooLarge);
    }
    Ok(Weights { moved, rule, cost })
}

/// [`Fault::Malformed`] where the problem names what it does not have.
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
