//! Whether DMA streams suffice: for complete choices, or for what is certain at a node.
//!
//! In: choices, or the domains that are left. Out: whether each request can have a stream of its
//! own, which `matching.rs` decides.

use super::Domains;
use crate::index::AltId;
use crate::matching::{fit, requests, users_fit};
use crate::model::{Choices, Model};
use crate::problem::{DeviceId, Problem, StreamId};

/// Whether the streams suffice for these choices.
pub(crate) fn suffice(problem: &Problem, model: &Model, choices: &Choices) -> bool {
    let users = choices.iter().flat_map(|chosen| &model.alt_dma[chosen.alt]).copied().collect();
    users_fit(problem, &users)
}

/// Whether the streams can still suffice for everything that is certain.
pub(crate) fn may_suffice(problem: &Problem, model: &Model, domains: &Domains) -> bool {
    let decided = model.devices.iter().filter_map(|d| domains.decided(d));
    let users = decided.flat_map(|alt| &model.alt_dma[alt]).copied().collect();
    let mut unions: Vec<Vec<StreamId>> = Vec::new();
    for device in model.devices.iter().filter(|&d| domains.decided(d).is_none()) {
        add_undecided_requests(problem, model, domains, device, &mut unions);
    }
    fit(problem, requests(problem, &users).chain(unions.iter().map(Vec::as_slice)))
}

/// Adds the requests of a device that needs streams of its own whatever it chooses. Each represents
/// one request of every alternative, so any stream of those requests may serve it.
fn add_undecided_requests(
    problem: &Problem,
    model: &Model,
    domains: &Domains,
    device: DeviceId,
    unions: &mut Vec<Vec<StreamId>>,
) {
    let requests = |alt: AltId| {
        let private = model.alt_dma[alt].iter().filter(|user| model.user_private[**user]);
        private.flat_map(|&user| &problem.dma_user(user).requests)
    };
    let least = domains.alts(model, device).map(|alt| requests(alt).count()).min();
    for position in 0..least.unwrap_or(0) {
        let mut union = Vec::new();
        for alt in domains.alts(model, device) {
            union.extend(requests(alt).nth(position).into_iter().flat_map(|r| &r.streams));
        }
        unions.push(union);
    }
}
