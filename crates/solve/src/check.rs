//! The independent checker: a problem and an answer in, the first broken rule out.
//!
//! It shares no code with the search, reads the rules of [`Problem`] one by one and recomputes the
//! objective, so that a mistake of the search cannot leave the crate as a wiring.

use crate::answer::{Answer, Objective};
use crate::problem::{
    Alternative, Candidate, DeviceId, DmaUserId, Holder, PinId, Problem, ResourceId, RuleId,
    SignalId, StreamId,
};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

/// The rule that an answer breaks.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Violation {
    /// A device without exactly one choice, or a choice of an alternative or candidate that does
    /// not exist.
    Shape(DeviceId),
    /// Two roles of one device on one pin.
    OwnPinTwice(DeviceId, PinId),
    /// A pin held by devices that are not one group, or with different signals.
    Pin(PinId),
    /// A resource held by devices that are not one group.
    Resource(ResourceId),
    /// A used DMA user without its streams, an unused one with streams, or one out of order.
    Dma(DmaUserId),
    /// A stream held twice, or one that cannot serve its request.
    Stream(StreamId),
    /// The objective is not what the wiring costs.
    Objective {
        /// The objective that the answer states.
        stated: Objective,
        /// The objective computed from the choices.
        actual: Objective,
    },
}

impl fmt::Display for Violation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Shape(d) => write!(f, "device {} has no valid choice", d.0),
            Self::OwnPinTwice(d, p) => write!(f, "device {} uses pin {} twice", d.0, p.0),
            Self::Pin(p) => write!(f, "pin {} is held twice", p.0),
            Self::Resource(r) => write!(f, "resource {} is held twice", r.0),
            Self::Dma(u) => write!(f, "DMA user {} is not served", u.0),
            Self::Stream(s) => write!(f, "DMA stream {} is given wrongly", s.0),
            Self::Objective { stated, actual } => {
                write!(f, "objective {stated:?} stated, {actual:?} found")
            }
        }
    }
}

/// One device's hold on a pin (with its signal) or on a resource.
struct Held<T> {
    device: DeviceId,
    holder: Holder,
    signal: T,
}

#[derive(Default)]
struct Ledger {
    pins: BTreeMap<PinId, Vec<Held<SignalId>>>,
    resources: BTreeMap<ResourceId, Vec<Held<()>>>,
    users: BTreeSet<DmaUserId>,
    rules: BTreeSet<RuleId>,
    moved: BTreeSet<PinId>,
    boards: BTreeSet<u32>,
}

/// Checks an answer against every rule of the problem, including the stated objective.
///
/// # Errors
/// The first [`Violation`] found.
pub fn check(problem: &Problem, answer: &Answer) -> Result<(), Violation> {
    let mut ledger = Ledger::default();
    for (number, device) in (0..).zip(&problem.devices) {
        let id = DeviceId(number);
        let choice = answer.choices.get(number as usize).ok_or(Violation::Shape(id))?;
        let alternative =
            device.alternatives.get(choice.alternative).ok_or(Violation::Shape(id))?;
        if alternative.roles.len() != choice.candidates.len() {
            return Err(Violation::Shape(id));
        }
        let mut wires = Vec::new();
        for (role, &index) in alternative.roles.iter().zip(&choice.candidates) {
            wires.push(role.candidates.get(index).ok_or(Violation::Shape(id))?);
        }
        ledger.book(id, alternative, &wires)?;
    }
    if answer.choices.len() != problem.devices.len() {
        return Err(Violation::Shape(DeviceId(problem.devices.len() as u32)));
    }
    check_dma(problem, answer, &ledger.users)?;
    let actual = ledger.objective(problem);
    if actual != answer.objective {
        return Err(Violation::Objective { stated: answer.objective, actual });
    }
    Ok(())
}

impl Ledger {
    fn book(
        &mut self,
        id: DeviceId,
        alternative: &Alternative,
        wires: &[&Candidate],
    ) -> Result<(), Violation> {
        let mut own = BTreeSet::new();
        for wire in wires {
            if !own.insert(wire.pin) {
                return Err(Violation::OwnPinTwice(id, wire.pin));
            }
            let held = Held { device: id, holder: wire.holder, signal: wire.signal };
            join(self.pins.entry(wire.pin).or_default(), held).ok_or(Violation::Pin(wire.pin))?;
            if wire.moved {
                self.moved.insert(wire.pin);
            }
            self.rules.extend(&wire.violates);
        }
        let claims = alternative.claims.iter().chain(wires.iter().flat_map(|w| &w.claims));
        for claim in claims {
            let held = Held { device: id, holder: claim.holder, signal: () };
            join(self.resources.entry(claim.resource).or_default(), held)
                .ok_or(Violation::Resource(claim.resource))?;
        }
        self.users.extend(&alternative.dma);
        self.rules.extend(&alternative.violates);
        self.boards.insert(alternative.board.0);
        Ok(())
    }

    fn objective(&self, problem: &Problem) -> Objective {
        let cost = |p: &PinId| problem.pins.get(p.0 as usize).map_or(0, |pin| pin.cost);
        let shared = |p: &&PinId| problem.pins.get(p.0 as usize).is_some_and(|pin| pin.shared);
        let spare = |b: &&u32| problem.boards.get(**b as usize).is_some_and(|board| board.spare);
        Objective {
            moved: self.moved.len() as u32,
            violated: self.rules.len() as u32,
            shared: self.pins.keys().filter(shared).count() as u32,
            cost: self.pins.keys().map(cost).sum(),
            spares: self.boards.iter().filter(spare).count() as u32,
        }
    }
}

/// Adds a holder unless it conflicts with the holder of another device.
fn join<T: PartialEq>(holders: &mut Vec<Held<T>>, new: Held<T>) -> Option<()> {
    let agrees = |old: &Held<T>| {
        old.device == new.device
            || (old.holder == new.holder && old.holder != Holder::Own && old.signal == new.signal)
    };
    if !holders.iter().all(agrees) {
        return None;
    }
    holders.push(new);
    Some(())
}

fn check_dma(
    problem: &Problem,
    answer: &Answer,
    used: &BTreeSet<DmaUserId>,
) -> Result<(), Violation> {
    let mut taken = BTreeSet::new();
    let mut expected = used.iter();
    for (user, streams) in &answer.dma {
        if expected.next() != Some(user) {
            return Err(Violation::Dma(*user));
        }
        let requests =
            problem.dma.get(user.0 as usize).map(|u| &u.requests).ok_or(Violation::Dma(*user))?;
        if requests.len() != streams.len() {
            return Err(Violation::Dma(*user));
        }
        for (request, stream) in requests.iter().zip(streams) {
            if !request.streams.contains(stream) || !taken.insert(*stream) {
                return Err(Violation::Stream(*stream));
            }
        }
    }
    expected.next().map_or(Ok(()), |user| Err(Violation::Dma(*user)))
}
