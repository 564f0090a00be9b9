//! From a design to the solver's problem: every rule becomes a domain, a claim, a DMA request, a
//! soft rule or a board.

use sensedsl_model::design::{BoardIndex, Connection, ConnectionIndex, Design, Link, Transport};
use sensedsl_model::kind::{Kind, uart};
use sensedsl_solve::Cancel;
use sensedsl_solve::neat::Layout;
use sensedsl_solve::problem::{self as solver, PinId, Problem};

use crate::alternatives::alternatives;
use crate::builder::{Builder, Converters, Meaning, board_id, pins};
use crate::keep::Keep;
use crate::layout;
use crate::names::{Group, Resource, Stream};
use crate::offer::Offer;
use crate::requested::RequestedWires;
use crate::ties::{self, Elements};

/// Something that asks for wires.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Requester {
    Connection(ConnectionIndex),
    /// The serial link of a board.
    Link(BoardIndex),
}

/// The problem and the meaning of its numbers.
pub(crate) struct Formulation<'a> {
    pub(crate) problem: Problem,
    pub(crate) offers: Vec<Offer<'a>>,
    /// For each device of the problem, what asks for its wires.
    pub(crate) askers: Vec<Requester>,
    /// For each device of the problem, the meanings of its alternatives.
    pub(crate) meanings: Vec<Vec<Meaning>>,
    pub(crate) resources: Vec<Resource>,
    pub(crate) groups: Vec<Group>,
    /// For each DMA user, its board and name.
    pub(crate) users: Vec<(BoardIndex, String)>,
    /// For each DMA stream, or what is dealt out as streams are, its board and name.
    pub(crate) streams: Vec<(BoardIndex, Stream)>,
    /// For each pin of the problem, its board and index in the table.
    pub(crate) pins: Vec<(BoardIndex, usize)>,
    /// Where these pins are on connectors.
    pub(crate) layout: Layout,
    /// When converters are chosen.
    pub(crate) converters: Converters,
    /// False if time ran out before the problem was complete; it is meaningless then.
    pub(crate) complete: bool,
}

impl Formulation<'_> {
    /// The problem's pin for a pin of a board's table.
    pub(crate) fn pin(&self, board: BoardIndex, pin: usize) -> Option<PinId> {
        let at = self.pins.binary_search(&(board, pin)).ok()?;
        Some(PinId(u32::try_from(at).ok()?))
    }
}

/// The form in which the problem is put.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct ProblemForm {
    pub(crate) converters: Converters,
    /// Whether arrays that violate a wish for their elements are distinguished from those that keep
    /// it: each wiring that keeps it is then found a second time, as one that need not.
    pub(crate) wishes: bool,
}

/// Makes the solver's problem of a design.
pub(crate) fn formulate<'a>(
    design: &'a Design,
    keep: Option<&Keep>,
    asked: ProblemForm,
    cancel: Cancel<'a>,
) -> Formulation<'a> {
    let offers: Vec<Offer<'_>> = design
        .boards
        .iter()
        .enumerate()
        .take_while(|_| !cancel.is_over())
        .map(|(index, board)| Offer::new(design, BoardIndex(index), board))
        .collect();
    let pins = pins(design).0;
    let links = links(design);
    let converters = asked.converters;
    let mut builder = Builder::new(design, converters, cancel);
    let mut askers = Vec::new();
    let mut devices = Vec::new();
    let mut meanings = Vec::new();
    let of_connections =
        design.connections.iter().enumerate().map(|(index, one)| {
            (Requester::Connection(ConnectionIndex(index)), wanted(design, one))
        });
    let of_links = links.iter().map(|(board, kind, link)| {
        let unit = link.unit.as_ref().map(|unit| unit.value.as_str());
        (Requester::Link(*board), RequestedWires::link(*board, kind, unit, &link.pins))
    });
    for (asker, wanted) in of_connections.chain(of_links) {
        if cancel.is_over() {
            break;
        }
        let (mut list, meaning) = alternatives(&mut builder, &offers, &wanted);
        if let (Some(keep), Requester::Connection(connection)) = (keep, asker) {
            mark_moved(design, keep, connection, &mut list, &meaning);
        }
        askers.push(asker);
        devices.push(solver::Device { alternatives: list });
        meanings.push(meaning);
    }
    tie(&mut builder, &askers, &mut devices, &mut meanings, asked.wishes);
    let solver_pins = pins.iter().filter_map(|(board, pin)| {
        let cost = design.board(*board)?.table.pins.get(*pin)?.cost();
        let shared = offers.get(board.0)?.shared_with(*pin).is_some();
        Some(solver::Pin { board: board_id(*board), cost, shared })
    });
    let boards = design.boards.iter().map(|board| solver::Board { spare: board.spare });
    let Builder { names, dma, users, streams, rules, .. } = builder;
    let (resources, groups) = names.all();
    let problem = Problem {
        pins: solver_pins.collect(),
        boards: boards.collect(),
        devices,
        dma,
        rules,
        resources: u32::try_from(resources.len()).unwrap_or(u32::MAX),
        streams: u32::try_from(streams.len()).unwrap_or(u32::MAX),
    };
    let layout = layout::layout(design, &askers, &pins);
    Formulation {
        problem,
        offers,
        askers,
        meanings,
        resources,
        groups,
        users,
        streams,
        pins,
        layout,
        converters,
        complete: !cancel.is_over(),
    }
}

/// Ties the connections of each part that has several.
fn tie(
    builder: &mut Builder<'_>,
    askers: &[Requester],
    devices: &mut [solver::Device],
    meanings: &mut [Vec<Meaning>],
    wishes: bool,
) {
    let design = builder.design;
    let part = |asker: &Requester| match asker {
        Requester::Connection(index) => design.connection(*index).map(|one| one.part),
        Requester::Link(_) => None,
    };
    let mut from = 0;
    for group in askers.chunk_by(|one, next| part(one) == part(next)) {
        let range = from..from + group.len();
        from = range.end;
        let (Some(part), Some(devices), Some(meanings)) =
            (group.first().and_then(part), devices.get_mut(range.clone()), meanings.get_mut(range))
        else {
            continue;
        };
        ties::tie(builder, part, &mut Elements { devices, meanings }, wishes);
    }
}

/// Marks the candidates that are not where the connection's wire was.
fn mark_moved(
    design: &Design,
    keep: &Keep,
    connection: ConnectionIndex,
    alternatives: &mut [solver::Alternative],
    meanings: &[Meaning],
) {
    let Some(connection) = design.connection(connection) else { return };
    let Some(device) = design.device(connection.device) else { return };
    let roles = connection.kind.roles(connection.direction);
    let roles: Vec<String> = roles.into_iter().map(|role| connection.wire_name(role)).collect();
    for (alternative, meaning) in alternatives.iter_mut().zip(meanings) {
        let Some(board) = design.board(meaning.board) else { continue };
        let wires = alternative.roles.iter_mut().zip(&meaning.roles).zip(&roles);
        for ((role, chosen), name) in wires {
            for (candidate, at) in role.candidates.iter_mut().zip(chosen) {
                let Some(pin) = board.table.pins.get(at.pin) else { continue };
                let device = &device.name.value;
                candidate.moved = keep.moves(device, name, &board.name.value, pin.name.as_str());
            }
        }
    }
}

pub(crate) fn wanted<'a>(design: &'a Design, connection: &'a Connection) -> RequestedWires<'a> {
    let boards = match connection.board {
        Some(board) => vec![board],
        None => (0..design.boards.len()).map(BoardIndex).collect(),
    };
    RequestedWires::connection(connection, boards)
}

/// The boards whose link needs wires of the table, as serial ports.
fn links(design: &Design) -> Vec<(BoardIndex, Kind, &Link)> {
    let boards = design.boards.iter().enumerate();
    let serial = boards.filter(|(_, board)| board.link.transport == Transport::Uart);
    let wanted = serial.map(|(index, board)| {
        (BoardIndex(index), Kind::Uart(uart::Uart::link(board.link.baud)), &board.link)
    });
    wanted.collect()
}
