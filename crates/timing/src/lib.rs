//! What a wired design requires of its hardware each second, and whether the hardware can do it.
//!
//! A design with its wiring, and the facts of target profiles and boards, go in. A [`Timing`] comes
//! out, which has the exact clock, the time taken and the share of capacity for each converter,
//! bus, link, capture and thread; and diagnostics for what is impossible. If no profile states a
//! fact, the figures that depend on it are unknown, never guessed.
//!
//! # Example
//!
//! ```
//! use sensedsl_model::{NoFiles, Request, resolve};
//! use sensedsl_timing::{Part, check, timing};
//! use sensedsl_wiring::{Search, Solved, Wiring};
//!
//! let text = "board Rover on STM32F4DiscoveryBoard {
//!     sensor Light returns uint16 { id = 1; type = analog; }
//! }";
//! let request = Request { path: "rover.sense", text, ..Request::default() };
//! let design = resolve(&request, &NoFiles).design.unwrap();
//! let solved = Wiring::new(&design, None).solve(&Search::default());
//! let Solved::Wired(wiring) = solved else { panic!("there is a wiring") };
//!
//! let load = timing(&design, &wiring);
//! let adc = load.boards[0].rows.iter().find(|row| row.part == Part::Converter).unwrap();
//! assert_eq!((adc.name.as_str(), adc.clock_hz), ("ADC1", Some(21_000_000)));
//! assert!(check(&design, &wiring).is_empty());
//! ```

mod buses;
mod can_bit;
mod captures;
mod clocks;
mod converters;
mod groups;
pub mod i2c_clock;
mod i2c_register;
mod judge;
mod limits;
mod link;
mod memory;
mod ports;
mod processor;
mod rows;

use std::collections::BTreeMap;

use sensedsl_board::catalog::SystemFacts;
use sensedsl_board::profile::TargetProfile;
use sensedsl_diagnostics::Diagnostic;
use sensedsl_model::design::{Board, BoardIndex, Design, Device, DeviceIndex};
use sensedsl_wiring::assignment::{Assignment, BoardAssignment, ConnectionWiring};

pub use can_bit::{CanBit, can_bit};
pub use clocks::{Tick, power_of_two, sampling, spi_divider};
pub use converters::depth;
pub use groups::{Starts, starts};
pub use judge::shown_time;
pub use link::finish_ms;
pub use rows::{Count, Cycle, Part, Row};

/// Nanoseconds per second.
pub const SECOND_NS: u64 = 1_000_000_000;
/// Nanoseconds per millisecond.
const MILLISECOND_NS: u64 = 1_000_000;
/// The reporter's cycle, unless something requires another.
const REPORT_MS: u32 = 10;

/// The load of all boards.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Timing {
    /// The load of each board that carries a device.
    pub boards: Vec<BoardTiming>,
}

/// The load of one board.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BoardTiming {
    /// The board.
    pub board: BoardIndex,
    /// The clock of its processor.
    pub core_hz: Option<u32>,
    /// The rows by part: converters, buses and ports, the link, captures, threads, the processor as
    /// a whole.
    pub rows: Vec<Row>,
    /// The devices of groups, each with its first measurement in milliseconds after the start.
    pub turns: Vec<Turn>,
}

/// The times at which a device of a group measures.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Turn {
    /// The group.
    pub group: String,
    /// The device.
    pub device: DeviceIndex,
    /// The first measurement, in milliseconds after the board's start.
    pub start_ms: u32,
    /// The time from one measurement to the next.
    pub period_ms: u32,
    /// The duration of a measurement.
    pub measuring_ms: u32,
    /// True if another device of the group measures at the same time, because there is no time for
    /// turns.
    pub overlaps: bool,
}

/// A device with the wires of its kind; for an array, with those of one element.
#[derive(Clone, Copy)]
pub(crate) struct Wired<'a> {
    pub(crate) index: DeviceIndex,
    pub(crate) device: &'a Device,
    pub(crate) wiring: &'a ConnectionWiring,
}

/// A board with everything that its parts are computed from.
pub(crate) struct Context<'a> {
    pub(crate) board: &'a Board,
    pub(crate) wiring: &'a BoardAssignment,
    /// Each device once, with its first element.
    pub(crate) devices: Vec<Wired<'a>>,
    /// Each element of each device.
    pub(crate) elements: Vec<Wired<'a>>,
    pub(crate) starts: Starts,
}

impl<'a> Context<'a> {
    fn new(design: &'a Design, board: &'a Board, wiring: &'a BoardAssignment) -> Self {
        let (mut devices, mut elements) = (Vec::new(), Vec::new());
        for index in wiring.devices.iter().map(|one| one.device) {
            let Some(device) = design.device(index) else { continue };
            let of_kind = |one: &&ConnectionWiring| {
                let connection = design.connection(one.connection);
                connection.is_some_and(|one| one.kind.name() == device.kind.name())
            };
            let all = device.connections.iter().filter_map(|one| wiring.connection(*one));
            let all = all.filter(of_kind).map(|wiring| Wired { index, device, wiring });
            let all: Vec<Wired<'_>> = all.collect();
            devices.extend(all.first());
            elements.extend(all);
        }
        let starts = starts(design, wiring);
        Self { board, wiring, devices, elements, starts }
    }

    /// A clock of the clock tree, by name: the system's own, or else the board's.
    pub(crate) fn clock_hz(&self, name: &str) -> Option<u32> {
        if let Some(hz) = self.board.profile().and_then(|profile| profile.clocks_hz.get(name)) {
            return Some(*hz);
        }
        self.system()?.clocks_hz.get(name).copied().filter(|hz| *hz > 0)
    }

    /// The facts that the board's system has for it.
    pub(crate) fn system(&self) -> Option<&SystemFacts> {
        let system = self.board.profile().map(TargetProfile::system);
        self.board.facts.as_ref()?.facts_of(system)
    }

    /// What devices served by one thread have in common.
    pub(crate) fn cycle(&self, wired: &Wired<'_>) -> Cycle {
        let Wired { index, device, .. } = wired;
        Cycle {
            delay_ms: device.delay_ms,
            prio: device.prio,
            start_ms: self.starts.get(index).copied().unwrap_or_default(),
        }
    }

    /// Devices of a kind, by unit and cycle.
    pub(crate) fn classes<'c, T>(
        &'c self,
        of: impl Fn(&'c Wired<'a>) -> Option<T>,
    ) -> BTreeMap<(sensedsl_board::signal::UnitName, Cycle), Vec<(&'c Wired<'a>, T)>> {
        let mut classes: BTreeMap<_, Vec<_>> = BTreeMap::new();
        for wired in &self.elements {
            let Some(what) = of(wired) else { continue };
            let Some(unit) = wired.wiring.unit.as_deref() else { continue };
            let key = (sensedsl_board::signal::UnitName::new(unit), self.cycle(wired));
            classes.entry(key).or_default().push((wired, what));
        }
        classes
    }
}

/// Computes the load of every board that carries a device.
#[must_use]
pub fn timing(design: &Design, assignment: &Assignment) -> Timing {
    let boards = assignment.used(design).map(|(wiring, board)| {
        let context = Context::new(design, board, wiring);
        let work = processor::Work::of(&context);
        let mut rows = converters::rows(&context, &work);
        rows.extend(buses::rows(&context, &work));
        rows.extend(ports::rows(&context));
        rows.extend(link::rows(&context));
        rows.extend(captures::rows(&context));
        rows.extend(processor::rows(&context, &work));
        BoardTiming {
            board: wiring.board,
            core_hz: processor::core_hz(&context),
            rows,
            turns: groups::turns(design, wiring),
        }
    });
    Timing { boards: boards.collect() }
}

/// Reports what is impossible, and what is nearly so.
#[must_use]
pub fn check(design: &Design, assignment: &Assignment) -> Vec<Diagnostic> {
    let mut diagnostics = refusals(design, assignment);
    // A load based on an impossible clock is meaningless.
    if diagnostics.is_empty() {
        diagnostics.extend(judge::judge(design, &timing(design, assignment)));
        diagnostics.extend(judge::turns(design, assignment));
    }
    diagnostics
}

/// Reports clocks and sampling times that the hardware cannot produce, and values that it cannot
/// hold.
#[must_use]
pub fn refusals(design: &Design, assignment: &Assignment) -> Vec<Diagnostic> {
    let boards = assignment.used(design);
    boards.flat_map(|(wiring, board)| refusals_of(design, board, wiring)).collect()
}

/// Like [`refusals`], for one board.
#[must_use]
pub fn refusals_of(design: &Design, board: &Board, wiring: &BoardAssignment) -> Vec<Diagnostic> {
    let context = Context::new(design, board, wiring);
    let mut diagnostics = limits::limits(&context);
    diagnostics.extend(memory::full(design, &context));
    diagnostics
}
