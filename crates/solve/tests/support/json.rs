//! Problems as JSON, for programs in other languages.

use sensedsl_solve::problem::{Claim, Holder, Problem};

fn holder(holder: Holder) -> i64 {
    match holder {
        Holder::Own => -1,
        Holder::Group(group) => i64::from(group),
    }
}

fn claims(claims: &[Claim]) -> String {
    list(claims.iter().map(|claim| format!("[{},{}]", claim.resource.0, holder(claim.holder))))
}

pub fn list(items: impl Iterator<Item = String>) -> String {
    format!("[{}]", items.collect::<Vec<_>>().join(","))
}

/// The problem with numbers instead of names; a holder of -1 is the device itself.
pub fn json(problem: &Problem) -> String {
    let pins = list(problem.pins.iter().map(|pin| pin.cost.to_string()));
    let shared = list(problem.pins.iter().map(|pin| u32::from(pin.shared).to_string()));
    let spares = list(problem.boards.iter().map(|board| u32::from(board.spare).to_string()));
    let dma = list(problem.dma.iter().map(|user| {
        list(
            user.requests
                .iter()
                .map(|request| list(request.streams.iter().map(|stream| stream.0.to_string()))),
        )
    }));
    let devices = list(problem.devices.iter().map(|device| {
        list(device.alternatives.iter().map(|alternative| {
            let roles = list(alternative.roles.iter().map(|role| {
                list(role.candidates.iter().map(|candidate| {
                    format!(
                        "[{},{},{},{},{}]",
                        candidate.pin.0,
                        holder(candidate.holder),
                        candidate.signal.0,
                        claims(&candidate.claims),
                        list(candidate.violates.iter().map(|rule| rule.0.to_string()))
                    )
                }))
            }));
            format!(
                "{{\"board\":{},\"claims\":{},\"violates\":{},\"dma\":{},\"roles\":{roles}}}",
                alternative.board.0,
                claims(&alternative.claims),
                list(alternative.violates.iter().map(|rule| rule.0.to_string())),
                list(alternative.dma.iter().map(|user| user.0.to_string()))
            )
        }))
    }));
    format!(
        "{{\"pins\":{pins},\"shared\":{shared},\"spares\":{spares},\"rules\":{},\"dma\":{dma},\"devices\":{devices}}}",
        problem.rules
    )
}
