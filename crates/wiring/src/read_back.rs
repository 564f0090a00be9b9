//! From the solver's answer to names: wires, peripheral instances, DMA streams.

use std::collections::{BTreeMap, BTreeSet};

use sensedsl_board::table::Pin;
use sensedsl_model::design::{Board, BoardIndex, ConnectionIndex, Design, DeviceIndex};
use sensedsl_model::kind::Role;
use sensedsl_solve::{Answer, Optimality};

use crate::assignment::{
    Assignment, BoardAssignment, ConnectionWiring, DeviceWiring, DmaAssignment, LinkWiring,
    Neatness, SharedPin, Status, Wire,
};
use crate::builder::{Chosen, Converters, Meaning};
use crate::converters::{self, Choice};
use crate::formulate::{Formulation, Requester};
use crate::layout;
use crate::streams;

/// The answer in names. `None` if a board's DMA requests, including those of its converters, cannot
/// all be served; the solver has made sure of all others.
pub(crate) fn read_back(
    design: &Design,
    formulation: &Formulation<'_>,
    answer: &Answer,
) -> Option<Assignment> {
    let mut boards: Vec<BoardAssignment> =
        (0..design.boards.len()).map(|index| BoardAssignment::empty(BoardIndex(index))).collect();
    let used = formulation.layout.used(&formulation.problem, answer);
    let choices = formulation.askers.iter().zip(&formulation.meanings).zip(&answer.choices);
    for (((asker, meanings), choice), part) in choices.zip(&formulation.layout.parts) {
        let Some(meaning) = meanings.get(choice.alternative) else { continue };
        let Some(board) = boards.get_mut(meaning.board.0) else { continue };
        let mut wires = wires(design, *asker, meaning, &choice.candidates);
        if let (Some(used), Some(on)) = (used.get(part), design.board(meaning.board)) {
            let pin = |pin| formulation.pin(meaning.board, pin);
            layout::name_places(on, &used.contacts, pin, &mut wires);
        }
        match asker {
            Requester::Connection(connection) => {
                let connection = *connection;
                // The converter is finally chosen by `converters`.
                let unit = meaning.unit.clone().filter(|_| !is_analog(design, connection));
                board.connections.push(ConnectionWiring { connection, unit, wires });
            }
            Requester::Link(_) => {
                let unit = meaning.unit.clone().unwrap_or_default();
                board.link = Some(LinkWiring { unit, wires });
            }
        }
    }
    for assignment in &mut boards {
        let Some(board) = design.board(assignment.board) else { continue };
        name_channels(design, board, &mut assignment.connections);
        assignment.dma = name_converters(design, board, assignment, formulation.converters)?;
        assignment.devices = devices(design, &assignment.connections);
        let pins = pins(assignment);
        let cost = pins.iter().filter_map(|pin| board.table.pins.get(*pin)).map(Pin::cost);
        assignment.cost = cost.sum();
        let offer = formulation.offers.get(assignment.board.0);
        let shared = pins.iter().filter_map(|pin| {
            let with = offer?.shared_with(*pin)?.to_owned();
            Some(SharedPin { pin: *pin, with })
        });
        assignment.shared = shared.collect();
    }
    Some(Assignment {
        status: match answer.optimality {
            Optimality::Proved => Status::Optimal,
            Optimality::Feasible => Status::Feasible,
        },
        moved: answer.objective.moved,
        violated: answer.objective.violated,
        shared: answer.objective.shared,
        cost: answer.objective.cost,
        bound: None,
        neatness: Neatness::default(),
        boards,
    })
}

/// The wires of an asker, whose places are not known yet.
fn wires(design: &Design, asker: Requester, meaning: &Meaning, candidates: &[usize]) -> Vec<Wire> {
    let connection = match asker {
        Requester::Connection(connection) => Some(connection),
        Requester::Link(_) => None,
    };
    let chosen = meaning.roles.iter().zip(candidates);
    let chosen = chosen.filter_map(|(role, candidate)| role.get(*candidate));
    let wire = |(role, at): (Role, &Chosen)| Wire {
        connection,
        role,
        pin: at.pin,
        usage: at.usage,
        place: None,
    };
    roles(design, asker).into_iter().zip(chosen).map(wire).collect()
}

/// The roles of an asker, in order.
pub(crate) fn roles(design: &Design, asker: Requester) -> Vec<Role> {
    match asker {
        Requester::Connection(connection) => design
            .connection(connection)
            .map(|one| one.kind.roles(one.direction))
            .unwrap_or_default(),
        Requester::Link(_) => vec![Role::Tx, Role::Rx],
    }
}

/// Fills in the instances of single channels: timers of the pure model, outputs of a converter.
fn name_channels(design: &Design, board: &Board, wirings: &mut [ConnectionWiring]) {
    for wiring in wirings.iter_mut().filter(|wiring| wiring.unit.is_none()) {
        if !is_analog(design, wiring.connection) {
            let signal = wiring.wires.first().and_then(|wire| wire.usage(board));
            let units = signal.map(|usage| usage.signal.function().units()).unwrap_or_default();
            wiring.unit = units.first().map(ToString::to_string);
        }
    }
}

/// Fills in the converters, and assigns streams to everything that is in use. `None` if no choice
/// of converters leaves each its stream.
fn name_converters(
    design: &Design,
    board: &Board,
    assignment: &mut BoardAssignment,
    when: Converters,
) -> Option<Vec<DmaAssignment>> {
    let others = assignment.connections.iter().filter_map(|wiring| wiring.unit.as_deref());
    let others: Vec<&str> = others.collect();
    let served = |choice: &Choice| {
        let all = others.iter().copied().chain(choice.values().map(String::as_str));
        streams::serve(board, all.collect())
    };
    let suffice = |choice: &Choice| served(choice).is_some();
    let choice = converters::choose(design, board, &assignment.connections, when, suffice)?;
    let dma = served(&choice);
    for wiring in &mut assignment.connections {
        if is_analog(design, wiring.connection) {
            wiring.unit = choice.get(&wiring.connection).cloned();
        }
    }
    dma
}

fn is_analog(design: &Design, connection: ConnectionIndex) -> bool {
    design.connection(connection).is_some_and(|one| one.kind.is_sampled())
}

/// The devices whose values go over the connections of a board, with their wires.
fn devices(design: &Design, connections: &[ConnectionWiring]) -> Vec<DeviceWiring> {
    let find = |index: ConnectionIndex| {
        let at = connections.binary_search_by_key(&index, |one| one.connection).ok()?;
        connections.get(at)
    };
    // Connections that no value goes over are shown with the first device of their part.
    let used: BTreeSet<ConnectionIndex> =
        design.devices.iter().flat_map(|device| device.connections.iter().copied()).collect();
    let mut unused: BTreeMap<DeviceIndex, Vec<&Wire>> = BTreeMap::new();
    for one in connections.iter().filter(|one| !used.contains(&one.connection)) {
        let Some(connection) = design.connection(one.connection) else { continue };
        unused.entry(connection.device).or_default().extend(&one.wires);
    }
    let mut devices = Vec::new();
    for (index, device) in (0..).map(DeviceIndex).zip(&design.devices) {
        let of: Vec<_> = device.connections.iter().filter_map(|one| find(*one)).collect();
        let Some(main) = of.first() else { continue };
        let own = of.iter().flat_map(|one| &one.wires);
        let others = unused.remove(&index).unwrap_or_default();
        let wires = own.chain(others).copied().collect();
        devices.push(DeviceWiring { device: index, unit: main.unit.clone(), wires });
    }
    devices
}

/// The pins that the board's devices and its link use, each once, ascending.
fn pins(assignment: &BoardAssignment) -> Vec<usize> {
    let of_devices = assignment.connections.iter().flat_map(|wiring| &wiring.wires);
    let of_link = assignment.link.iter().flat_map(|link| &link.wires);
    let mut pins: Vec<usize> = of_devices.chain(of_link).map(|wire| wire.pin).collect();
    pins.sort_unstable();
    pins.dedup();
    pins
}
