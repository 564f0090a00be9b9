//! Checks that the record of a search proves what it claims.
//!
//! The record states how the search split the problem, and by which multipliers it narrowed or
//! closed each case; this module walks through it and recomputes every step in integers:
//! 1. `statement` numbers the problem;
//! 2. `claims` checks what the record says besides its steps: facilities, covers, swaps of boards;
//! 3. `state` keeps what is left in a case, and removes choices that exclude each other;
//! 4. `price` computes from multipliers the least weight of everything that is left.
//!
//! Two things are kept for each case: what was *decided* on the way to it, and what is *left* after
//! everything that cannot be in a wiring below the limit was removed as well. If either stays as it
//! is when devices or boards change places, then from any wiring of the case below the limit we get
//! another one by this exchange, and so by several such exchanges in turn. So if there is none
//! where one of them takes a choice, there is none where the other one does, and the choice is
//! refused to both.
#![expect(clippy::indexing_slicing, reason = "places are checked where they are read")]

mod claims;
mod price;
mod state;
mod statement;

use crate::budget::Budget;
use crate::format::{Cover, Facility, Objective, Problem, Question, Row, Search, Step};
use crate::verdict::{Refuted, ensure};
use claims::{Facilities, Swap, below, way_of};
use price::{Market, Weights};
use state::State;
use statement::{Asked, Statement};
use std::collections::BTreeSet;

/// The cost of examining a choice that may be removed, in units of examining one that may not.
const NARROWING: usize = 8;

/// A case that waits for its question to be refused.
struct Waiting {
    decided: usize,
    left: usize,
    refused: BTreeSet<Asked>,
}

struct Walk<'s> {
    market: Market<'s>,
    swaps: Vec<Swap>,
    /// The choices decided on the way to the case.
    decided: State,
    /// The choices left in the case.
    left: State,
    waiting: Vec<Waiting>,
}

/// Checks that no wiring is better than the claim, or that there is none.
pub(crate) fn check(
    problem: &Problem,
    search: &Search,
    claim: Option<Objective>,
    budget: &mut Budget,
) -> Result<(), Refuted> {
    let statement = Statement::new(problem);
    budget.work(cost(problem, search))?;
    let facilities = Facilities::new(&statement, search)?;
    let mut weights = weights(&statement, search.weights, claim)?;
    if claim.is_none() {
        weights.limit = Market::new(&statement, &facilities, weights).most();
    }
    budget.work(statement.wires.len().saturating_mul(1 + search.swaps.len()))?;
    let swaps = search.swaps.iter().map(|swap| Swap::new(&statement, swap));
    let swaps = swaps.collect::<Result<Vec<Swap>, Refuted>>()?;
    let number = facilities.all.len();
    let mut walk = Walk {
        market: Market::new(&statement, &facilities, weights),
        swaps,
        decided: State::new(&statement, number),
        left: State::new(&statement, number),
        waiting: Vec::new(),
    };
    for (at, step) in search.steps.iter().enumerate() {
        let closed = walk.step(at, step, budget)?;
        if closed && !walk.refuse() {
            let last = at + 1 == search.steps.len();
            return ensure(last, || "the search goes on after its end".into());
        }
    }
    Err(Refuted("the search leaves out cases".into()))
}

/// The most time that it can take to check what a record says besides its steps.
fn cost(problem: &Problem, search: &Search) -> usize {
    let ways: usize = problem.devices.values().map(|device| device.len()).sum();
    let facility = |one: &Facility| one.members.len() * (1 + one.users.len() + one.wires.len());
    let all: usize = search.facilities.iter().map(facility).sum();
    let users = problem.dma.len().saturating_mul(search.facilities.len());
    let cover = |one: &Cover| one.devices.len() + (one.great.len() + one.small.len()) * 20;
    let covers: usize = search.covers.iter().map(cover).sum();
    let each = search.covers.len().saturating_mul(ways + all);
    all.saturating_add(users).saturating_add(covers).saturating_add(each)
}

/// The weights with the limit. A lower objective must weigh less.
fn weights(
    statement: &Statement,
    weights: [u64; 5],
    claim: Option<Objective>,
) -> Result<Weights, Refuted> {
    ensure(weights.iter().all(|weight| *weight < 1 << 60), || "a weight is too large".into())?;
    let claimed = claim.unwrap_or_default().parts().map(i128::from);
    let weights = weights.map(i128::from);
    let most_wires: usize = statement
        .devices
        .iter()
        .map(|ways| ways.clone().map(|way| statement.ways[way].roles.len()).max().unwrap_or(0))
        .sum();
    let wires = most_wires.min(statement.pins.len());
    let mut costs: Vec<u32> = statement.pins.iter().map(|pin| pin.cost).collect();
    costs.sort_unstable_by(|one, other| other.cmp(one));
    let shared = statement.pins.iter().filter(|pin| pin.shared).count().min(wires);
    let spares = statement.spare.iter().filter(|spare| **spare).count();
    let most = [
        wires as i128,
        statement.rules.len() as i128,
        shared as i128,
        costs.into_iter().take(wires).map(i128::from).sum(),
        spares as i128,
    ];
    // The most by which the later parts together can be lower than claimed, or higher.
    let mut later = 0;
    for (weight, (most, claimed)) in weights.into_iter().zip(most.into_iter().zip(claimed)).rev() {
        ensure(weight > later, || "a weight is not larger than all later ones".into())?;
        later += weight * most.max(claimed);
    }
    let [moved, rule, shared, cost, spare] = weights;
    let total: i128 = weights.into_iter().zip(claimed).map(|(weight, part)| weight * part).sum();
    Ok(Weights { moved, rule, shared, cost, spare, limit: total - 1 })
}

impl Walk<'_> {
    /// Checks one step. Returns whether it ends a case.
    fn step(&mut self, at: usize, step: &Step, budget: &mut Budget) -> Result<bool, Refuted> {
        let statement = self.market.statement;
        self.left.propagate(statement);
        budget.work(std::mem::take(&mut self.left.work) + 1)?;
        match step {
            Step::Dead => {
                budget.work(statement.ways.len() + statement.wires.len())?;
                ensure(self.is_dead(), || format!("step {at} says that nothing is left"))?;
                Ok(true)
            }
            Step::Closed(by) => {
                let (closed, work) = self.market.closes(&self.left, by)?;
                budget.work(work)?;
                let closed = closed || self.left.dead;
                ensure(closed, || format!("step {at} does not show what it has to"))?;
                Ok(true)
            }
            Step::Narrowed(by) => {
                // Everything is examined once for the prices, and again for what is too expensive.
                budget.work(NARROWING * self.market.narrow(&mut self.left, by)?)?;
                Ok(false)
            }
            Step::Split { on, swaps } => {
                let asked = self.asked(*on)?;
                let refused = self.images(at, asked, swaps, budget)?;
                let (decided, left) = (self.decided.mark(), self.left.mark());
                self.waiting.push(Waiting { decided, left, refused });
                for state in [&mut self.decided, &mut self.left] {
                    take(state, statement, asked);
                }
                Ok(false)
            }
        }
    }

    /// Goes back to the last case that waits and refuses its question; false if there is none.
    fn refuse(&mut self) -> bool {
        let Some(Waiting { decided, left, refused }) = self.waiting.pop() else { return false };
        let Market { statement, facilities, .. } = self.market;
        self.decided.undo(statement, decided);
        self.left.undo(statement, left);
        for state in [&mut self.decided, &mut self.left] {
            for asked in &refused {
                refuse(state, statement, facilities, *asked);
            }
        }
        true
    }

    /// Whether nothing is left: no choice, no member of a facility that is used, or too few streams.
    fn is_dead(&self) -> bool {
        let Market { statement, facilities, .. } = self.market;
        let unused = |(facility, open): (&claims::Facility, &bool)| {
            *open && !facility.members.iter().any(|way| self.left.way[*way])
        };
        self.left.dead
            || facilities.all.iter().zip(&self.left.open).any(unused)
            || !self.left.has_streams(statement, &facilities.private)
    }

    fn asked(&self, on: Question) -> Result<Asked, Refuted> {
        let statement = self.market.statement;
        Ok(match on {
            Question::Way(device, place) => Asked::Way(way_of(statement, device, place)?),
            Question::Wire(device, place, role, wire) => {
                let roles = &statement.ways[way_of(statement, device, place)?].roles;
                let role = roles.start + below(role, roles.len(), "role")?;
                let wires = &statement.roles[role].wires;
                Asked::Wire(wires.start + below(wire, wires.len(), "candidate")?)
            }
            Question::Kept(rule) => Asked::Kept(below(rule, statement.rules.len(), "rule")?),
            Question::Unused(board) => Asked::Unused(below(board, statement.spare.len(), "board")?),
            Question::Open(facility) => {
                Asked::Open(below(facility, self.market.facilities.all.len(), "facility")?)
            }
        })
    }

    /// Everything that is refused together: the question, and all questions into which swaps that
    /// keep the case turn it.
    fn images(
        &self,
        at: usize,
        asked: Asked,
        swaps: &Row,
        budget: &mut Budget,
    ) -> Result<BTreeSet<Asked>, Refuted> {
        let facilities = self.market.facilities;
        let mut keeping = Vec::new();
        for number in swaps {
            let swap = &self.swaps[below(*number, self.swaps.len(), "swap")?];
            budget.work(2 * swap.size())?;
            let keeps = swap.keeps(&self.decided, facilities) || swap.keeps(&self.left, facilities);
            ensure(keeps || self.left.dead, || format!("step {at} swaps what differs"))?;
            keeping.extend(keeps.then_some(swap));
        }
        let mut images = BTreeSet::from([asked]);
        let mut open = vec![asked];
        while let Some(one) = open.pop() {
            budget.work(keeping.len())?;
            let found = keeping.iter().flat_map(|swap| swap.images(one, facilities));
            open.extend(found.filter(|image| images.insert(*image)));
        }
        Ok(images)
    }
}

fn take(state: &mut State, statement: &Statement, asked: Asked) {
    match asked {
        Asked::Way(way) | Asked::Member(way) => {
            if !state.way[way] {
                state.die();
            }
            state.keep_way(statement, way);
        }
        Asked::Wire(wire) => {
            if !state.wire[wire] || !state.way[statement.wires[wire].way] {
                state.die();
            }
            state.keep_wire(statement, wire);
        }
        Asked::Kept(rule) => state.close_rule(statement, rule),
        Asked::Unused(board) => state.close_board(statement, board),
        Asked::Open(facility) => state.open(facility),
    }
}

fn refuse(state: &mut State, statement: &Statement, facilities: &Facilities, asked: Asked) {
    match asked {
        Asked::Way(way) | Asked::Member(way) => state.remove_way(statement, way),
        Asked::Wire(wire) => state.remove_wire(statement, wire),
        Asked::Kept(rule) => state.pay_rule(rule),
        Asked::Unused(board) => state.use_board(board),
        Asked::Open(facility) => {
            let members = &facilities.all[facility].members;
            members.iter().for_each(|way| state.remove_way(statement, *way));
        }
    }
}
