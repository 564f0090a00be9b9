//! From the solver's answer to names: wires, peripheral instances, DMA streams.

use std::collections::BTreeMap;

use sensedsl_board::table::Pin;
use sensedsl_model::design::{Board, BoardIndex, Design, DeviceIndex};
use sensedsl_model::kind::{Kind, Role};
use sensedsl_solve::{Answer, Optimality};

use crate::assignment::{Assignment, BoardAssignment, DeviceWiring, LinkWiring, Status, Wire};
use crate::converters;
use crate::formulate::{Asker, Formulation};
use crate::streams;

/// The answer in names. None when a board's DMA requests, those of its converters included, cannot
/// all be served; the solver has made sure of all others.
pub(crate) fn read_back(
    design: &Design,
    formulation: &Formulation<'_>,
    answer: &Answer,
) -> Option<Assignment> {
    let mut boards: Vec<BoardAssignment> = (0..design.boards.len())
        .map(|index| BoardAssignment {
            board: BoardIndex(index),
            cost: 0,
            devices: Vec::new(),
            link: None,
            dma: Vec::new(),
        })
        .collect();
    let choices = formulation.askers.iter().zip(&formulation.meanings).zip(&answer.choices);
    for ((asker, meanings), choice) in choices {
        let Some(meaning) = meanings.get(choice.alternative) else { continue };
        let Some(board) = boards.get_mut(meaning.board.0) else { continue };
        let chosen = meaning.roles.iter().zip(&choice.candidates);
        let chosen = chosen.filter_map(|(role, candidate)| role.get(*candidate));
        let wires = roles(design, *asker).into_iter().zip(chosen);
        let wires = wires.map(|(role, at)| Wire { role, pin: at.pin, usage: at.usage }).collect();
        match asker {
            Asker::Device(device) => {
                let unit = meaning.unit.clone();
                board.devices.push(DeviceWiring { device: *device, unit, wires });
            }
            Asker::Link(_) => {
                let unit = meaning.unit.clone().unwrap_or_default();
                board.link = Some(LinkWiring { unit, wires });
            }
        }
    }
    for assignment in &mut boards {
        let Some(board) = design.board(assignment.board) else { continue };
        name_units(design, board, &mut assignment.devices);
        assignment.cost = cost(board, assignment);
        assignment.dma = streams::serve(board, assignment)?;
    }
    Some(Assignment {
        status: match answer.optimality {
            Optimality::Proved => Status::Optimal,
            Optimality::Feasible => Status::Feasible,
        },
        moved: answer.objective.moved,
        violated: answer.objective.violated,
        cost: answer.objective.cost,
        bound: None,
        boards,
    })
}

/// The roles of whoever asks, in order.
pub(crate) fn roles(design: &Design, asker: Asker) -> Vec<Role> {
    match asker {
        Asker::Device(device) => design
            .device(device)
            .map(|device| device.kind.roles(device.direction))
            .unwrap_or_default(),
        Asker::Link(_) => vec![Role::Tx, Role::Rx],
    }
}

/// Fills in the instances that were not chosen as such: converters, and timers of the pure model.
fn name_units(design: &Design, board: &Board, wirings: &mut [DeviceWiring]) {
    let adcs: BTreeMap<DeviceIndex, String> = converters::choose(design, board, wirings);
    for wiring in wirings.iter_mut().filter(|wiring| wiring.unit.is_none()) {
        let analog = design
            .device(wiring.device)
            .is_some_and(|device| matches!(device.kind, Kind::Analog(_)));
        wiring.unit = if analog {
            adcs.get(&wiring.device).cloned()
        } else {
            let signal = wiring.wires.first().and_then(|wire| wire.usage(board));
            let units = signal.map(|usage| usage.signal.function().units()).unwrap_or_default();
            units.first().map(ToString::to_string)
        };
    }
}

/// Usages of all pins that the board's devices and its link use, each pin once.
fn cost(board: &Board, assignment: &BoardAssignment) -> u32 {
    let of_devices = assignment.devices.iter().flat_map(|wiring| &wiring.wires);
    let of_link = assignment.link.iter().flat_map(|link| &link.wires);
    let mut pins: Vec<usize> = of_devices.chain(of_link).map(|wire| wire.pin).collect();
    pins.sort_unstable();
    pins.dedup();
    pins.iter().filter_map(|pin| board.table.pins.get(*pin)).map(Pin::cost).sum()
}
