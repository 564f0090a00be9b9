//! Why there is no answer: an infeasible problem in, a minimal conflict out.
//!
//! Devices are left out one by one as long as the rest stays without an answer; what remains is
//! minimal by proof. Then the same is done to what those devices fight for: streams, resources
//! and pins stop being exclusive one by one as long as there is still no answer.

use crate::answer::{Conflict, Fault, Outcome};
use crate::problem::{Claim, DeviceId, DmaRequest, PinId, Problem, ResourceId, StreamId};
use crate::solve::feasible;
use std::collections::BTreeSet;

type Stop<'a> = Option<&'a dyn Fn() -> bool>;

/// All things of a kind, and how to make some of them free for all.
type Things = (fn(&Problem) -> BTreeSet<u32>, fn(&Problem, &BTreeSet<u32>) -> Problem);

const STREAMS: Things = (streams_of, share_streams);
const RESOURCES: Things = (resources_of, share_resources);
const PINS: Things = (pins_of, share_pins);

/// Finds the conflict of a problem that has no answer. `seed` is a set of devices that is
/// probably one.
pub(crate) fn explain(
    problem: &Problem,
    seed: Option<Vec<usize>>,
    stop: Stop<'_>,
) -> Result<Outcome, Fault> {
    let all: Vec<usize> = (0..problem.devices.len()).collect();
    let mut kept = match seed {
        Some(seed) if infeasible(&only(problem, &seed), stop)? => seed,
        _ => all,
    };
    // Many at once first: most devices have no part in it.
    let mut chunk = kept.len().div_ceil(2);
    while chunk > 0 {
        let mut end = kept.len();
        while end > 0 {
            let start = end.saturating_sub(chunk);
            let mut fewer = kept.clone();
            fewer.drain(start..end);
            if infeasible(&only(problem, &fewer), stop)? {
                kept = fewer;
            }
            end = start;
        }
        chunk /= 2;
    }
    // A reason of one kind is the best to read: one kind after another is left out as a whole
    // first (signals are as good as pins, but pins are what people see).
    let mut core = only(problem, &kept);
    for (things, share) in [STREAMS, RESOURCES, PINS] {
        let relaxed = share(&core, &things(&core));
        if infeasible(&relaxed, stop)? {
            core = relaxed;
        }
    }
    let streams = contested(&mut core, STREAMS, stop)?;
    let pins = contested(&mut core, PINS, stop)?;
    let resources = contested(&mut core, RESOURCES, stop)?;
    // Copies made for sharing stand for nothing of the problem.
    let pins = pins.into_iter().filter(|p| (*p as usize) < problem.pins.len());
    let streams = streams.into_iter().filter(|s| *s < problem.streams);
    Ok(Outcome::Infeasible(Conflict {
        devices: kept.into_iter().map(|d| DeviceId(d as u32)).collect(),
        pins: pins.map(PinId).collect(),
        resources: resources.into_iter().map(ResourceId).collect(),
        streams: streams.map(StreamId).collect(),
    }))
}

/// Stopped counts as feasible: the conflict then is valid, though perhaps not minimal.
fn infeasible(problem: &Problem, stop: Stop<'_>) -> Result<bool, Fault> {
    Ok(feasible(problem, stop)? == Some(false))
}

fn only(problem: &Problem, devices: &[usize]) -> Problem {
    let kept = devices.iter().filter_map(|&d| problem.devices.get(d)).cloned().collect();
    Problem { devices: kept, ..problem.clone() }
}

/// Shares all, then ever smaller parts, of the things as long as the conflict stays; returns
/// those that must be exclusive for it.
fn contested(
    core: &mut Problem,
    (things, share): Things,
    stop: Stop<'_>,
) -> Result<Vec<u32>, Fault> {
    let mut parts = vec![things(core).into_iter().collect::<Vec<u32>>()];
    let mut needed = Vec::new();
    while let Some(part) = parts.pop() {
        if part.is_empty() {
            continue;
        }
        let relaxed = share(core, &part.iter().copied().collect());
        if infeasible(&relaxed, stop)? {
            *core = relaxed;
        } else if let [one] = part.as_slice() {
            needed.push(*one);
        } else {
            let (left, right) = part.split_at(part.len() / 2);
            parts.push(right.to_vec());
            parts.push(left.to_vec());
        }
    }
    needed.sort_unstable();
    Ok(needed)
}

fn streams_of(problem: &Problem) -> BTreeSet<u32> {
    let requests = problem.dma.iter().flat_map(|u| &u.requests);
    requests.flat_map(|r| &r.streams).map(|s| s.0).collect()
}

/// Each request gets copies of the streams for itself.
fn share_streams(problem: &Problem, shared: &BTreeSet<u32>) -> Problem {
    let mut problem = problem.clone();
    let mut next = problem.streams;
    let requests = problem.dma.iter_mut().flat_map(|u| &mut u.requests);
    for stream in requests.flat_map(|r: &mut DmaRequest| &mut r.streams) {
        if shared.contains(&stream.0) {
            *stream = StreamId(next);
            next += 1;
        }
    }
    problem.streams = next;
    problem
}

fn claims_of(problem: &Problem) -> impl Iterator<Item = &Claim> {
    problem.devices.iter().flat_map(|d| &d.alternatives).flat_map(|a| {
        let wires = a.roles.iter().flat_map(|r| &r.candidates).flat_map(|c| &c.claims);
        a.claims.iter().chain(wires)
    })
}

fn resources_of(problem: &Problem) -> BTreeSet<u32> {
    claims_of(problem).map(|claim| claim.resource.0).collect()
}

/// The resources are no longer claimed.
fn share_resources(problem: &Problem, shared: &BTreeSet<u32>) -> Problem {
    let mut problem = problem.clone();
    for a in problem.devices.iter_mut().flat_map(|d| &mut d.alternatives) {
        a.claims.retain(|claim| !shared.contains(&claim.resource.0));
        for c in a.roles.iter_mut().flat_map(|r| &mut r.candidates) {
            c.claims.retain(|claim| !shared.contains(&claim.resource.0));
        }
    }
    problem
}

fn pins_of(problem: &Problem) -> BTreeSet<u32> {
    let roles = problem.devices.iter().flat_map(|d| &d.alternatives).flat_map(|a| &a.roles);
    roles.flat_map(|r| &r.candidates).map(|c| c.pin.0).collect()
}

/// Each role of each device gets a copy of the pins for itself.
fn share_pins(problem: &Problem, shared: &BTreeSet<u32>) -> Problem {
    let mut problem = problem.clone();
    let mut copies = Vec::new();
    let first = problem.pins.len() as u32;
    for device in &mut problem.devices {
        for role in device.alternatives.iter_mut().flat_map(|a| &mut a.roles) {
            for c in role.candidates.iter_mut().filter(|c| shared.contains(&c.pin.0)) {
                let Some(pin) = problem.pins.get(c.pin.0 as usize) else { continue };
                copies.push(pin.clone());
                c.pin = PinId(first + copies.len() as u32 - 1);
            }
        }
    }
    problem.pins.append(&mut copies);
    for pin in &mut problem.pins {
        pin.cost = 0;
    }
    problem
}
