//! A board in this program at the pace of the clock, for a command that is its host.

use std::time::Instant;

use anyhow::Result;
use sensedsl_job::BoardJob;
use sensedsl_model::design::DeviceIndex;
use sensedsl_twin::bench::Bench;

use super::SEED;
use super::board::{self, Board};
use super::run::MS;
use super::world::world;
use crate::cli::SimulateArgs;
use crate::terminal::Terminal;

/// The board, and how far it has run.
pub(crate) struct Simulated {
    board: Box<dyn Board>,
    began: Instant,
    now_ns: u64,
}

impl Simulated {
    /// A board whose sensors measure a world, which may be that of others `beside` it as well, or move within their
    /// ranges; none if the world has an error, which was told.
    pub(crate) fn new(
        job: &BoardJob<'_>,
        beside: &[DeviceIndex],
        args: &SimulateArgs,
        terminal: &Terminal,
    ) -> Result<Option<Self>> {
        let Some(world) = world(args, terminal, job, beside)? else { return Ok(None) };
        let bench = Bench::new(job, &world, world.seed.unwrap_or(SEED));
        let mut board = board::soft(job, bench, None);
        board.link_open(true);
        Ok(Some(Self { board, began: Instant::now(), now_ns: 0 }))
    }

    /// The bytes that the board has sent by now.
    pub(crate) fn read(&mut self) -> Vec<u8> {
        let due = u64::try_from(self.began.elapsed().as_nanos()).unwrap_or(u64::MAX);
        let mut bytes = Vec::new();
        while self.now_ns + MS <= due {
            self.now_ns += MS;
            self.board.run_until(self.now_ns);
            bytes.extend(self.board.link_read());
        }
        let _ = self.board.received();
        bytes
    }

    /// Sends bytes to the board.
    pub(crate) fn write(&mut self, bytes: &[u8]) {
        self.board.link_write(bytes);
    }
}
