//! The oracle: every combination is tried against the rules as `Problem` states them.

use sensedsl_solve::problem::{Candidate, Holder, Problem, StreamId};
use sensedsl_solve::{Choice, Objective};
use std::collections::BTreeSet;

/// An answer of the oracle, in the order of answers.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Found {
    pub objective: Objective,
    pub pins: Vec<Vec<u32>>,
    pub signals: Vec<Vec<u32>>,
    pub alternatives: Vec<usize>,
    pub candidates: Vec<Vec<usize>>,
}

impl Found {
    pub fn choices(&self) -> Vec<Choice> {
        let pairs = self.alternatives.iter().zip(&self.candidates);
        pairs.map(|(&alternative, c)| Choice { alternative, candidates: c.clone() }).collect()
    }
}

/// All answers, sorted best first.
pub fn all(problem: &Problem) -> Vec<Found> {
    let mut found = Vec::new();
    walk(problem, &mut Vec::new(), &mut found);
    found.sort();
    found
}

/// Upper bound of the number of combinations that `all` would try.
pub fn combinations(problem: &Problem) -> f64 {
    let ways = |d: &sensedsl_solve::problem::Device| -> f64 {
        let roles = |a: &sensedsl_solve::problem::Alternative| -> f64 {
            a.roles.iter().map(|r| r.candidates.len() as f64).product()
        };
        d.alternatives.iter().map(roles).sum()
    };
    problem.devices.iter().map(ways).product()
}

fn walk(problem: &Problem, chosen: &mut Vec<(usize, Vec<usize>)>, found: &mut Vec<Found>) {
    if !consistent(problem, chosen) {
        return;
    }
    let Some(device) = problem.devices.get(chosen.len()) else {
        if streams_suffice(problem, chosen) {
            found.push(read(problem, chosen));
        }
        return;
    };
    for (index, alternative) in device.alternatives.iter().enumerate() {
        let mut picks: Vec<Vec<usize>> = vec![vec![]];
        for role in &alternative.roles {
            let longer = |p: &Vec<usize>| {
                let p = p.clone();
                (0..role.candidates.len()).map(move |c| [p.clone(), vec![c]].concat())
            };
            picks = picks.iter().flat_map(longer).collect();
        }
        for pick in picks {
            chosen.push((index, pick));
            walk(problem, chosen, found);
            chosen.pop();
        }
    }
}

fn wires<'a>(
    problem: &'a Problem,
    device: usize,
    choice: &(usize, Vec<usize>),
) -> Vec<&'a Candidate> {
    let roles = &problem.devices[device].alternatives[choice.0].roles;
    roles.iter().zip(&choice.1).map(|(r, &c)| &r.candidates[c]).collect()
}

fn consistent(problem: &Problem, chosen: &[(usize, Vec<usize>)]) -> bool {
    let Some((last, before)) = chosen.split_last() else { return true };
    let new = wires(problem, before.len(), last);
    let pins: BTreeSet<u32> = new.iter().map(|c| c.pin.0).collect();
    if pins.len() != new.len() {
        return false;
    }
    let claims = |device: usize, choice: &(usize, Vec<usize>)| {
        let mut all = problem.devices[device].alternatives[choice.0].claims.clone();
        for c in wires(problem, device, choice) {
            all.extend(&c.claims);
        }
        all
    };
    let agree = |a: Holder, b: Holder| a == b && a != Holder::Own;
    before.iter().enumerate().all(|(device, old)| {
        let old_wires = wires(problem, device, old);
        let pins = old_wires.iter().all(|o| {
            new.iter()
                .all(|n| o.pin != n.pin || (agree(o.holder, n.holder) && o.signal == n.signal))
        });
        let mine = claims(before.len(), last);
        pins && claims(device, old)
            .iter()
            .all(|o| mine.iter().all(|n| o.resource != n.resource || agree(o.holder, n.holder)))
    })
}

fn streams_suffice(problem: &Problem, chosen: &[(usize, Vec<usize>)]) -> bool {
    let mut users: BTreeSet<sensedsl_solve::problem::DmaUserId> = BTreeSet::new();
    for (device, (alternative, _)) in chosen.iter().enumerate() {
        users.extend(&problem.devices[device].alternatives[*alternative].dma);
    }
    let requests = users.iter().flat_map(|u| &problem.dma[u.0 as usize].requests);
    let requests: Vec<Vec<&StreamId>> = requests.map(|r| r.streams.iter().collect()).collect();
    serve(&requests, &mut BTreeSet::new())
}

/// Whether each request can have a stream of its own that is not taken.
pub fn serve<'a, T: Ord>(requests: &[Vec<&'a T>], taken: &mut BTreeSet<&'a T>) -> bool {
    let Some((first, rest)) = requests.split_first() else { return true };
    for stream in first {
        if taken.insert(stream) {
            if serve(rest, taken) {
                return true;
            }
            taken.remove(stream);
        }
    }
    false
}

fn read(problem: &Problem, chosen: &[(usize, Vec<usize>)]) -> Found {
    let all: Vec<Vec<&Candidate>> =
        chosen.iter().enumerate().map(|(d, c)| wires(problem, d, c)).collect();
    let flat = || all.iter().flatten();
    let pins: BTreeSet<u32> = flat().map(|c| c.pin.0).collect();
    let moved: BTreeSet<u32> = flat().filter(|c| c.moved).map(|c| c.pin.0).collect();
    let mut rules: BTreeSet<u32> = flat().flat_map(|c| &c.violates).map(|r| r.0).collect();
    let mut spares = BTreeSet::new();
    for (device, (alternative, _)) in chosen.iter().enumerate() {
        let a = &problem.devices[device].alternatives[*alternative];
        rules.extend(a.violates.iter().map(|r| r.0));
        if problem.boards[a.board.0 as usize].spare {
            spares.insert(a.board.0);
        }
    }
    Found {
        objective: Objective {
            moved: moved.len() as u32,
            violated: rules.len() as u32,
            shared: pins.iter().filter(|&&p| problem.pins[p as usize].shared).count() as u32,
            cost: pins.iter().map(|&p| problem.pins[p as usize].cost).sum(),
            spares: spares.len() as u32,
        },
        pins: all.iter().map(|w| w.iter().map(|c| c.pin.0).collect()).collect(),
        signals: all.iter().map(|w| w.iter().map(|c| c.signal.0).collect()).collect(),
        alternatives: chosen.iter().map(|c| c.0).collect(),
        candidates: chosen.iter().map(|c| c.1.clone()).collect(),
    }
}
