//! Why there is no answer: an infeasible problem in, a minimal conflict out.
//!
//! This is a deletion filter (J. W. Chinneck and E. W. Dravnieks, *Locating minimal infeasible
//! constraint sets in linear programs*, 1991): devices are left out as long as the rest still has
//! no answer, and what remains is provably minimal. Large parts are left out first and halved if
//! that fails, as in delta debugging (A. Zeller and R. Hildebrandt, *Simplifying and isolating
//! failure-inducing input*, 2002) and QuickXplain (U. Junker, 2004). At first only quick proofs
//! count, which favours conflicts that are easy to prove; then every device is tried once more
//! without a limit. The same is done to what those devices compete for: streams, resources and pins
//! stop being exclusive as long as there is still no answer.
//!
//! Only the number of interchangeable devices matters, so most of these questions are never asked
//! ([`super::known_sets`]).

use super::known_sets::{KnownSets, LARGE};
use super::sharing::Contested;
use super::solve::feasible_within;
use crate::answer::{Conflict, Fault, Outcome};
use crate::cancel::Cancel;
use crate::index::Id;
use crate::problem::{DeviceId, PinId, Problem, ResourceId, StreamId};
use crate::search::{Budget, Effort};
use std::collections::BTreeSet;

/// A proof is quick if it takes at most this many nodes, plus three for each device.
const QUICK: u64 = 50;

/// The questions asked in a search for a conflict.
struct Questions<'a> {
    cancel: Cancel<'a>,
    effort: Effort,
    /// The budget for asking whether a pin, resource or stream has a part in the conflict.
    budget: Option<Budget>,
    /// The sets of devices that are known to have, or not to have, an answer.
    known: KnownSets,
}

/// Finds the conflict of a problem that has no answer. `seed` is a set of devices that is probably
/// a conflict.
pub(crate) fn explain(
    problem: &Problem,
    seed: Option<Vec<DeviceId>>,
    cancel: Cancel<'_>,
) -> Result<Outcome, Fault> {
    if let Some(lone) = problem.devices.iter().position(|d| d.alternatives.is_empty()) {
        return Ok(conflict(vec![DeviceId::new(lone)], true, [Vec::new(), Vec::new(), Vec::new()]));
    }
    let quick = QUICK + 3 * problem.devices.len() as u64;
    let mut ask = Questions {
        cancel,
        effort: Effort::Nodes(quick),
        budget: None,
        known: KnownSets::new(problem)?,
    };
    let mut kept = match seed {
        Some(seed) if ask.of_devices(problem, &seed)? == Some(false) => seed,
        _ => (0..problem.devices.len()).map(DeviceId::new).collect(),
    };
    ask.ask_of_large_classes(problem, &kept)?;
    let unknown = ask.leave_out(problem, &mut kept)?;
    ask.effort = Effort::Any;
    let mut minimal = true;
    for device in unknown {
        let fewer: Vec<DeviceId> = kept.iter().copied().filter(|&d| d != device).collect();
        match ask.of_devices(problem, &fewer)? {
            Some(false) => kept = fewer,
            Some(true) => {}
            None => minimal = false,
        }
    }
    ask.budget = Some(Budget::new());
    let mut things = [Vec::new(), Vec::new(), Vec::new()];
    if !cancel.is_over() {
        things = ask.contested_things(only(problem, &kept))?;
    }
    // Anything that could no longer be asked about is not known to have a part in the conflict.
    if cancel.is_over() {
        things = [Vec::new(), Vec::new(), Vec::new()];
    }
    Ok(conflict(kept, minimal, things))
}

fn conflict(
    devices: Vec<DeviceId>,
    minimal: bool,
    [streams, resources, pins]: [Vec<u32>; 3],
) -> Outcome {
    Outcome::Infeasible(Conflict {
        devices,
        pins: pins.into_iter().map(PinId).collect(),
        resources: resources.into_iter().map(ResourceId).collect(),
        streams: streams.into_iter().map(StreamId).collect(),
        minimal,
    })
}

impl Questions<'_> {
    /// Whether the problem has an answer; `None` if finding out takes more than the effort.
    fn has_answer(&mut self, problem: &Problem) -> Result<Option<bool>, Fault> {
        let work = self.budget.as_ref().map(|budget| Effort::Work(budget.next()));
        let (answer, work) = feasible_within(problem, work.unwrap_or(self.effort), self.cancel)?;
        if let Some(budget) = &mut self.budget {
            budget.spend(work);
        }
        Ok(answer)
    }

    /// Whether the problem has an answer with only these devices, as [`Self::has_answer`].
    fn of_devices(
        &mut self,
        problem: &Problem,
        devices: &[DeviceId],
    ) -> Result<Option<bool>, Fault> {
        if let Some(known) = self.known.tells(devices) {
            return Ok(Some(known));
        }
        if self.cancel.is_over() {
            return Ok(None);
        }
        let answer = self.has_answer(&only(problem, devices))?;
        if let Some(has) = answer {
            self.known.learn(devices, has);
        }
        Ok(answer)
    }

    /// Asks for each large class of interchangeable devices whether it is a conflict by itself,
    /// which is quickly known. For those that are (for all classes if none is), it asks whether
    /// there is just one device too many: then each device of the class is needed, and no question
    /// that leaves one out has to be asked.
    fn ask_of_large_classes(&mut self, problem: &Problem, kept: &[DeviceId]) -> Result<(), Fault> {
        let large_classes = self.known.large_classes(kept);
        let mut alone = Vec::new();
        for class in &large_classes {
            if self.of_devices(problem, class)? == Some(false) {
                alone.push(class);
            }
        }
        let all: Vec<&Vec<DeviceId>> = large_classes.iter().collect();
        for class in if alone.is_empty() { all } else { alone } {
            let one = class.first();
            let fewer: Vec<DeviceId> = kept.iter().copied().filter(|d| Some(d) != one).collect();
            self.of_devices(problem, &fewer)?;
        }
        Ok(())
    }

    /// Leaves devices out as long as the others have no answer, many at once first, because most
    /// have no part in the conflict. Returns those that are kept without a proof that they are
    /// needed.
    fn leave_out(
        &mut self,
        problem: &Problem,
        kept: &mut Vec<DeviceId>,
    ) -> Result<Vec<DeviceId>, Fault> {
        let mut unknown = Vec::new();
        let mut chunk = kept.len().div_ceil(2);
        while chunk > 0 {
            let mut end = kept.len();
            while end > 0 {
                let start = end.saturating_sub(chunk);
                let mut fewer = kept.clone();
                let out = fewer.drain(start..end).next();
                match self.of_devices(problem, &fewer)? {
                    Some(false) => *kept = fewer,
                    None if chunk == 1 => unknown.extend(out),
                    Some(true) | None => {}
                }
                end = start;
            }
            chunk /= 2;
        }
        Ok(unknown)
    }

    /// The streams, resources and pins that must be exclusive for the conflict. Reasons of one kind
    /// are the easiest to read, so each kind is first shared as a whole. Pins come last: signals
    /// would explain just as much, but people see pins.
    fn contested_things(&mut self, mut core: Problem) -> Result<[Vec<u32>; 3], Fault> {
        let streams = core.streams;
        let mut needed = [Vec::new(), Vec::new(), Vec::new()];
        let kinds = [Contested::Streams, Contested::Resources, Contested::Pins];
        for (things, needed) in kinds.into_iter().zip(&mut needed) {
            let all = things.of(&core);
            if all.is_empty() {
                continue;
            }
            let relaxed = things.share(&core, &all);
            if self.has_answer(&relaxed)? == Some(false) {
                core = relaxed;
            } else {
                needed.extend(all);
            }
        }
        let [of_streams, of_resources, of_pins] = &mut needed;
        *of_streams = self.contested(&mut core, Contested::Streams, std::mem::take(of_streams))?;
        *of_pins = self.contested(&mut core, Contested::Pins, std::mem::take(of_pins))?;
        *of_resources =
            self.contested(&mut core, Contested::Resources, std::mem::take(of_resources))?;
        // Copies made for sharing do not exist in the problem.
        of_streams.retain(|stream| *stream < streams);
        Ok(needed)
    }

    /// Not all of these can be shared. Shares ever smaller parts as long as the conflict remains,
    /// and returns those that must be exclusive.
    fn contested(
        &mut self,
        core: &mut Problem,
        things: Contested,
        all: Vec<u32>,
    ) -> Result<Vec<u32>, Fault> {
        let certain = self.needed_alone(core, things, &all)?;
        let mut parts = vec![(all, true)];
        let mut needed = Vec::new();
        while let Some((part, known)) = parts.pop() {
            if part.is_empty() {
                continue;
            }
            if self.cancel.is_over() {
                break;
            }
            if !known && !part.iter().any(|one| certain.contains(one)) {
                let relaxed = things.share(core, &part.iter().copied().collect());
                if self.has_answer(&relaxed)? == Some(false) {
                    *core = relaxed;
                    continue;
                }
            }
            if let [one] = part.as_slice() {
                needed.push(*one);
                continue;
            }
            let (left, right) = part.split_at(part.len() / 2);
            parts.push((right.to_vec(), false));
            parts.push((left.to_vec(), false));
        }
        needed.sort_unstable();
        Ok(needed)
    }
}

impl Questions<'_> {
    /// The members of each large class in which sharing a single member is enough for an answer.
    fn needed_alone(
        &mut self,
        core: &Problem,
        things: Contested,
        all: &[u32],
    ) -> Result<BTreeSet<u32>, Fault> {
        let mut needed = BTreeSet::new();
        for class in things.interchangeable(core, all) {
            if let Some(&one) = class.first().filter(|_| class.len() >= LARGE)
                && !self.cancel.is_over()
                && self.has_answer(&things.share(core, &BTreeSet::from([one])))? == Some(true)
            {
                needed.extend(class);
            }
        }
        Ok(needed)
    }
}

fn only(problem: &Problem, devices: &[DeviceId]) -> Problem {
    Problem {
        pins: problem.pins.clone(),
        boards: problem.boards.clone(),
        devices: devices.iter().filter_map(|d| problem.devices.get(d.index())).cloned().collect(),
        dma: problem.dma.clone(),
        rules: problem.rules,
        resources: problem.resources,
        streams: problem.streams,
    }
}
