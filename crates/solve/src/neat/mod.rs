//! Neat among the cheapest: a problem, its best answer and where pins are in, an answer out that is
//! as good and whose parts use fewer sides of connectors, and shorter runs of contacts on them.
//!
//! The search is a phase of its own after the search for the best answer: what is proved about the
//! objective stays as it is. The effort is counted in work, not in time, so that the same problem
//! has the same answer on every machine.

mod areas;
mod layout;
mod live;
mod near;
mod part;
mod pins;
mod question;
mod search;

pub use self::layout::{Contact, Layout, Neatness, Used};

use self::live::Live;
use self::part::{Parts, pins_between, runs_in_use, used};
use self::search::Search;
use crate::answer::{Answer, Fault, Optimality};
use crate::cancel::Cancel;
use crate::index::IdVec;
use crate::model::{Choices, Chosen, Model};
use crate::problem::Problem;
use crate::questions::solve::finish;
use crate::search::canonical::earliest;
use crate::search::{Effort, Engine};

/// The work that the search is worth, about 200 ms.
const ALL: u64 = 4_000_000;

/// An answer, and how neat it is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Neat {
    /// The answer.
    pub answer: Answer,
    /// How neat it is.
    pub neatness: Neatness,
    /// Proved: no answer that may cost as much is neater.
    pub is_proved: bool,
    /// The work of the search, in nodes.
    pub steps: u64,
}

/// Makes the best answer neater without making it worse, except that it may cost `rise` more. Of
/// equally neat answers it is the cheapest. If the best answer is among them, it stays; otherwise
/// it is the first that uses these sides and contacts, as far as a bounded effort shows.
///
/// # Errors
/// [`Fault`] when the problem is not well-formed, or when the answer fails [`check`](crate::check).
pub fn neaten(
    problem: &Problem,
    layout: &Layout,
    best: &Answer,
    rise: u32,
    cancel: Cancel<'_>,
) -> Result<Neat, Fault> {
    let neatness = layout.neatness(problem, best);
    let neat = |is_proved, steps| Neat { answer: best.clone(), neatness, is_proved, steps };
    if layout.is_empty() {
        return Ok(neat(true, 0));
    }
    let model = Model::new(problem)?;
    let Some(known) = choices(&model, best) else { return Ok(neat(false, 0)) };
    let Ok(mut engine) = Engine::new(problem, &model, cancel) else { return Ok(neat(false, 0)) };
    let limit = limit(&model, &known, rise);
    if engine.narrow(limit + 1).is_err() {
        return Ok(neat(false, 0));
    }
    let parts = Parts::new(&model, &engine.domains, layout);
    let until = engine.progress.work + ALL;
    let is_least = layout.used(problem, best).values().all(|used| used.is_least);
    let mut search = Search {
        engine: &mut engine,
        layout,
        parts: &parts,
        limit,
        spares: best.objective.spares,
        best: known.clone(),
        neatness,
        until,
        is_complete: is_least,
    };
    search.run();
    let (found, is_proved, reached) = (search.best, search.is_complete, search.neatness);
    let steps = engine.progress.work / 1_000;
    if reached >= neatness {
        return Ok(neat(is_proved, steps));
    }
    let first = first_in_order(&mut engine, layout, &parts, found.clone(), rise > 0);
    // Where pins may cost more, a wiring may save cost by one more spare board.
    let spares = model.weights.unpack(model.evaluate(&first)).spares;
    let found = if spares > best.objective.spares { found } else { first };
    let proof = if rise > 0 { Optimality::Feasible } else { best.optimality };
    let mut answer = finish(problem, &model, &found, proof)?;
    if answer.objective == best.objective {
        answer.optimality = best.optimality;
    }
    let neatness = layout.neatness(problem, &answer);
    Ok(Neat { answer, neatness, is_proved, steps })
}

/// The most that a wiring may weigh if its pins may cost so much more.
fn limit(model: &Model, known: &Choices, rise: u32) -> u64 {
    let (weight, weights) = (model.evaluate(known), model.weights);
    let most = weight - weight % weights.shared + weights.shared - 1;
    weight.saturating_add(u64::from(rise).saturating_mul(weights.cost)).min(most)
}

/// The answer as choices of the flat problem; none if it is an answer of another problem.
fn choices(model: &Model, answer: &Answer) -> Option<Choices> {
    let devices = model.devices.iter().zip(&answer.choices);
    let chosen = devices.map(|(device, choice)| {
        let alt = model.alts.of(device).nth(choice.alternative)?;
        let roles = model.roles.of(alt).iter().zip(&choice.candidates);
        let cands = roles.map(|(role, index)| model.cands.of(role).nth(*index));
        Some(Chosen { alt, cands: cands.collect::<Option<_>>()? })
    });
    let choices: IdVec<_, _> = chosen.collect::<Option<Vec<_>>>()?.into_iter().collect();
    (choices.len() == model.devices.len()).then_some(choices)
}

/// The first of the cheapest answers that use the sides and contacts of a known one.
fn first_in_order(
    engine: &mut Engine<'_>,
    layout: &Layout,
    parts: &Parts,
    known: Choices,
    may_be_cheaper: bool,
) -> Choices {
    let model = engine.model;
    let neatness = parts.neatness(model, layout, &known);
    let ordered = earliest(model, known.clone());
    let mut known =
        if parts.neatness(model, layout, &ordered) == neatness { ordered } else { known };
    for part in &parts.open {
        let live = Live::new(model, &engine.domains, &part.devices);
        let used = used(model, layout, &known, &part.devices);
        let area = pins_between(layout, &live, &runs_in_use(layout, &used));
        if engine.leave_pins(&part.devices, &area, u64::MAX).is_err() {
            return known;
        }
    }
    let mut weight = model.evaluate(&known);
    if may_be_cheaper {
        engine.progress.effort = Effort::Work(engine.progress.work + ALL / 4);
        if let Some((less, cheaper)) = engine.search(weight, false) {
            (weight, known) = (less, cheaper);
        }
        engine.progress.effort = Effort::Any;
        engine.progress.stopped = false;
    }
    engine.least_here(weight, known)
}
