//! Whether each task keeps its cycles, so that a watchdog is fed only while all of them do.

use core::sync::atomic::{AtomicU32, Ordering};

/// How late a task may be, beyond one more cycle.
const LATE_MS: u32 = 1000;

/// The time of each task's last cycle. It can be a `static` that all tasks share: it only loads and
/// stores words, which is atomic on every core.
#[derive(Debug)]
pub struct Watch<const TASKS: usize> {
    cycles_ms: &'static [u32; TASKS],
    beats_ms: [AtomicU32; TASKS],
}

impl<const TASKS: usize> Watch<TASKS> {
    /// `cycles_ms`: how often each task runs its cycle. The clock is 0 at the start.
    #[must_use]
    pub const fn new(cycles_ms: &'static [u32; TASKS]) -> Self {
        Self { cycles_ms, beats_ms: [const { AtomicU32::new(0) }; TASKS] }
    }

    /// A task has completed a cycle.
    pub fn beat(&self, task: usize, now_ms: u32) {
        if let Some(beat) = self.beats_ms.get(task) {
            beat.store(now_ms, Ordering::Relaxed);
        }
    }

    /// The first task that has completed no cycle for its own cycle time and a second more. The
    /// watchdog is fed while there is none; the task is kept across the reset for the health of the
    /// board.
    #[must_use]
    pub fn hanging(&self, now_ms: u32) -> Option<usize> {
        let mut all = self.beats_ms.iter().zip(self.cycles_ms);
        all.position(|(beat, cycle_ms)| {
            let age_ms = now_ms.wrapping_sub(beat.load(Ordering::Relaxed));
            // A beat that is newer than the caller's time came meanwhile.
            age_ms < 0x8000_0000 && age_ms > cycle_ms.saturating_add(LATE_MS)
        })
    }
}
