//! One answer: a problem in, the best wiring or the reason why there is none out.

use super::conflict;
use crate::answer::{Answer, Fault, Objective, Optimality, Outcome};
use crate::cancel::Cancel;
use crate::check::check;
use crate::domains::Pruned;
use crate::index::Id;
use crate::matching;
use crate::model::{Choices, Model};
use crate::problem::{DeviceId, DmaUserId, Problem};
use crate::search::{Effort, Engine, PseudoCosts};
use std::collections::BTreeSet;

/// The options of a search.
#[derive(Clone, Copy, Default)]
pub struct Options<'a> {
    /// True if any valid answer will do.
    pub any: bool,
    /// Ends the search with whatever is known by then.
    pub cancel: Cancel<'a>,
}

/// Experience from a search with the branches of its problem. It makes another search of the same
/// problem faster; the answer is just as good without it, and no proof relies on it.
#[derive(Clone, Debug, Default)]
pub struct Experience(pub(crate) PseudoCosts);

/// Finds the best answer, or a minimal conflict. It is proved that no answer is better. Of equally
/// good answers it is the first, as far as a bounded effort shows, and the same one on every
/// machine.
///
/// # Errors
/// [`Fault`] when the problem is not well-formed, or when an answer fails [`check`].
pub fn solve(problem: &Problem, options: &Options<'_>) -> Result<Outcome, Fault> {
    Ok(solve_and_learn(problem, options)?.0)
}

/// Like [`solve`], but also returns what [`record`](crate::record) starts from.
///
/// # Errors
/// The same as [`solve`].
pub fn solve_and_learn(
    problem: &Problem,
    options: &Options<'_>,
) -> Result<(Outcome, Experience), Fault> {
    let mut learned = Experience::default();
    let outcome = match search(problem, options, true, &mut learned)? {
        Searched::Ended(outcome) => outcome,
        Searched::Infeasible(seed) => conflict::explain(problem, seed, options.cancel)?,
    };
    Ok((outcome, learned))
}

/// Finds one of the best answers, whichever comes up first, or nothing if there is none. This saves
/// most of the time: the search for a reason why there is none, or for the best answer that is
/// first in order.
///
/// # Errors
/// The same as [`solve`].
pub fn one_of_the_best(problem: &Problem, cancel: Cancel<'_>) -> Result<Option<Outcome>, Fault> {
    let options = Options { any: false, cancel };
    Ok(match search(problem, &options, false, &mut Experience::default())? {
        Searched::Ended(outcome) => Some(outcome),
        Searched::Infeasible(_) => None,
    })
}

/// The result of a search.
enum Searched {
    Ended(Outcome),
    /// No answer, and devices that probably have none by themselves.
    Infeasible(Option<Vec<DeviceId>>),
}

fn search(
    problem: &Problem,
    options: &Options<'_>,
    least: bool,
    learned: &mut Experience,
) -> Result<Searched, Fault> {
    let cancel = options.cancel;
    if cancel.is_over() {
        let bound = Objective::default();
        return Ok(Searched::Ended(Outcome::Stopped { answer: None, bound }));
    }
    let model = Model::new(problem)?;
    let Ok(mut engine) = Engine::new(problem, &model, cancel) else {
        return Ok(Searched::Infeasible(None));
    };
    engine.board_symmetry = true;
    if let Err(Pruned) = engine.settle() {
        return Ok(Searched::Infeasible(Some(engine.flow.stuck(&model))));
    }
    let bound = engine.bound();
    let found = engine.search(u64::MAX, options.any);
    if let Some(pricing) = &engine.pricing {
        learned.0 = pricing.pseudo_costs().clone();
    }
    let proved = model.weights.unpack(engine.goal.proved.max(bound));
    let stopped = |answer| Searched::Ended(Outcome::Stopped { answer, bound: proved });
    let Some((weight, choices)) = found else {
        let stopped = engine.progress.stopped.then(|| stopped(None));
        return Ok(stopped.unwrap_or(Searched::Infeasible(None)));
    };
    if options.any || engine.progress.stopped {
        let answer = finish(problem, &model, &choices, Optimality::Feasible)?;
        return Ok(if engine.progress.stopped {
            stopped(Some(answer))
        } else {
            Searched::Ended(Outcome::Solved(answer))
        });
    }
    let choices = if least { engine.least(weight, choices) } else { choices };
    if engine.progress.stopped {
        let answer = finish(problem, &model, &choices, Optimality::Feasible)?;
        let bound = answer.objective;
        return Ok(Searched::Ended(Outcome::Stopped { answer: Some(answer), bound }));
    }
    let answer = finish(problem, &model, &choices, Optimality::Proved)?;
    Ok(Searched::Ended(Outcome::Solved(answer)))
}

/// Whether there is an answer at all; `None` if stopped before that is known. If there is none,
/// this is quicker than [`solve`], which also finds out why.
///
/// # Errors
/// [`Fault`] when the problem is not well-formed.
pub fn feasible(problem: &Problem, cancel: Cancel<'_>) -> Result<Option<bool>, Fault> {
    Ok(feasible_within(problem, Effort::Any, cancel)?.0)
}

/// For each device, the first device with the same choices. The two are interchangeable.
///
/// # Errors
/// [`Fault`] when the problem is not well-formed.
pub fn alike(problem: &Problem) -> Result<Vec<usize>, Fault> {
    Ok(Model::new(problem)?.class.iter().map(|device| device.index()).collect())
}

/// Like [`feasible`], and the work that it took; also `None` if the effort was too little to know.
pub(crate) fn feasible_within(
    problem: &Problem,
    effort: Effort,
    cancel: Cancel<'_>,
) -> Result<(Option<bool>, u64), Fault> {
    if cancel.is_over() {
        return Ok((None, 0));
    }
    let model = Model::new(problem)?;
    let Ok(mut engine) = Engine::new(problem, &model, cancel) else { return Ok((Some(false), 0)) };
    engine.progress.effort = effort;
    engine.board_symmetry = true;
    let found = engine.search(u64::MAX, true).is_some();
    Ok(((!engine.progress.stopped).then_some(found), engine.progress.work))
}

/// Turns choices into an answer and checks it.
pub(crate) fn finish(
    problem: &Problem,
    model: &Model,
    choices: &Choices,
    optimality: Optimality,
) -> Result<Answer, Fault> {
    let choice = model.choices(choices);
    let users: BTreeSet<DmaUserId> = problem
        .devices
        .iter()
        .zip(&choice)
        .filter_map(|(device, choice)| device.alternatives.get(choice.alternative))
        .flat_map(|alternative| alternative.dma.iter().copied())
        .collect();
    let answer = Answer {
        choices: choice,
        dma: matching::assign(problem, &users).unwrap_or_default(),
        objective: model.weights.unpack(model.evaluate(choices)),
        optimality,
    };
    check(problem, &answer).map_err(Fault::Rejected)?;
    Ok(answer)
}
