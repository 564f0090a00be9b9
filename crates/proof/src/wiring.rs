//! Checks that a wiring keeps all rules, and computes its objective.

use crate::format::{Alternative, Answer, Candidate, OWN, Objective, Problem};
use crate::verdict::{Refuted, ensure};
use std::collections::{BTreeMap, BTreeSet};

/// The holders of a thing: the devices, and on whose behalf. Each device's own behalf is a
/// different one.
#[derive(Default)]
struct Held<'a> {
    devices: BTreeSet<&'a str>,
    holders: BTreeSet<(&'a str, &'a str)>,
}

impl<'a> Held<'a> {
    fn join(&mut self, device: &'a str, holder: &'a str, signal: &'a str) {
        self.devices.insert(device);
        self.holders.insert((holder, if holder == OWN { device } else { signal }));
    }

    fn agree(&self) -> bool {
        self.devices.len() == 1 || self.holders.len() == 1
    }
}

/// Everything that is in use.
#[derive(Default)]
struct Used<'a> {
    pins: BTreeMap<&'a str, Held<'a>>,
    resources: BTreeMap<&'a str, Held<'a>>,
    moved: BTreeSet<&'a str>,
    rules: BTreeSet<&'a str>,
    boards: BTreeSet<&'a str>,
    dma: BTreeSet<&'a str>,
}

/// The objective of the answer's wiring.
pub(crate) fn objective(problem: &Problem, answer: &Answer) -> Result<Objective, Refuted> {
    let mut used = Used::default();
    ensure(answer.wiring.len() == problem.devices.len(), || {
        "the wiring is not one of the devices asked for".into()
    })?;
    for (device, alternatives) in &problem.devices {
        let wrong = || Refuted(format!("{device} is not wired as one of its alternatives"));
        let choice = answer.wiring.get(device).ok_or_else(wrong)?;
        let alternative = alternatives.get(&choice.takes).ok_or_else(wrong)?;
        ensure(alternative.roles.len() == choice.wires.len(), || wrong().0)?;
        let mut wires = Vec::new();
        for (role, candidates) in &alternative.roles {
            let candidate = choice.wires.get(role).and_then(|name| candidates.get(name));
            wires.push(candidate.ok_or_else(wrong)?);
        }
        used.add(device, alternative, &wires)?;
    }
    for (pin, held) in &used.pins {
        ensure(held.agree(), || format!("pin {pin} is held twice"))?;
    }
    for (resource, held) in &used.resources {
        ensure(held.agree(), || format!("{resource} is held twice"))?;
    }
    streams(problem, answer, &used.dma)?;
    used.objective(problem)
}

impl<'a> Used<'a> {
    fn add(
        &mut self,
        device: &'a str,
        alternative: &'a Alternative,
        wires: &[&'a Candidate],
    ) -> Result<(), Refuted> {
        self.boards.insert(&alternative.board);
        self.dma.extend(alternative.dma.iter().map(String::as_str));
        self.rules.extend(alternative.violates.iter().map(String::as_str));
        let mut claims: Vec<_> = alternative.claims.iter().collect();
        for Candidate { pin, holder, signal, claims: more, violates, moved } in wires {
            let held = self.pins.entry(pin).or_default();
            ensure(!held.devices.contains(device), || format!("{device} uses pin {pin} twice"))?;
            held.join(device, holder, signal);
            claims.extend(more);
            self.rules.extend(violates.iter().map(String::as_str));
            self.moved.extend(moved.then_some(pin.as_str()));
        }
        for (resource, holder) in claims {
            self.resources.entry(resource).or_default().join(device, holder, "");
        }
        Ok(())
    }

    fn objective(&self, problem: &Problem) -> Result<Objective, Refuted> {
        let mut cost: u32 = 0;
        for pin in self.pins.keys() {
            let one = problem.pins.get(*pin).and_then(|one| cost.checked_add(*one));
            cost = one.ok_or_else(|| Refuted(format!("pin {pin} has no proper cost")))?;
        }
        let spares = self.boards.iter().filter(|board| problem.boards.get(**board) == Some(&true));
        Ok(Objective {
            moved: self.moved.len() as u32,
            violated: self.rules.len() as u32,
            shared: self.pins.keys().filter(|pin| problem.shared.contains(**pin)).count() as u32,
            cost,
            spares: spares.count() as u32,
        })
    }
}

/// Checks that all requests of the peripherals in use have a stream of their own.
fn streams(problem: &Problem, answer: &Answer, used: &BTreeSet<&str>) -> Result<(), Refuted> {
    let mut taken = BTreeSet::new();
    ensure(answer.streams.len() == used.len(), || "streams are given to who needs none".into())?;
    for user in used {
        let wrong = || Refuted(format!("the DMA requests of {user} are not served"));
        let requests = problem.dma.get(*user).ok_or_else(wrong)?;
        let given = answer.streams.get(*user).ok_or_else(wrong)?;
        ensure(requests.len() == given.len(), || wrong().0)?;
        for (request, stream) in requests.iter().zip(given) {
            ensure(request.contains(stream), || wrong().0)?;
            ensure(taken.insert(stream), || format!("stream {stream} is held twice"))?;
        }
    }
    Ok(())
}
