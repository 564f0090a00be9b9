//! What is numbered while the solver's problem is made: pins, signals, soft rules, DMA users and
//! streams.
//!
//! In: the design, and the names of what its devices could take. Out: the numbers. The makers of
//! alternatives, wishes and ties all need them, so they are in none of these files.

use std::collections::{BTreeMap, BTreeSet};

use sensedsl_board::pin::natural;
use sensedsl_board::profile::Pio;
use sensedsl_model::design::{Board, BoardIndex, Design, PartIndex, Preference};
use sensedsl_solve::Cancel;
use sensedsl_solve::problem::{
    BoardId, DmaRequest, DmaUser, DmaUserId, PinId, RuleId, SignalId, StreamId,
};

use crate::names::{Names, Stream};

/// Name of a wire that needs no signal.
pub(crate) const GPIO: &str = "GPIO";

/// Name of the user of the timer that the kernel's clock runs on.
const CLOCK: &str = "clock";

/// A soft rule, with the board that it is bound to if it is written in one.
pub(crate) type Rule<'a> = (RuleId, Option<BoardIndex>, &'a Preference);

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
    pub(crate) dma: Vec<DmaUser>,
    /// The peripheral instance, or the clock, that each DMA user is.
    pub(crate) users: Vec<(BoardIndex, String)>,
    pub(crate) streams: Vec<(BoardIndex, Stream)>,
    stream_ids: BTreeMap<(BoardIndex, Stream), StreamId>,
    /// The DMA users of each peripheral instance that was asked for, and the kernel's clock of each board.
    known: BTreeMap<(BoardIndex, String), Vec<DmaUserId>>,
    clocks: BTreeMap<BoardIndex, DmaUserId>,
    /// How many machines of each block are in use.
    machines: BTreeMap<(BoardIndex, String), usize>,
    /// The number of soft rules.
    pub(crate) rules: u32,
    /// The soft rules of each part.
    rules_of: BTreeMap<PartIndex, Vec<Rule<'a>>>,
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
            users: Vec::new(),
            streams: Vec::new(),
            stream_ids: BTreeMap::new(),
            known: BTreeMap::new(),
            clocks: BTreeMap::new(),
            machines: BTreeMap::new(),
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
    pub(crate) fn rules_of(&self, part: PartIndex) -> Vec<Rule<'a>> {
        self.rules_of.get(&part).cloned().unwrap_or_default()
    }

    /// Keeps the rules of a part for its other connections.
    pub(crate) fn remember_rules(&mut self, part: PartIndex, rules: &[Rule<'a>]) {
        self.rules_of.entry(part).or_insert_with(|| rules.to_vec());
    }

    /// The DMA users of a peripheral instance: its own requests and, if it is a timer that the kernel may need for its
    /// clock, the clock's. None if it takes nothing that is dealt out.
    pub(crate) fn dma(&mut self, board: BoardIndex, unit: &str) -> Vec<DmaUserId> {
        let key = (board, unit.to_owned());
        if let Some(users) = self.known.get(&key) {
            return users.clone();
        }
        let design = self.design;
        let Some(profile) = design.board(board).and_then(Board::profile) else { return Vec::new() };
        let timers = profile.kernel.needed();
        let is_of_clock = timers.iter().any(|timer| timer == unit);
        let timer = is_of_clock.then(|| vec![Stream::Timer(unit.to_owned())]);
        let own = profile.dma(unit).iter().map(|request| {
            request.streams.iter().map(|stream| Stream::Dma(stream.to_string())).collect()
        });
        let requests: Vec<_> = own.chain(timer).collect();
        let mut users = Vec::new();
        if !requests.is_empty() {
            users.push(self.user(board, unit, requests));
        }
        if is_of_clock {
            users.push(self.clock(board, timers));
        }
        self.known.insert(key, users.clone());
        users
    }

    /// The user of the timer that a board's clock runs on.
    fn clock(&mut self, board: BoardIndex, timers: &[String]) -> DmaUserId {
        if let Some(user) = self.clocks.get(&board) {
            return *user;
        }
        let timers = timers.iter().cloned().map(Stream::Timer).collect();
        let user = self.user(board, CLOCK, vec![timers]);
        self.clocks.insert(board, user);
        user
    }

    /// One more user of a state machine of a block.
    pub(crate) fn machine(&mut self, board: BoardIndex, block: &Pio) -> DmaUserId {
        let count = self.machines.entry((board, block.name.clone())).or_default();
        *count += 1;
        let name = format!("{} user {count}", block.name);
        let machines = (0..block.machines).map(|at| Stream::Machine(block.name.clone(), at));
        self.user(board, &name, vec![machines.collect()])
    }

    /// A new DMA user with these requests, each the streams that can serve it.
    fn user(&mut self, board: BoardIndex, name: &str, requests: Vec<Vec<Stream>>) -> DmaUserId {
        let id = DmaUserId(u32::try_from(self.dma.len()).unwrap_or(u32::MAX));
        let requests = requests.into_iter().map(|streams| DmaRequest {
            streams: streams.into_iter().map(|stream| self.stream(board, stream)).collect(),
        });
        let requests = requests.collect();
        self.dma.push(DmaUser { requests });
        self.users.push((board, name.to_owned()));
        id
    }

    fn stream(&mut self, board: BoardIndex, stream: Stream) -> StreamId {
        let next = StreamId(u32::try_from(self.streams.len()).unwrap_or(u32::MAX));
        let key = (board, stream);
        let id = *self.stream_ids.entry(key.clone()).or_insert(next);
        if id == next {
            self.streams.push(key);
        }
        id
    }
}

pub(crate) fn board_id(board: BoardIndex) -> BoardId {
    BoardId(u32::try_from(board.0).unwrap_or(u32::MAX))
}

/// All pins of all boards in tie-break order, and the position at which each board begins.
pub(crate) fn pins(design: &Design) -> (Vec<(BoardIndex, usize)>, Vec<u32>) {
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
