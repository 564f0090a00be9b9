//! The histories of all numbers that boards report, within one budget of memory.
//!
//! In: boards, and news of them. Out: the history of each element. An array has those of its first elements.

use std::time::Duration;

use sensedsl_host::{Board, Device};
use sensedsl_wire::Scalar;

use super::history::{ENTRY_BYTES, History};

/// The memory of all histories together.
const BUDGET_BYTES: usize = 64 << 20;
/// The most numbers that have one.
const LINES_MAX: usize = 4096;
/// The most elements of an array that have one.
const ELEMENTS_MAX: usize = 16;
/// The most values of a history: more are in no plot.
const VALUES_MAX: usize = 8192;

/// The histories of all boards' devices.
pub(super) struct Traces {
    /// For each board and each of its devices those of its elements.
    of: Vec<Vec<Vec<History>>>,
}

fn elements(device: &Device) -> usize {
    device.value.count().min(ELEMENTS_MAX)
}

impl Traces {
    pub(super) fn new(boards: &[&Board]) -> Self {
        let all = boards.iter().flat_map(|board| &board.devices).map(elements);
        let capacity = capacity(all.sum());
        let mut left = LINES_MAX;
        let mut of_device = |device: &Device| {
            let count = elements(device).min(left);
            left -= count;
            (0..count).map(|_| History::new(capacity)).collect()
        };
        let mut of = Vec::new();
        for board in boards {
            of.push(board.devices.iter().map(&mut of_device).collect());
        }
        Self { of }
    }

    /// Takes a value of a device.
    pub(super) fn add(
        &mut self,
        board: usize,
        index: usize,
        device: &Device,
        at: Duration,
        value: &[Scalar],
    ) {
        let Some(lines) = self.of.get_mut(board).and_then(|board| board.get_mut(index)) else {
            return;
        };
        let at_us = micros(at);
        for (history, raw) in lines.iter_mut().zip(value) {
            history.add(at_us, device.shown(*raw));
        }
    }

    /// Those of a device.
    pub(super) fn of(&self, board: usize, device: usize) -> &[History] {
        self.of.get(board).and_then(|board| board.get(device)).map_or(&[], Vec::as_slice)
    }
}

/// The values of each history, a power of two, so that their queues take no more than they hold.
fn capacity(lines: usize) -> usize {
    let each = BUDGET_BYTES / ENTRY_BYTES / lines.clamp(1, LINES_MAX);
    let each = each.clamp(2, VALUES_MAX);
    1 << each.ilog2()
}

/// A time in whole microseconds.
pub(super) fn micros(time: Duration) -> u64 {
    u64::try_from(time.as_micros()).unwrap_or(u64::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_histories_fit_the_budget() {
        for lines in [1, 4, 24, 60, 253, 1_000, LINES_MAX, 100_000] {
            let capacity = capacity(lines);
            assert!(capacity * ENTRY_BYTES * lines.min(LINES_MAX) <= BUDGET_BYTES, "{lines}");
            assert!(capacity >= 128, "{lines}: {capacity}");
        }
        assert_eq!((capacity(24), capacity(253)), (8192, 2048));
    }
}
