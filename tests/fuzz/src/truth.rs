//! The truth about a small problem of a certificate: all its wirings are tried.
//!
//! Written from `docs/proofs.md` alone and slow on purpose: it judges the verifier, so it shares no
//! code with it.

use std::collections::{BTreeMap, BTreeSet};

use sensedsl_proof::format::{Candidate, Objective, Problem};

/// Wirings that are tried at most.
const WIRINGS_MAX: u64 = 200_000;

/// What is known of a problem.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Truth {
    /// The best objective.
    Best([u64; 5]),
    /// There is no wiring.
    NoWiring,
    /// There are too many wirings to try.
    Unknown,
}

/// One way to connect a device in full.
#[derive(Clone, Debug)]
struct Way<'a> {
    board: &'a str,
    dma: &'a BTreeSet<String>,
    violates: BTreeSet<&'a str>,
    /// Pin, its holder, its signal, whether it moved.
    pins: Vec<(&'a str, &'a str, &'a str, bool)>,
    claims: Vec<(&'a str, &'a str)>,
}

/// Tries all wirings.
#[must_use]
pub fn truth(problem: &Problem) -> Truth {
    let mut devices = Vec::new();
    let mut wirings: u64 = 1;
    for alternatives in problem.devices.values() {
        let mut ways = Vec::new();
        for alternative in alternatives.values() {
            let roles: Vec<Vec<&Candidate>> =
                alternative.roles.values().map(|role| role.values().collect()).collect();
            let size: u64 = roles.iter().map(|role| role.len() as u64).product();
            if size > WIRINGS_MAX {
                return Truth::Unknown;
            }
            let plain = Way {
                board: &alternative.board,
                dma: &alternative.dma,
                violates: alternative.violates.iter().map(String::as_str).collect(),
                pins: Vec::new(),
                claims: alternative.claims.iter().map(|(r, h)| (r.as_str(), h.as_str())).collect(),
            };
            extend(plain, &roles, &mut ways);
        }
        wirings = wirings.saturating_mul(ways.len() as u64);
        devices.push(ways);
    }
    if wirings > WIRINGS_MAX {
        return Truth::Unknown;
    }
    let mut best = None;
    visit(problem, &devices, &mut Vec::new(), &mut best);
    best.map_or(Truth::NoWiring, Truth::Best)
}

/// All choices of candidates for the roles that are left.
fn extend<'a>(way: Way<'a>, roles: &[Vec<&'a Candidate>], ways: &mut Vec<Way<'a>>) {
    let Some((role, rest)) = roles.split_first() else {
        ways.push(way);
        return;
    };
    for one in role {
        if way.pins.iter().any(|(pin, ..)| *pin == one.pin) {
            continue; // A device does not use a pin twice.
        }
        let mut next = way.clone();
        next.pins.push((&one.pin, &one.holder, &one.signal, one.moved));
        next.claims.extend(one.claims.iter().map(|(r, h)| (r.as_str(), h.as_str())));
        next.violates.extend(one.violates.iter().map(String::as_str));
        extend(next, rest, ways);
    }
}

fn visit<'a>(
    problem: &Problem,
    devices: &'a [Vec<Way<'a>>],
    taken: &mut Vec<&'a Way<'a>>,
    best: &mut Option<[u64; 5]>,
) {
    let Some((ways, rest)) = devices.split_first() else {
        let found = objective(problem, taken);
        *best = match (*best, found) {
            (Some(best), Some(found)) => Some(best.min(found)),
            (best, found) => best.or(found),
        };
        return;
    };
    for way in ways {
        taken.push(way);
        visit(problem, rest, taken, best);
        taken.pop();
    }
}

/// The objective of a wiring, if it is one.
fn objective(problem: &Problem, taken: &[&Way<'_>]) -> Option<[u64; 5]> {
    // Who holds each thing, as what: devices may be several only when all hold it as the same.
    let mut pins: BTreeMap<&str, Vec<(usize, &str, &str)>> = BTreeMap::new();
    let mut things: BTreeMap<&str, Vec<(usize, &str, &str)>> = BTreeMap::new();
    let (mut moved, mut rules, mut boards, mut dma) =
        (BTreeSet::new(), BTreeSet::new(), BTreeSet::new(), BTreeSet::new());
    for (device, way) in taken.iter().enumerate() {
        boards.insert(way.board);
        dma.extend(way.dma.iter().map(String::as_str));
        rules.extend(way.violates.iter().copied());
        for (pin, holder, signal, has_moved) in &way.pins {
            pins.entry(pin).or_default().push((device, holder, signal));
            if *has_moved {
                moved.insert(*pin);
            }
        }
        for (thing, holder) in &way.claims {
            things.entry(thing).or_default().push((device, holder, ""));
        }
    }
    let agree = |held: &Vec<(usize, &str, &str)>| {
        held.iter().all(|(device, holder, signal)| {
            held.iter().all(|(other, its, as_signal)| {
                device == other || (*holder != "own" && holder == its && signal == as_signal)
            })
        })
    };
    if !pins.values().chain(things.values()).all(agree) || !served(problem, &dma) {
        return None;
    }
    let cost = |pin: &&str| problem.pins.get(*pin).copied().map_or(0, u64::from);
    let cost = pins.keys().map(cost).sum();
    let spares = boards.iter().filter(|board| problem.boards.get(**board) == Some(&true)).count();
    let shared = pins.keys().filter(|pin| problem.shared.contains(**pin)).count();
    Some([moved.len() as u64, rules.len() as u64, shared as u64, cost, spares as u64])
}

/// Whether all requests can have a stream of their own.
fn served(problem: &Problem, users: &BTreeSet<&str>) -> bool {
    let requests: Vec<&BTreeSet<String>> =
        users.iter().filter_map(|user| problem.dma.get(*user)).flatten().collect();
    fn place<'a>(requests: &[&'a BTreeSet<String>], taken: &mut BTreeSet<&'a str>) -> bool {
        let Some((request, rest)) = requests.split_first() else { return true };
        request.iter().any(|stream| {
            let free = taken.insert(stream);
            let placed = free && place(rest, taken);
            if free {
                taken.remove(stream.as_str());
            }
            placed
        })
    }
    place(&requests, &mut BTreeSet::new())
}

/// The five parts, the most important first.
#[must_use]
pub fn parts(objective: Objective) -> [u64; 5] {
    let Objective { moved, violated, shared, cost, spares } = objective;
    [moved, violated, shared, cost, spares].map(u64::from)
}
