//! The user's controllers: what their code gets, whom an actuator obeys, and whether they still run.
//!
//! A guard above them looks whether each has ended a step lately; what one sets falls back within three of its cycles
//! after its last step, long before the watchdog acts.

use core::sync::atomic::{AtomicBool, AtomicU32, Ordering};

use sense_rt::{Outcome, Status};

use crate::devices::{Devices, Report};

/// How often an unchanged count is reported.
const REPEAT_MS: u32 = 1_000;
/// The guard wakes once in the shortest cycle, and lets a controller miss one.
const MISSED_CYCLES: u32 = 2;

/// Whom an actuator obeys.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Owner {
    /// The host; or nobody, because it is measured.
    Host,
    /// A controller: what the host commands is refused.
    Code,
    /// A controller, until the host has set it and has not fallen silent since.
    CodeOrHost,
}

/// The actuators of controllers that the host has taken; it is a `static`.
pub struct Taken<const ITEMS: usize> {
    owners: [Owner; ITEMS],
    is_hosts: [AtomicBool; ITEMS],
}

impl<const ITEMS: usize> Taken<ITEMS> {
    /// Nothing is taken. `owners`: by the index of the item.
    #[must_use]
    pub const fn new(owners: [Owner; ITEMS]) -> Self {
        Self { owners, is_hosts: [const { AtomicBool::new(false) }; ITEMS] }
    }

    /// The host sets an item: whether it may.
    pub fn yields(&self, index: usize) -> bool {
        match (self.owners.get(index), self.is_hosts.get(index)) {
            (Some(Owner::Code), _) => false,
            (Some(Owner::CodeOrHost), Some(is_hosts)) => {
                is_hosts.store(true, Ordering::Relaxed);
                true
            }
            (_, _) => true,
        }
    }

    /// Whether the host has an item, so that code does not set it.
    pub fn is_hosts(&self, index: usize) -> bool {
        self.is_hosts.get(index).is_some_and(|one| one.load(Ordering::Relaxed))
    }

    /// The host has fallen silent.
    pub fn give_back(&self) {
        self.is_hosts.iter().for_each(|one| one.store(false, Ordering::Relaxed));
    }
}

/// What is known of a controller's steps; it is a `static`.
pub struct Control {
    /// The item that counts the steps that were late or too long.
    index: usize,
    every_ms: u32,
    takes_us: u32,
    /// The lower half of the time of the last step's beginning.
    began_us: AtomicU32,
    ended_ms: AtomicU32,
    told_ms: AtomicU32,
    late: AtomicU32,
    has_begun: AtomicBool,
    has_hung: AtomicBool,
}

impl Control {
    /// No step has been made. `takes_us`: the longest that one may take.
    #[must_use]
    pub const fn new(index: usize, every_ms: u32, takes_us: u32) -> Self {
        Self {
            index,
            every_ms,
            takes_us,
            began_us: AtomicU32::new(0),
            ended_ms: AtomicU32::new(0),
            told_ms: AtomicU32::new(0),
            late: AtomicU32::new(0),
            has_begun: AtomicBool::new(false),
            has_hung: AtomicBool::new(false),
        }
    }

    /// A step begins. Returns the microseconds since the one before; 0 for the first.
    pub fn begin(&self, now_us: u64) -> u32 {
        let before_us = self.began_us.load(Ordering::Relaxed);
        self.began_us.store(now_us as u32, Ordering::Relaxed);
        if self.has_begun.load(Ordering::Relaxed) {
            return (now_us as u32).wrapping_sub(before_us);
        }
        // The guard waits for the end of the first step, too.
        self.ended_ms.store(sense_rt::milliseconds(now_us), Ordering::Relaxed);
        self.has_begun.store(true, Ordering::Relaxed);
        0
    }

    /// A step has ended that began `dt_us` after the one before.
    pub fn end<const V: usize, const I: usize>(
        &self,
        board: &Devices<V, I>,
        dt_us: u32,
        now_us: u64,
    ) {
        let took_us = (now_us as u32).wrapping_sub(self.began_us.load(Ordering::Relaxed));
        let now_ms = sense_rt::milliseconds(now_us);
        self.ended_ms.store(now_ms, Ordering::Relaxed);
        self.has_hung.store(false, Ordering::Relaxed);
        // A cycle was left out, or the step itself took too long.
        let is_late = dt_us >= self.every_ms * 1_500 || took_us > self.takes_us;
        if is_late {
            self.miss();
        }
        if is_late || now_ms.wrapping_sub(self.told_ms.load(Ordering::Relaxed)) >= REPEAT_MS {
            self.tell(board, now_ms);
        } else {
            board.with(|_, health| health.note(self.index, Outcome::Fresh, now_ms));
        }
    }

    /// Whether its steps have stopped; true once. The count is reported.
    pub fn has_hung<const V: usize, const I: usize>(
        &self,
        board: &Devices<V, I>,
        now_ms: u32,
    ) -> bool {
        let age_ms = now_ms.wrapping_sub(self.ended_ms.load(Ordering::Relaxed));
        let is_in_time =
            age_ms <= MISSED_CYCLES * self.every_ms || !self.has_begun.load(Ordering::Relaxed);
        if is_in_time || self.has_hung.load(Ordering::Relaxed) {
            return false;
        }
        self.has_hung.store(true, Ordering::Relaxed);
        self.miss();
        self.tell(board, now_ms);
        true
    }

    fn miss(&self) {
        self.late.store(self.late.load(Ordering::Relaxed).wrapping_add(1), Ordering::Relaxed);
    }

    fn tell<const V: usize, const I: usize>(&self, board: &Devices<V, I>, now_ms: u32) {
        self.told_ms.store(now_ms, Ordering::Relaxed);
        let mut late = self.late.load(Ordering::Relaxed).to_be_bytes();
        board.report(None, self.index, Outcome::Fresh, &mut late);
    }
}

/// Hands the newest value of an item to a function: its bytes (none: there is no value yet), its age in microseconds,
/// and whether it is good. What is `given` by code or the host is always good once it is there.
pub fn newest<const V: usize, const I: usize, R>(
    board: &Devices<V, I>,
    (index, is_given): (usize, bool),
    then: impl FnOnce(&[u8], u32, bool) -> R,
) -> R {
    board.with(|store, health| {
        let row = health.row(index, crate::now_ms());
        let value = store.get(index);
        let is_valid = value.is_some() && (is_given || row.status == Status::Good);
        then(value.unwrap_or_default(), row.age_ms.saturating_mul(1_000), is_valid)
    })
}
