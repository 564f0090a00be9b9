//! CAN buses with a peer on them: another program's frames replace those of the world's stations.

use std::collections::{BTreeSet, VecDeque};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use sensedsl_surroundings::CanFrame;

/// The most frames that wait in each direction: a peer that does not read loses the oldest ones.
const WAITING_MAX: usize = 4_096;

/// The CAN buses of a board as its peer sees them. All clones are the same buses.
#[derive(Clone, Debug, Default)]
pub struct Peer {
    units: BTreeSet<u8>,
    lines: Arc<Mutex<Lines>>,
}

#[derive(Debug, Default)]
struct Lines {
    to_peer: VecDeque<(u8, CanFrame)>,
    to_board: VecDeque<(u8, CanFrame)>,
}

impl Peer {
    pub(super) fn new(units: BTreeSet<u8>) -> Self {
        Self { units, lines: Arc::default() }
    }

    /// The unit numbers of the buses.
    pub fn units(&self) -> impl Iterator<Item = u8> + '_ {
        self.units.iter().copied()
    }

    /// The peer sends a frame.
    pub fn send(&self, unit: u8, frame: CanFrame) {
        push(&mut self.lines().to_board, unit, frame);
    }

    /// The frames that the board has sent on a bus since the last call.
    #[must_use]
    pub fn receive(&self, unit: u8) -> Vec<CanFrame> {
        let mut lines = self.lines();
        let all = std::mem::take(&mut lines.to_peer);
        let (own, others): (Vec<_>, Vec<_>) = all.into_iter().partition(|(of, _)| *of == unit);
        lines.to_peer = others.into();
        own.into_iter().map(|(_, frame)| frame).collect()
    }

    /// The board has sent a frame.
    pub(super) fn sent(&self, unit: u8, frame: CanFrame) {
        push(&mut self.lines().to_peer, unit, frame);
    }

    /// The next frame that arrives at the board.
    pub(super) fn next(&self, unit: u8) -> Option<CanFrame> {
        let mut lines = self.lines();
        let place = lines.to_board.iter().position(|(of, _)| *of == unit)?;
        lines.to_board.remove(place).map(|(_, frame)| frame)
    }

    fn lines(&self) -> MutexGuard<'_, Lines> {
        // A queue is consistent even if a thread panicked while it held the lock.
        self.lines.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

fn push(queue: &mut VecDeque<(u8, CanFrame)>, unit: u8, frame: CanFrame) {
    if queue.len() >= WAITING_MAX {
        queue.pop_front();
    }
    queue.push_back((unit, frame));
}
