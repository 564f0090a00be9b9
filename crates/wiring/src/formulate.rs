//! From a design to the solver's problem: every rule becomes a domain, a claim, a DMA request, a
//! soft rule or a board.

use std::collections::{BTreeMap, BTreeSet};

use sensedsl_board::pin::natural;
use sensedsl_model::design::{
    Board, BoardIndex, Connection, ConnectionIndex, Design, Link, PartIndex, Transport,
};
use sensedsl_model::kind::{Kind, uart};
use sensedsl_solve::Cancel;
use sensedsl_solve::problem::{
    self as solver, BoardId, DmaRequest, DmaUser, DmaUserId, PinId, Problem, RuleId, SignalId,
    StreamId,
};

use crate::alternatives::{RequestedWires, alternatives};
use crate::keep::Keep;
use crate::names::{Group, Names, Resource};
use crate::offer::Offer;
use crate::ties::{self, Elements};
use crate::wishes;

/// Name of a wire that needs no signal.
pub(crate) const GPIO: &str = "GPIO";

/// Something that asks for wires.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Requester {
    Connection(ConnectionIndex),
    /// The serial link of a board.
    Link(BoardIndex),
}

/// The meaning of a candidate of the solver.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Chosen {
    pub(crate) pin: usize,
    pub(crate) usage: Option<usize>,
}

/// The meaning of an alternative of the solver.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Meaning {
    pub(crate) board: BoardIndex,
    /// The peripheral instance, if the alternative decides it.
    pub(crate) unit: Option<String>,
    pub(crate) roles: Vec<Vec<Chosen>>,
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
    /// For each DMA stream, its board and spelling.
    pub(crate) streams: Vec<(BoardIndex, String)>,
    /// For each pin of the problem, its board and index in the table.
    pub(crate) pins: Vec<(BoardIndex, usize)>,
    /// When converters are chosen.
    pub(crate) converters: Converters,
    /// False if time ran out before the problem was complete; it is meaningless then.
    pub(crate) complete: bool,
}

/// The form in which the problem is put.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct ProblemForm {
    pub(crate) converters: Converters,
    /// Whether arrays that violate a wish for their elements are distinguished from those that keep
    /// it: each wiring that keeps it is then found a second time, as one that need not.
    pub(crate) wishes: bool,
}

/// When the converter of an analog device is chosen, if there are several.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Converters {
    /// After the wiring: it is not a wire, and a wiring is one answer whichever converters sample
    /// it.
    Later,
    /// With the wiring: if streams are so scarce that not every wiring leaves any for the
    /// converters.
    Now,
}

/// Everything besides the device that is needed to make alternatives.
pub(crate) struct Builder<'a> {
    pub(crate) names: Names,
    /// First pin of each board in the problem.
    first_pins: Vec<u32>,
    /// Rank of each signal name.
    signals: BTreeMap<String, u32>,
    dma: Vec<DmaUser>,
    dma_ids: BTreeMap<(BoardIndex, String), DmaUserId>,
    stream_ids: BTreeMap<(BoardIndex, String), StreamId>,
    streams: Vec<(BoardIndex, String)>,
    /// The number of soft rules.
    rules: u32,
    /// The soft rules of each part.
    rules_of: BTreeMap<PartIndex, Vec<wishes::Rule<'a>>>,
    pub(crate) design: &'a Design,
    pub(crate) converters: Converters,
    /// Checked for each board of each device, and for each alternative that is tied.
    pub(crate) cancel: Cancel<'a>,
}

impl<'a> Builder<'a> {
    pub(crate) fn new(design: &'a Design, converters: Converters, cancel: Cancel<'a>) -> Self {
        Self {
            names: Names::default(),
            first_pins: pins(design).1,
            signals: signal_ranks(design),
            dma: Vec::new(),
            dma_ids: BTreeMap::new(),
            stream_ids: BTreeMap::new(),
            streams: Vec::new(),
            rules: 0,
            rules_of: BTreeMap::new(),
            design,
            converters,
            cancel,
        }
    }

    /// The problem's pin for a pin of a board's table.
    pub(crate) fn pin(&self, board: BoardIndex, pin: usize) -> PinId {
        let first = self.first_pins.get(board.0).copied().unwrap_or_default();
        PinId(first + u32::try_from(pin).unwrap_or_default())
    }

    /// The rank of a signal.
    pub(crate) fn signal(&self, name: &str) -> SignalId {
        SignalId(self.signals.get(name).copied().unwrap_or(u32::MAX))
    }

    /// A new soft rule.
    pub(crate) fn rule(&mut self) -> RuleId {
        self.rules += 1;
        RuleId(self.rules - 1)
    }

    /// The soft rules of a part, if they have been numbered.
    pub(crate) fn rules_of(&self, part: PartIndex) -> Vec<wishes::Rule<'a>> {
        self.rules_of.get(&part).cloned().unwrap_or_default()
    }

    /// Keeps the rules of a part for its other connections.
    pub(crate) fn remember_rules(&mut self, part: PartIndex, rules: &[wishes::Rule<'a>]) {
        self.rules_of.entry(part).or_insert_with(|| rules.to_vec());
    }

    /// The DMA user of a peripheral instance; empty if its driver takes no streams.
    pub(crate) fn dma(&mut self, board: BoardIndex, unit: &str) -> Vec<DmaUserId> {
        let key = (board, unit.to_owned());
        if let Some(id) = self.dma_ids.get(&key) {
            return vec![*id];
        }
        let design = self.design;
        let profile = design.board(board).and_then(Board::profile);
        let requests = profile.map(|profile| profile.dma(unit)).unwrap_or_default();
        if requests.is_empty() {
            return Vec::new();
        }
        let requests = requests
            .iter()
            .map(|request| DmaRequest {
                streams: request
                    .streams
                    .iter()
                    .map(|stream| self.stream(board, &stream.to_string()))
                    .collect(),
            })
            .collect();
        let id = DmaUserId(u32::try_from(self.dma.len()).unwrap_or(u32::MAX));
        self.dma.push(DmaUser { requests });
        self.dma_ids.insert(key, id);
        vec![id]
    }

    fn stream(&mut self, board: BoardIndex, name: &str) -> StreamId {
        let next = StreamId(u32::try_from(self.streams.len()).unwrap_or(u32::MAX));
        let key = (board, name.to_owned());
        let id = *self.stream_ids.entry(key.clone()).or_insert(next);
        if id == next {
            self.streams.push(key);
        }
        id
    }
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
        .map(|(index, board)| Offer::new(BoardIndex(index), board))
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
    let Builder { names, dma, streams, rules, .. } = builder;
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
    Formulation {
        problem,
        offers,
        askers,
        meanings,
        resources,
        groups,
        streams,
        pins,
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

pub(crate) fn board_id(board: BoardIndex) -> BoardId {
    BoardId(u32::try_from(board.0).unwrap_or(u32::MAX))
}

pub(crate) fn wanted<'a>(design: &'a Design, connection: &'a Connection) -> RequestedWires<'a> {
    let boards = match connection.board {
        Some(board) => vec![board],
        None => (0..design.boards.len()).map(BoardIndex).collect(),
    };
    RequestedWires::connection(connection, boards)
}

/// All pins of all boards in tie-break order, and the position at which each board begins.
fn pins(design: &Design) -> (Vec<(BoardIndex, usize)>, Vec<u32>) {
    let mut pins = Vec::new();
    let mut first = Vec::new();
    for (index, board) in design.boards.iter().enumerate() {
        first.push(u32::try_from(pins.len()).unwrap_or(u32::MAX));
        pins.extend((0..board.table.pins.len()).map(|pin| (BoardIndex(index), pin)));
    }
    (pins, first)
}

/// All signal names in natural order.
fn signal_ranks(design: &Design) -> BTreeMap<String, u32> {
    let usages = design.boards.iter().flat_map(|board| &board.table.pins);
    let usages = usages.flat_map(|pin| &pin.usages);
    let names: BTreeSet<&str> = usages.map(|usage| usage.signal.name()).chain([GPIO]).collect();
    let mut names: Vec<&str> = names.into_iter().collect();
    names.sort_by(|a, b| natural(a, b));
    names.iter().zip(0..).map(|(name, rank)| ((*name).to_owned(), rank)).collect()
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
