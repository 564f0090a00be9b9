//! All answers, best first: a problem in, a lazy iterator out.
//!
//! A depth-first search over the entries of the tie-break visits the answers of one objective in
//! order. It enters a branch only if there is an answer within the objective in it, so no part of
//! the walk is wasted (R. C. Read and R. E. Tarjan, *Bounds on backtrack algorithms for listing
//! cycles, paths, and spanning trees*, 1975). After that it searches for the least objective above.

use super::solve::finish;
use crate::answer::{Answer, Fault, Optimality};
use crate::bounds::flow::Saved;
use crate::cancel::Cancel;
use crate::model::{Choices, Model};
use crate::problem::Problem;
use crate::search::tie_break::{Entry, Value, entries};
use crate::search::{Engine, Parked};

/// Iterator over all answers of a problem: by objective, then pins, then signals.
///
/// An item is an error only where [`crate::solve`] gives one, or if it is [`Fault::Cancelled`].
/// Nothing follows an error.
pub struct Answers<'a> {
    problem: &'a Problem,
    cancel: Cancel<'a>,
    model: Model,
    entries: Vec<Entry>,
    walk: Walk,
    /// Objective of the present answers.
    level: u64,
    best: u64,
}

enum Walk {
    Failed(Fault),
    New(Parked),
    Under(Parked, Vec<Frame>),
    Over,
}

/// An entry with its values, of which those before `next` are done.
struct Frame {
    entry: Entry,
    /// Position of the next entry.
    after: usize,
    values: Vec<Value>,
    next: usize,
    mark: usize,
    saved: Saved,
    /// An answer below this frame.
    known: Choices,
}

/// All answers of a problem, best first.
#[must_use]
pub fn enumerate<'a>(problem: &'a Problem, cancel: Cancel<'a>) -> Answers<'a> {
    let (model, fault) = match Model::new(problem) {
        Ok(model) => (model, None),
        Err(fault) => (Model::default(), Some(fault)),
    };
    let walk = match (fault, Engine::new(problem, &model, cancel)) {
        (Some(fault), _) => Walk::Failed(fault),
        (None, Ok(engine)) => Walk::New(engine.park()),
        (None, Err(_)) => Walk::Over,
    };
    Answers { problem, cancel, entries: entries(&model), walk, model, level: 0, best: 0 }
}

impl Iterator for Answers<'_> {
    type Item = Result<Answer, Fault>;

    fn next(&mut self) -> Option<Self::Item> {
        if matches!(self.walk, Walk::Over) {
            return None;
        }
        let next = self.following();
        // An answer that was found while time ran out may not be the next one.
        if self.cancel.is_over() {
            self.walk = Walk::Over;
            return Some(Err(Fault::Cancelled));
        }
        next
    }
}

impl Answers<'_> {
    fn following(&mut self) -> Option<Result<Answer, Fault>> {
        let (choices, parked, frames) = match std::mem::replace(&mut self.walk, Walk::Over) {
            Walk::Failed(fault) => return Some(Err(fault)),
            Walk::Over => return None,
            Walk::New(parked) => {
                let mut engine = Engine::resume(self.problem, &self.model, parked, self.cancel);
                let (weight, known) = engine.search(u64::MAX, false)?;
                (self.level, self.best) = (weight, weight);
                let mut frames = Vec::new();
                let first = begin(&mut engine, &self.entries, known, &mut frames);
                let choices = match first {
                    Some(only) => Some(only),
                    None => advance(&mut engine, &self.entries, self.level, &mut frames),
                };
                (choices, engine.park(), frames)
            }
            Walk::Under(parked, mut frames) => {
                let mut engine = Engine::resume(self.problem, &self.model, parked, self.cancel);
                let choices = advance(&mut engine, &self.entries, self.level, &mut frames);
                (choices, engine.park(), frames)
            }
        };
        let (choices, parked, frames) = match choices {
            Some(choices) => (choices, parked, frames),
            None => self.next_level(parked)?,
        };
        self.walk = Walk::Under(parked, frames);
        let proof = if self.level == self.best { Optimality::Proved } else { Optimality::Feasible };
        let answer = finish(self.problem, &self.model, &choices, proof);
        if answer.is_err() {
            self.walk = Walk::Over;
        }
        Some(answer)
    }

    /// Goes up to the next objective that some answer has.
    fn next_level(&mut self, parked: Parked) -> Option<(Choices, Parked, Vec<Frame>)> {
        let mut engine = Engine::resume(self.problem, &self.model, parked, self.cancel);
        let (weight, known) = engine.search_above(self.level)?;
        self.level = weight;
        let mut frames = Vec::new();
        let choices = match begin(&mut engine, &self.entries, known, &mut frames) {
            Some(only) => Some(only),
            None => advance(&mut engine, &self.entries, self.level, &mut frames),
        };
        choices.map(|choices| (choices, engine.park(), frames))
    }
}

/// Opens the first entry that is not settled. If all are settled, the answer is complete.
fn begin(
    engine: &mut Engine<'_>,
    entries: &[Entry],
    known: Choices,
    frames: &mut Vec<Frame>,
) -> Option<Choices> {
    if engine.settle().is_err() {
        return None;
    }
    open(engine, entries, 0, known, frames)
}

fn open(
    engine: &Engine<'_>,
    entries: &[Entry],
    from: usize,
    known: Choices,
    frames: &mut Vec<Frame>,
) -> Option<Choices> {
    let mut open = entries.iter().enumerate().skip(from);
    let Some((position, &entry)) = open.find(|(_, entry)| !engine.settled(**entry)) else {
        return Some(known);
    };
    frames.push(Frame {
        entry,
        after: position + 1,
        values: engine.values(entry),
        next: 0,
        mark: engine.domains.mark(),
        saved: engine.flow.save(),
        known,
    });
    None
}

/// The next answer of exactly this objective.
fn advance(
    engine: &mut Engine<'_>,
    entries: &[Entry],
    level: u64,
    frames: &mut Vec<Frame>,
) -> Option<Choices> {
    while let Some(frame) = frames.last_mut() {
        if engine.progress.stopped {
            return None;
        }
        engine.back(frame.mark, &frame.saved);
        let Some(&value) = frame.values.get(frame.next) else {
            frames.pop();
            continue;
        };
        frame.next += 1;
        let (entry, after) = (frame.entry, frame.after);
        let same = entry.of(engine.model, &frame.known) == value;
        let known = same.then(|| frame.known.clone());
        if engine.restrict(entry, value).is_err() {
            continue;
        }
        let found = known.or_else(|| engine.search(level + 1, true).map(|(_, choices)| choices));
        let Some(known) = found else { continue };
        if let Some(choices) = open(engine, entries, after, known, frames)
            && engine.model.evaluate(&choices) == level
        {
            return Some(choices);
        }
    }
    None
}
