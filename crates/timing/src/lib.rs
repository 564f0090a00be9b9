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
mod context;
mod converters;
mod groups;
pub mod i2c_clock;
mod i2c_register;
mod judge;
mod limits;
mod link;
mod load;
mod memory;
mod onewire;
mod ports;
mod processor;
mod rows;
mod steps;
mod strips;
mod units;

use sensedsl_diagnostics::Diagnostic;
use sensedsl_model::design::{Board, Design};
use sensedsl_wiring::assignment::{Assignment, BoardAssignment};

pub use can_bit::{CanBit, can_bit};
pub use clocks::{Tick, power_of_two, sampling, spi_divider};
pub use converters::depth;
pub use groups::{Starts, Turn, starts};
pub use judge::shown_time;
pub use link::finish_ms;
pub use load::{BoardTiming, Timing};
pub use rows::{Count, Cycle, Part, Row};
pub use strips::{Pulses, pulses, pulses_of, sent_bytes};
pub use units::SECOND_NS;

use context::Context;

/// Computes the load of every board that carries a device.
#[must_use]
pub fn timing(design: &Design, assignment: &Assignment) -> Timing {
    let boards = assignment.used(design).map(|(wiring, board)| {
        let context = Context::new(design, board, wiring);
        let work = processor::Work::of(&context);
        let mut rows = converters::rows(&context, &work);
        rows.extend(buses::rows(&context, &work));
        rows.extend(onewire::rows(&context));
        rows.extend(ports::rows(&context));
        rows.extend(link::rows(&context));
        rows.extend(captures::rows(&context));
        rows.extend(steps::rows(&context));
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
