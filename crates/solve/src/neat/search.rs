//! Branch and bound over the areas of parts: a wiring in, a neater one of the same objective out.
//!
//! A node gives one more part an area and asks the solver for a wiring in what is left. Whatever
//! comes is a wiring, so the search can be ended anywhere. A node is cut off once the areas that
//! the parts have, and the neatest that each other part may still have, are together no neater than
//! the best wiring so far. If nothing else is cut off, the best wiring is proved to be the neatest.
//!
//! The sides are counted first, with whole sides as areas: there are few. Then come the spans.

use super::areas::{Areas, Sides, Wanted};
use super::layout::{Layout, Neatness};
use super::live::Live;
use super::part::{Parts, used};
use super::question::Reply;
use crate::model::Choices;
use crate::search::Engine;

/// The work that finding the areas of one part is worth, about 5 ms.
const AREAS: u64 = 100_000;

/// A search with all its state.
pub(super) struct Search<'e, 'a> {
    pub(super) engine: &'e mut Engine<'a>,
    pub(super) layout: &'e Layout,
    pub(super) parts: &'e Parts,
    /// The most that a wiring may weigh.
    pub(super) limit: u64,
    /// The most spare boards that it may use.
    pub(super) spares: u32,
    pub(super) best: Choices,
    pub(super) neatness: Neatness,
    /// The search ends once the engine has done so much work.
    pub(super) until: u64,
    /// Whether nothing was cut off that might be neater.
    pub(super) is_complete: bool,
}

/// What is known of the parts at a node.
#[derive(Clone)]
pub(super) struct State {
    /// The neatness of the area that a part has been given.
    pub(super) given: Vec<Option<Neatness>>,
    /// The first area that each other part may still have.
    first: Vec<usize>,
}

/// The bound of a node.
struct Bound {
    /// The neatest that each part may be.
    least: Vec<Neatness>,
    sum: Neatness,
    live: Vec<Live>,
}

/// A search for fewer sides, or for shorter spans.
pub(super) struct Phase {
    /// The areas of each part.
    areas: Vec<Areas>,
    /// Whether only sides count.
    pub(super) whole: bool,
}

impl Search<'_, '_> {
    /// Searches for the least sides, then for the least span with them.
    pub(super) fn run(&mut self) {
        let all = self.until;
        for whole in [true, false] {
            let phase = Phase { areas: self.areas(whole), whole };
            self.until = self.engine.progress.work + (all - self.engine.progress.work.min(all)) / 2;
            self.improve(&phase);
            self.until = all;
            let phase = Phase { areas: self.areas(whole), whole };
            let known = self.best.clone();
            self.node(&phase, self.nothing_given(), &known);
        }
    }

    pub(super) fn nothing_given(&self) -> State {
        let number = self.parts.open.len();
        State { given: vec![None; number], first: vec![0; number] }
    }

    /// The areas of each part, as far as a neater wiring could be in them.
    fn areas(&mut self, whole: bool) -> Vec<Areas> {
        let parts = &self.parts.open;
        let sides: Vec<Sides<'_>> =
            parts.iter().map(|part| Sides::new(self.layout, &part.live)).collect();
        let all = Neatness { sides: u32::MAX, span: 0 };
        let mut areas = |one: &Sides<'_>, below: Neatness, only_one: bool| {
            let mut left = AREAS;
            let areas = one.areas(Wanted { below, one: only_one, whole }, &mut left);
            self.engine.progress.work += AREAS - left;
            areas
        };
        let least: Vec<Neatness> = sides
            .iter()
            .map(|one| {
                let first = areas(one, all, true);
                first.all.first().map_or(first.rest, |area| area.neatness)
            })
            .collect();
        let sum = least.iter().fold(self.parts.settled, |sum, one| sum + *one);
        let goal = goal(self.neatness, whole);
        let below = least.iter().map(|one| goal - (sum - *one));
        sides.iter().zip(below).map(|(one, below)| areas(one, below, false)).collect()
    }

    pub(super) fn is_over(&mut self) -> bool {
        let is_over = self.engine.progress.work >= self.until || self.engine.cancel.is_over();
        self.is_complete &= !is_over;
        is_over
    }

    pub(super) fn node(&mut self, phase: &Phase, mut state: State, known: &Choices) {
        self.engine.progress.step();
        let bound = self.bound(phase, &mut state);
        if bound.sum >= goal(self.neatness, phase.whole) || self.is_over() {
            return;
        }
        let asked;
        let witness = if self.engine.allows(known) {
            known
        } else {
            match self.engine.wiring_within(self.limit, known) {
                Reply::Yes(choices) => {
                    asked = choices;
                    &asked
                }
                Reply::No => return,
                Reply::Unknown => {
                    self.is_complete = false;
                    return;
                }
            }
        };
        self.offer(witness);
        if bound.sum < goal(self.neatness, phase.whole) {
            self.branch(phase, &state, &bound, witness);
        }
    }

    /// The bound of this node.
    fn bound(&mut self, phase: &Phase, state: &mut State) -> Bound {
        let mut bound = Bound { least: Vec::new(), sum: self.parts.settled, live: Vec::new() };
        let parts = self.parts.open.iter().zip(&phase.areas);
        for (((part, areas), given), first) in parts.zip(&state.given).zip(&mut state.first) {
            let (least, live) = if let Some(given) = given {
                (*given, Live::default())
            } else {
                let engine = &mut *self.engine;
                let live = Live::new(engine.model, &engine.domains, &part.devices);
                engine.progress.work += live.made;
                while areas.all.get(*first).is_some_and(|area| !live.fits(&area.pins)) {
                    *first += 1;
                    engine.progress.work += live.work();
                }
                (areas.all.get(*first).map_or(areas.rest, |area| area.neatness), live)
            };
            bound.sum += least;
            bound.least.push(least);
            bound.live.push(live);
        }
        bound
    }

    /// Keeps a wiring that is neater than the best.
    pub(super) fn offer(&mut self, choices: &Choices) {
        let model = self.engine.model;
        let neatness = self.parts.neatness(model, self.layout, choices);
        let spares = model.weights.unpack(model.evaluate(choices)).spares;
        if neatness < self.neatness && spares <= self.spares {
            self.neatness = neatness;
            self.best.clone_from(choices);
        }
    }

    /// Gives the part that could gain most one area after the other.
    fn branch(&mut self, phase: &Phase, state: &State, bound: &Bound, witness: &Choices) {
        let model = self.engine.model;
        let gain = |number: &usize| {
            let (part, least) = (self.parts.open.get(*number)?, bound.least.get(*number)?);
            Some(used(model, self.layout, witness, &part.devices).neatness - *least)
        };
        let open = state.given.iter().enumerate().filter(|(_, given)| given.is_none());
        let open = open.map(|(number, _)| number).rev();
        let Some(number) = open.max_by_key(gain) else {
            // All have an area, but the wiring in them does not count.
            self.is_complete = false;
            return;
        };
        let (Some(part), Some(areas), Some(least), Some(live), Some(first)) = (
            self.parts.open.get(number),
            phase.areas.get(number),
            bound.least.get(number),
            bound.live.get(number),
            state.first.get(number),
        ) else {
            return;
        };
        let others = bound.sum - *least;
        for area in areas.all.iter().skip(*first) {
            if others + area.neatness >= goal(self.neatness, phase.whole) || self.is_over() {
                return;
            }
            self.engine.progress.work += live.work();
            if !live.fits(&area.pins) {
                continue;
            }
            let saved = self.engine.flow.save();
            let mark = self.engine.domains.mark();
            if self.engine.leave_pins(&part.devices, &area.pins, self.limit).is_ok() {
                let mut below = state.clone();
                if let Some(given) = below.given.get_mut(number) {
                    *given = Some(area.neatness);
                }
                self.node(phase, below, witness);
            }
            self.engine.back(mark, &saved);
        }
        self.is_complete &= others + areas.rest >= goal(self.neatness, phase.whole);
    }
}

/// What a wiring must be neater than.
pub(super) fn goal(best: Neatness, whole: bool) -> Neatness {
    Neatness { span: if whole { 0 } else { best.span }, ..best }
}
