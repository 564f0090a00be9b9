//! The load of boards: the rows and turns that the other files compute in, one value for printing and judging out.

use sensedsl_model::design::BoardIndex;

use crate::groups::Turn;
use crate::rows::Row;

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
