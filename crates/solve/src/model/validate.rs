//! Validation: a problem in, an error out if it refers to something that it does not have.
//!
//! Everything after this relies on it: ids are not checked a second time.

use crate::answer::Fault;
use crate::problem::{Claim, Problem};

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
