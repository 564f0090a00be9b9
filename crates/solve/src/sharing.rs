//! Things made free for all: a problem and some of its pins, resources or streams in, the problem
//! in which everybody may have them at once out.
//!
//! Only whether there is an answer is asked of such a problem, so choices that no longer differ
//! become one, and devices that were alike stay so.

use crate::problem::{Alternative, Candidate, Claim, DmaRequest, Problem, StreamId};
use std::collections::BTreeSet;

/// What devices may fight for.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Things {
    Streams,
    Resources,
    Pins,
}

impl Things {
    /// All of them that the problem names.
    pub(crate) fn of(self, problem: &Problem) -> BTreeSet<u32> {
        let alternatives = || problem.devices.iter().flat_map(|d| &d.alternatives);
        let candidates = || alternatives().flat_map(|a| &a.roles).flat_map(|role| &role.candidates);
        match self {
            Self::Streams => {
                let requests = problem.dma.iter().flat_map(|u| &u.requests);
                requests.flat_map(|r| &r.streams).map(|s| s.0).collect()
            }
            Self::Resources => {
                let claims = alternatives().flat_map(|a| &a.claims);
                let of_wires = candidates().flat_map(|c| &c.claims);
                claims.chain(of_wires).map(|claim| claim.resource.0).collect()
            }
            Self::Pins => candidates().map(|c| c.pin.0).collect(),
        }
    }

    /// The problem in which these can be held any number of times.
    pub(crate) fn share(self, problem: &Problem, shared: &BTreeSet<u32>) -> Problem {
        let mut problem = problem.clone();
        match self {
            Self::Streams => share_streams(&mut problem, shared),
            Self::Resources => share_resources(&mut problem, shared),
            Self::Pins => share_pins(&mut problem, shared),
        }
        problem
    }
}

/// Each request gets copies of the streams for itself.
fn share_streams(problem: &mut Problem, shared: &BTreeSet<u32>) {
    let mut next = problem.streams;
    let requests = problem.dma.iter_mut().flat_map(|u| &mut u.requests);
    for stream in requests.flat_map(|r: &mut DmaRequest| &mut r.streams) {
        if shared.contains(&stream.0) {
            *stream = StreamId(next);
            next += 1;
        }
    }
    problem.streams = next;
}

/// The resources are no longer claimed.
fn share_resources(problem: &mut Problem, shared: &BTreeSet<u32>) {
    for device in &mut problem.devices {
        for a in &mut device.alternatives {
            a.claims.retain(|claim| !shared.contains(&claim.resource.0));
            for c in a.roles.iter_mut().flat_map(|r| &mut r.candidates) {
                c.claims.retain(|claim| !shared.contains(&claim.resource.0));
            }
        }
        merge(&mut device.alternatives);
    }
}

/// A wire on a shared pin is no wire any more: what it claims goes to the device as a whole.
fn share_pins(problem: &mut Problem, shared: &BTreeSet<u32>) {
    for device in &mut problem.devices {
        let whole = std::mem::take(&mut device.alternatives);
        device.alternatives = whole.into_iter().flat_map(|a| without_wires(a, shared)).collect();
        merge(&mut device.alternatives);
    }
}

/// An alternative for each way to have wires on shared pins or not.
fn without_wires(alternative: Alternative, shared: &BTreeSet<u32>) -> Vec<Alternative> {
    let Alternative { roles, .. } = alternative;
    let mut ways = vec![Alternative { roles: Vec::new(), ..alternative }];
    for mut role in roles {
        let (mut free, held): (Vec<Candidate>, Vec<Candidate>) =
            role.candidates.into_iter().partition(|c| shared.contains(&c.pin.0));
        if free.iter().any(|c| c.claims.is_empty()) {
            continue;
        }
        let mut seen = BTreeSet::new();
        free.retain_mut(|c| {
            c.claims.sort_unstable();
            seen.insert(c.claims.clone())
        });
        role.candidates = held;
        let mut next = Vec::new();
        for way in ways {
            for c in &free {
                let mut wired = way.clone();
                wired.claims.extend(&c.claims);
                next.push(wired);
            }
            if !role.candidates.is_empty() {
                let mut wired = way;
                wired.roles.push(role.clone());
                next.push(wired);
            }
        }
        ways = next;
    }
    ways
}

/// Leaves each choice once.
fn merge(alternatives: &mut Vec<Alternative>) {
    let mut seen: Vec<(Vec<Claim>, usize)> = Vec::new();
    let all = std::mem::take(alternatives);
    for mut alternative in all {
        alternative.claims.sort_unstable();
        alternative.claims.dedup();
        let known = seen.iter().any(|(claims, index)| {
            *claims == alternative.claims
                && alternatives.get(*index).is_some_and(|a: &Alternative| {
                    (a.board, &a.dma, &a.roles)
                        == (alternative.board, &alternative.dma, &alternative.roles)
                })
        });
        if !known {
            seen.push((alternative.claims.clone(), alternatives.len()));
            alternatives.push(alternative);
        }
    }
}
