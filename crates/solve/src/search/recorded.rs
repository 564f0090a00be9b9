//! The search with a record: a limit that is known to hold in, the splits and multipliers that
//! prove it out.
//!
//! With the best weight as its limit, the search has no answers to find. Only the parts of a node
//! that prove something are left: propagation, the prices that close or narrow it, and the split.
//! The flow only suggests what to split on; whatever it would prune, the prices prune too.

use super::branch::Branch;
use super::{Engine, LP_STEPS};
use crate::answer::Fault;
use crate::bounds::dualized::Dualized;
use crate::bounds::lagrangian::Lagrangian;
use crate::cancel::Cancel;
use crate::domains::Pruned;
use crate::index::{AltId, FacilityId, Id};
use crate::model::bundles::Bundle;
use crate::model::{Holding, Model};
use crate::problem::{BoardId, DeviceId, Problem};
use crate::questions::solve::Experience;
use crate::trace::{Cover, Exchange, Facility, Multipliers, Question, Record, Step, Way};

/// The most steps of a record; nobody would verify a longer one.
const STEPS_MAX: usize = 20_000;

/// A record that cannot be completed.
struct Incomplete;

/// Records why no answer weighs less than the best one, `best`, or that there is none. Equal boards
/// may replace each other if `boards` is true. `learned` comes from the search that found the
/// answer, or is empty; it makes the record faster to find.
///
/// # Errors
/// [`Fault`] when the problem is not well-formed. There is no record if the search was stopped, or
/// needed something that a record cannot hold.
pub fn record(
    problem: &Problem,
    best: Option<crate::Objective>,
    boards: bool,
    learned: &Experience,
    cancel: Cancel<'_>,
) -> Result<Option<Record>, Fault> {
    let model = Model::new(problem)?;
    let weights = model.weights;
    let limit = best.map_or(model.most, |o| {
        u64::from(o.moved) * weights.moved
            + u64::from(o.violated) * weights.rule
            + u64::from(o.shared) * weights.shared
            + u64::from(o.cost) * weights.cost
            + u64::from(o.spares)
    });
    let mut record = Record {
        weights: [weights.moved, weights.rule, weights.shared, weights.cost, 1],
        ..Record::default()
    };
    if limit == 0 {
        record.steps.push(Step::Closed(Multipliers::default()));
        return Ok(Some(record));
    }
    let Ok(mut engine) = Engine::new(problem, &model, cancel) else {
        record.steps.push(Step::Dead);
        return Ok(Some(record));
    };
    engine.board_symmetry = boards;
    engine.learned = learned.0.clone();
    engine.goal.limit = limit;
    let done = engine.recorded(&mut record.steps);
    if let Some(pricing) = &engine.pricing {
        record.facilities = facilities(&pricing.dualized, &model);
        record.covers =
            pricing.dualized.covers.iter().map(crate::bounds::dualized::Cover::stated).collect();
    }
    Ok(done.is_ok().then_some(record))
}

/// For each board, the first board that is equal to it.
///
/// # Errors
/// [`Fault`] when the problem is not well-formed.
pub fn equal_boards(problem: &Problem) -> Result<Vec<usize>, Fault> {
    Ok(Model::new(problem)?.boards.first_equal.iter().map(|board| board.index()).collect())
}

/// The alternative as the problem identifies it.
fn way(model: &Model, alt: AltId) -> Way {
    (model.alt_device[alt], model.alt_position(alt))
}

fn facilities(dualized: &Dualized, model: &Model) -> Vec<Facility> {
    let stated = |(id, facility): (FacilityId, &crate::bounds::dualized::Facility)| Facility {
        members: facility.alts.iter().map(|alt| way(model, *alt)).collect(),
        resource: facility.resource.map(|price| dualized.resource_of(price)),
        wires: facility
            .wires
            .iter()
            .map(|wire| {
                let position = |alt: &AltId| {
                    let roles = model.roles.of(*alt);
                    roles.iter().position(|role| model.holding[role] == Holding::Wire(*wire))
                };
                facility.alts.iter().filter_map(position).collect()
            })
            .collect(),
        users: facility.users.clone(),
        slots: dualized.slots(model, id),
    };
    dualized.facilities.enumerate().map(stated).collect()
}

impl crate::bounds::dualized::Cover {
    fn stated(&self) -> Cover {
        let places = |ids: &[FacilityId]| ids.iter().map(|id| id.index()).collect();
        Cover {
            devices: self.devices.clone(),
            great: places(&self.members),
            small: places(&self.small),
            need: self.need,
        }
    }
}

impl Engine<'_> {
    /// Searches below the current domains, with a record; leaves them smaller.
    fn recorded(&mut self, steps: &mut Vec<Step>) -> Result<(), Incomplete> {
        loop {
            self.progress.step();
            if self.is_stopped() || steps.len() > STEPS_MAX {
                return Err(Incomplete);
            }
            if self.domains.propagate(self.model).is_err() || !self.streams_may_suffice() {
                steps.push(Step::Dead);
                return Ok(());
            }
            match self.price_recorded() {
                Recorded::Step(step) => {
                    steps.push(step);
                    return Ok(());
                }
                Recorded::Narrowed(by, Ok(true)) => {
                    steps.push(Step::Narrowed(by));
                    continue;
                }
                Recorded::Narrowed(by, Err(Pruned)) => {
                    steps.push(Step::Narrowed(by));
                    steps.push(Step::Dead);
                    return Ok(());
                }
                Recorded::Narrowed(_, Ok(false)) => {}
            }
            let branch = self.split().ok_or(Incomplete)?;
            steps.push(self.stated(branch));
            let mark = self.domains.mark();
            let saved = self.flow.save();
            if self.take(branch).is_ok() {
                self.recorded(steps)?;
            } else {
                steps.push(Step::Dead);
            }
            self.back(mark, &saved);
            if self.refuse(branch).is_err() {
                steps.push(Step::Dead);
                return Ok(());
            }
        }
    }

    fn price_recorded(&mut self) -> Recorded {
        let pruned = self.bound_by_prices(LP_STEPS).is_err();
        let (model, limit) = (self.model, self.goal.limit);
        let Some(pricing) = &mut self.pricing else { return Recorded::Step(Step::Dead) };
        let dualized = &pricing.dualized;
        if pruned {
            let domains = &self.domains;
            let unused = |f: &FacilityId| {
                dualized.facilities[*f].alts.iter().all(|&alt| !domains.has_alt(alt))
            };
            if domains.opened.iter().any(unused) {
                return Recorded::Step(Step::Dead);
            }
            if Lagrangian::most(dualized, model, domains, limit).is_none() {
                let shift = dualized.shift;
                return Recorded::Step(Step::Closed(Multipliers {
                    shift,
                    ..Multipliers::default()
                }));
            }
        }
        let by = pricing.lagrangian.multipliers(dualized, model, limit);
        if pruned {
            return Recorded::Step(Step::Closed(by));
        }
        let narrowed = pricing.lagrangian.fix(dualized, model, &mut self.domains, limit);
        Recorded::Narrowed(by, narrowed)
    }

    /// What to split on: a variable that the program leaves fractional, else what the flow
    /// suggests, else any open choice.
    fn split(&mut self) -> Option<Branch> {
        if let Some(board) = self.deciding_board() {
            return Some(board);
        }
        if let Some(branch) = self.strongest_recorded() {
            return Some(branch);
        }
        if self.flow.refresh(self.model, &self.domains).is_ok() {
            let advice = match self.read() {
                Ok(choices) => self.unpaid_charge(&choices),
                Err(branch) => branch,
            };
            return advice.or_else(|| self.any_branch());
        }
        self.any_branch()
    }

    /// The exchanges that put the twins of a device in its place.
    fn exchanges(&self, device: DeviceId) -> Vec<Exchange> {
        let alike = self.alike(device).into_iter().filter(|twin| *twin != device);
        let mut all: Vec<Exchange> = alike.map(|twin| vec![(device, twin)]).collect();
        all.extend(self.bundle_exchanges(device));
        all
    }

    /// The exchanges that put equal bundles in the place of the one that a facility belongs to.
    fn facility_exchanges(&self, facility: FacilityId) -> Vec<Exchange> {
        let Some(pricing) = &self.pricing else { return Vec::new() };
        let alts = &pricing.dualized.facilities[facility].alts;
        let of_one_board = self.boards_of(Branch::Facility(facility)).len() == 1;
        match alts.first() {
            Some(first) if of_one_board && !self.equal_facilities(alts).is_empty() => {
                self.bundle_exchanges(self.model.alt_device[*first])
            }
            _ => Vec::new(),
        }
    }

    fn bundle_exchanges(&self, device: DeviceId) -> Vec<Exchange> {
        let bundles = &self.model.bundles;
        let own = bundles.place(device).and_then(|at| bundles.family(at).get(at.bundle));
        let Some(own) = own else { return Vec::new() };
        let pairs = |other: &Bundle| {
            own.devices.iter().copied().zip(other.devices.iter().copied()).collect()
        };
        self.equal_bundles(device).into_iter().map(pairs).collect()
    }

    fn stated(&self, branch: Branch) -> Step {
        let model = self.model;
        let (on, twins) = match branch {
            Branch::Alt(alt) => {
                let (device, place) = way(model, alt);
                (Question::Way(device, place), self.exchanges(device))
            }
            Branch::Cand(id) => {
                let alt = model.cand_alt(id);
                let (device, place) = way(model, alt);
                let role = model.cand[id].role;
                let at = model.cands.of(role).position(id);
                let role = model.roles.of(alt).position(role);
                (Question::Wire(device, place, role, at), self.exchanges(device))
            }
            Branch::Rule(rule) => (Question::Kept(rule), Vec::new()),
            Branch::Board(board) => (Question::Unused(board), Vec::new()),
            Branch::Facility(facility) => {
                (Question::Open(facility.index()), self.facility_exchanges(facility))
            }
        };
        let own = self.boards_of(branch);
        let boards: Vec<BoardId> = match own.as_slice() {
            [own] => self.equals(branch).filter(|board| board != own).collect(),
            _ => Vec::new(),
        };
        Step::Split { on, twins, boards }
    }
}

/// The effect of the prices at a node.
enum Recorded {
    /// They ended it with this step.
    Step(Step),
    /// The multipliers, and whether they narrowed the domains.
    Narrowed(Multipliers, Result<bool, Pruned>),
}
