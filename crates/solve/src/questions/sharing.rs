//! Relaxed problems: makes a problem in which any number of devices may hold some of the pins,
//! resources or streams at once.
//!
//! The only question asked of such a problem is whether it has an answer. So choices that no longer
//! differ are merged, and interchangeable devices remain interchangeable.

use crate::problem::{Alternative, Candidate, Claim, DmaRequest, Holder, Problem, StreamId};
use std::collections::{BTreeMap, BTreeSet};

/// The place where a thing is held, its holder (and its signal, if it is shared), and what is
/// claimed with it.
type Mark = (usize, Holder, u32, Vec<Claim>);

/// The kinds of things that devices may compete for.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Contested {
    Streams,
    Resources,
    Pins,
}

impl Contested {
    /// All things of this kind that the problem names.
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

    /// Divides `all` into classes of things that could change places: the same devices hold them in
    /// the same places and with the same claims.
    pub(crate) fn interchangeable(self, problem: &Problem, all: &[u32]) -> Vec<Vec<u32>> {
        let mut marks: BTreeMap<u32, Vec<Mark>> = BTreeMap::new();
        let mut mark = |thing: u32, place: usize, (holder, signal), claims: &[Claim]| {
            marks.entry(thing).or_default().push((place, holder, signal, claims.to_vec()));
        };
        let shown = |c: &Candidate| match c.holder {
            Holder::Own => (Holder::Own, 0),
            Holder::Group(_) => (c.holder, c.signal.0),
        };
        let mut place = 0;
        match self {
            Self::Streams => {
                for request in problem.dma.iter().flat_map(|u| &u.requests) {
                    place += 1;
                    let streams = request.streams.iter();
                    streams.for_each(|s| mark(s.0, place, (Holder::Own, 0), &[]));
                }
            }
            Self::Resources | Self::Pins => {
                for a in problem.devices.iter().flat_map(|d| &d.alternatives) {
                    place += 1;
                    let wires = a.roles.iter().flat_map(|role| &role.candidates);
                    if matches!(self, Self::Resources) {
                        a.claims.iter().for_each(|c| mark(c.resource.0, place, (c.holder, 0), &[]));
                        for c in wires {
                            place += 1;
                            let claims = c.claims.iter();
                            claims.for_each(|c| mark(c.resource.0, place, (c.holder, 0), &[]));
                        }
                        continue;
                    }
                    for role in &a.roles {
                        place += 1;
                        let wires = role.candidates.iter();
                        wires.for_each(|c| mark(c.pin.0, place, shown(c), &c.claims));
                    }
                }
            }
        }
        let mut classes: BTreeMap<Vec<Mark>, Vec<u32>> = BTreeMap::new();
        for &thing in all {
            let mut marks = marks.remove(&thing).unwrap_or_default();
            marks.sort_unstable();
            classes.entry(marks).or_default().push(thing);
        }
        classes.into_values().collect()
    }

    /// The problem in which these things can be held any number of times.
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

/// Gives each request its own copies of the streams.
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

/// Drops the claims on the resources.
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

/// Wires on shared pins no longer have to be placed. What they claim goes to the device as a whole.
fn share_pins(problem: &mut Problem, shared: &BTreeSet<u32>) {
    for device in &mut problem.devices {
        let whole = std::mem::take(&mut device.alternatives);
        device.alternatives = whole.into_iter().flat_map(|a| without_wires(a, shared)).collect();
        merge(&mut device.alternatives);
    }
}

/// Splits an alternative: each role is on a shared pin, or on one that is still exclusive.
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

/// Removes duplicate choices.
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
