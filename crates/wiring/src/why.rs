//! Why this pin and not that one: the cost of each alternative for one device.

use sensedsl_model::design::{ConnectionIndex, Design};
use sensedsl_model::kind::Role;
use sensedsl_solve::problem::{Problem, Role as SolverRole};
use sensedsl_solve::{Cancel, Objective, Options, Outcome, solve};

use crate::answers::Found;
use crate::assignment::Assignment;
use crate::formulate::{Formulation, Requester};
use crate::read_back::roles;

/// The cost of one pin for one wire of a device.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Alternative {
    /// The wire: `in`, `in[3]`, `pwm`.
    pub wire: String,
    /// The board's name.
    pub board: String,
    /// The pin.
    pub pin: String,
    /// The signal as the table spells it.
    pub signal: String,
    /// Number of usages of the pin.
    pub usages: u32,
    /// The other thing that is on it, if any.
    pub shared_with: Option<String>,
    /// The best that is possible with this wire; `None` if nothing is.
    pub best: Option<Objective>,
    /// True for the pin of the wiring.
    pub chosen: bool,
}

/// All pins that could serve the connections, by role, with the cost of the best wiring with each.
pub(crate) fn why(
    design: &Design,
    formulation: &Formulation<'_>,
    (wiring, connections): (&Assignment, &[ConnectionIndex]),
    cancel: Cancel<'_>,
) -> Found<Alternative> {
    let mut all = Vec::new();
    for connection in connections {
        if !of_connection(design, formulation, (wiring, *connection), cancel, &mut all) {
            return Found { all, complete: false };
        }
    }
    Found { all, complete: formulation.complete }
}

/// Adds the alternatives of one connection; false if time ran out.
fn of_connection(
    design: &Design,
    formulation: &Formulation<'_>,
    (wiring, connection): (&Assignment, ConnectionIndex),
    cancel: Cancel<'_>,
    all: &mut Vec<Alternative>,
) -> bool {
    let asker = Requester::Connection(connection);
    let number = formulation.askers.iter().position(|one| *one == asker);
    let (Some(number), Some(wires)) = (number, design.connection(connection)) else { return true };
    for (at, role) in roles(design, asker).into_iter().enumerate() {
        for (board, pin, usage) in places(formulation, number, at) {
            let Some(offer) = formulation.offers.get(board) else { continue };
            let Some(row) = offer.board.table.pins.get(pin) else { continue };
            let signal = usage.and_then(|usage| row.usages.get(usage));
            let problem = restricted(formulation, number, at, (board, pin, usage));
            let best = best(&problem, cancel);
            if cancel.is_over() {
                return false;
            }
            all.push(Alternative {
                wire: wires.wire_name(role),
                board: offer.board.name.value.clone(),
                pin: row.name.to_string(),
                signal: signal.map_or_else(|| "GPIO".into(), |usage| usage.spelled.clone()),
                usages: row.cost(),
                shared_with: offer.shared_with(pin).map(str::to_owned),
                best,
                chosen: is_chosen(wiring, connection, role, (board, pin, usage)),
            });
        }
    }
    true
}

/// A wire: board, pin and usage by their indices.
type Place = (usize, usize, Option<usize>);

/// The places that some alternative of the device has for a role, in tie-break order.
fn places(formulation: &Formulation<'_>, device: usize, role: usize) -> Vec<Place> {
    let meanings = formulation.meanings.get(device).into_iter().flatten();
    let mut places: Vec<Place> = meanings
        .flat_map(|meaning| {
            let chosen = meaning.roles.get(role).into_iter().flatten();
            chosen.map(|chosen| (meaning.board.0, chosen.pin, chosen.usage))
        })
        .collect();
    places.sort_unstable();
    places.dedup();
    places
}

/// The problem in which one role of one device has a single place.
fn restricted(formulation: &Formulation<'_>, device: usize, role: usize, place: Place) -> Problem {
    let mut problem = formulation.problem.clone();
    let meanings = formulation.meanings.get(device).into_iter().flatten();
    let Some(target) = problem.devices.get_mut(device) else { return problem };
    let alternatives = std::mem::take(&mut target.alternatives);
    for (mut alternative, meaning) in alternatives.into_iter().zip(meanings) {
        let chosen = meaning.roles.get(role).into_iter().flatten();
        let here: Vec<bool> =
            chosen.map(|chosen| (meaning.board.0, chosen.pin, chosen.usage) == place).collect();
        if let Some(SolverRole { candidates }) = alternative.roles.get_mut(role) {
            let mut keep = here.iter();
            candidates.retain(|_| keep.next().copied().unwrap_or(false));
            if !candidates.is_empty() {
                target.alternatives.push(alternative);
            }
        }
    }
    problem
}

fn best(problem: &Problem, cancel: Cancel<'_>) -> Option<Objective> {
    match solve(problem, &Options { any: false, cancel }) {
        Ok(Outcome::Solved(answer)) => Some(answer.objective),
        Ok(Outcome::Infeasible(_) | Outcome::Stopped { .. }) | Err(_) => None,
    }
}

fn is_chosen(
    wiring: &Assignment,
    connection: ConnectionIndex,
    role: Role,
    (board, pin, usage): Place,
) -> bool {
    wiring.connection(connection).is_some_and(|(on, one)| {
        let wire = one.wires.iter().find(|wire| wire.role == role);
        on.0 == board && wire.is_some_and(|wire| wire.pin == pin && wire.usage == usage)
    })
}
