//! Why there is no answer: an infeasible problem in, a minimal conflict out.
//!
//! Devices are left out as long as the rest stays without an answer; what remains is minimal by
//! proof. First only what is quickly seen counts, which keeps to conflicts that are easy to prove;
//! then every device is tried once more for good. The same is done to what those devices fight
//! for: streams, resources and pins stop being exclusive as long as there is still no answer.

use crate::answer::{Conflict, Fault, Outcome};
use crate::problem::{DeviceId, PinId, Problem, ResourceId, StreamId};
use crate::sharing::Things;
use crate::solve::{Effort, Stop, feasible_within};

/// Nodes of the search, beside three for each device, after which a proof is no longer quick.
const QUICK: u64 = 50;

/// Nodes that are spent on whether a thing has a part in the conflict of the devices found.
const PATIENT: u64 = 1_000;

/// The search for a conflict, and whether all its questions were answered.
struct Explanation<'a> {
    stop: Stop<'a>,
    effort: Effort,
    complete: bool,
}

/// Finds the conflict of a problem that has no answer. `seed` is a set of devices that is
/// probably one.
pub(crate) fn explain(
    problem: &Problem,
    seed: Option<Vec<usize>>,
    stop: Stop<'_>,
) -> Result<Outcome, Fault> {
    let quick = QUICK + 3 * problem.devices.len() as u64;
    let mut search = Explanation { stop, effort: Effort::Nodes(quick), complete: true };
    let all: Vec<usize> = (0..problem.devices.len()).collect();
    let mut kept = match seed {
        Some(seed) if search.infeasible(&only(problem, &seed))? => seed,
        _ => all,
    };
    search.leave_out(problem, &mut kept)?;
    search.effort = Effort::Any;
    search.complete = true;
    search.leave_out(problem, &mut kept)?;
    let minimal = search.complete;
    search.effort = Effort::Nodes(PATIENT);
    // A reason of one kind is the best to read: one kind after another is left out as a whole
    // first (signals are as good as pins, but pins are what people see).
    let mut core = only(problem, &kept);
    for things in [Things::Streams, Things::Resources, Things::Pins] {
        let relaxed = things.share(&core, &things.of(&core));
        if search.infeasible(&relaxed)? {
            core = relaxed;
        }
    }
    let streams = search.contested(&mut core, Things::Streams)?;
    let pins = search.contested(&mut core, Things::Pins)?;
    let resources = search.contested(&mut core, Things::Resources)?;
    // Copies made for sharing stand for nothing of the problem.
    let streams = streams.into_iter().filter(|s| *s < problem.streams);
    Ok(Outcome::Infeasible(Conflict {
        devices: kept.into_iter().map(|d| DeviceId(d as u32)).collect(),
        pins: pins.into_iter().map(PinId).collect(),
        resources: resources.into_iter().map(ResourceId).collect(),
        streams: streams.map(StreamId).collect(),
        minimal,
    }))
}

impl Explanation<'_> {
    /// What is not known counts as feasible: the conflict then is valid, though perhaps not
    /// minimal.
    fn infeasible(&mut self, problem: &Problem) -> Result<bool, Fault> {
        let feasible = feasible_within(problem, self.effort, self.stop)?;
        self.complete &= feasible.is_some();
        Ok(feasible == Some(false))
    }

    /// Leaves devices out as long as the others have no answer: many at once first, because most
    /// have no part in it.
    fn leave_out(&mut self, problem: &Problem, kept: &mut Vec<usize>) -> Result<(), Fault> {
        let quick = matches!(self.effort, Effort::Nodes(_));
        let mut chunk = if quick { kept.len().div_ceil(2) } else { 1 };
        while chunk > 0 {
            let mut end = kept.len();
            while end > 0 {
                let start = end.saturating_sub(chunk);
                let mut fewer = kept.clone();
                fewer.drain(start..end);
                if self.infeasible(&only(problem, &fewer))? {
                    *kept = fewer;
                }
                end = start;
            }
            chunk /= 2;
        }
        Ok(())
    }

    /// Shares all, then ever smaller parts, of the things as long as the conflict stays; returns
    /// those that must be exclusive for it.
    fn contested(&mut self, core: &mut Problem, things: Things) -> Result<Vec<u32>, Fault> {
        let mut parts = vec![things.of(core).into_iter().collect::<Vec<u32>>()];
        let mut needed = Vec::new();
        while let Some(part) = parts.pop() {
            if part.is_empty() {
                continue;
            }
            let relaxed = things.share(core, &part.iter().copied().collect());
            if self.infeasible(&relaxed)? {
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
}

fn only(problem: &Problem, devices: &[usize]) -> Problem {
    let kept = devices.iter().filter_map(|&d| problem.devices.get(d)).cloned().collect();
    Problem { devices: kept, ..problem.clone() }
}
