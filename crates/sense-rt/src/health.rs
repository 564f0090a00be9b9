//! The health of a board's devices: the outcome of their last readings, how long ago those were,
//! and how often each fault occurred.

use core::ops::{Deref, DerefMut};

use crate::outcome::Outcome;

/// The age of a value that does not exist yet.
pub const AGE_NEVER: u32 = 0xFFFF_FFFF;
/// The age of a value that is older than the clock can tell (24 days).
pub const AGE_LONG: u32 = 0xFFFF_FFFE;
/// An unknown load of the processor.
pub const LOAD_UNKNOWN: u8 = 255;
/// An unknown amount of stack left.
pub const STACK_UNKNOWN: u16 = 65535;

/// A device is stale after this many of its cycles without a value.
const STALE_CYCLES: u32 = 3;
/// Half of the clock's range.
const ANCIENT_MS: u32 = 0x8000_0000;
/// A value whose time is ahead of the caller's by at most this much came meanwhile, from another
/// task.
const AHEAD_MS: u32 = 0x1_0000;

/// The status of a device.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// Never read.
    Never,
    /// The last reading was a measurement, and is not old.
    Good,
    /// No value for three cycles.
    Stale,
    /// The last reading did not come through.
    Failed,
    /// The last answer was not a measurement.
    Invalid,
}

/// A kind of failure of a reading; also the index of its count.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
    /// No device has the address, or a byte was refused.
    NotAcknowledged,
    /// A bus error.
    Bus,
    /// Another master took the bus.
    Arbitration,
    /// A time-out.
    TimeOut,
    /// A damaged answer.
    Crc,
    /// Not a measurement; also an answer of the wrong device.
    Invalid,
}

impl Fault {
    /// The number of faults.
    pub const COUNT: usize = 6;

    const fn of(outcome: Outcome) -> Option<Self> {
        match outcome {
            Outcome::NotAcknowledged => Some(Self::NotAcknowledged),
            Outcome::BusError => Some(Self::Bus),
            Outcome::ArbitrationLost => Some(Self::Arbitration),
            Outcome::TimedOut => Some(Self::TimeOut),
            Outcome::WrongCrc => Some(Self::Crc),
            Outcome::Invalid | Outcome::WrongIdentity => Some(Self::Invalid),
            Outcome::Nothing | Outcome::Fresh => None,
        }
    }
}

/// Why the board started.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Cause {
    /// Unknown.
    #[default]
    Unknown,
    /// Power-on or brown-out.
    Power,
    /// The reset pin.
    Pin,
    /// A reset by the firmware.
    Software,
    /// The watchdog.
    Watchdog,
    /// The window watchdog.
    WindowWatchdog,
    /// Illegal entry to or exit from a low-power mode.
    LowPower,
    /// A panic: the firmware stopped itself.
    Halt,
}

/// The health of the board itself, as reported to the host.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BoardHealth {
    /// Milliseconds since the start; wraps.
    pub uptime_ms: u32,
    /// The number of reports sent.
    pub reports_sent: u32,
    /// Cycles in which something was due while the line was still busy with a frame.
    pub reports_refused: u32,
    /// Bytes of the fullest stack that were never used.
    pub stack_left_bytes: u16,
    /// Why the board started.
    pub reset_cause: Cause,
    /// After a watchdog reset, the identifier of the first device of the task that hung.
    pub reset_device: u8,
    /// The highest load so far, in percent.
    pub load_percent: u8,
}

impl BoardHealth {
    /// A board of which nothing is known.
    pub const NEW: Self = Self {
        uptime_ms: 0,
        reports_sent: 0,
        reports_refused: 0,
        stack_left_bytes: STACK_UNKNOWN,
        reset_cause: Cause::Unknown,
        reset_device: 0,
        load_percent: LOAD_UNKNOWN,
    };
}

/// The health of one device, as reported to the host.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct HealthRow {
    /// Its status.
    pub status: Status,
    /// The age of its value.
    pub age_ms: u32,
    /// How often each [`Fault`] occurred; the counts stop at 65535.
    pub counts: [u16; Fault::COUNT],
}

impl HealthRow {
    /// A device of which nothing is known.
    pub(crate) const UNKNOWN: Self =
        Self { status: Status::Never, age_ms: AGE_NEVER, counts: [0; Fault::COUNT] };
}

/// The state of one device.
#[derive(Clone, Copy, Debug)]
pub struct Record {
    good_ms: u32,
    counts: [u16; Fault::COUNT],
    last: Outcome,
    has_value: bool,
    is_ancient: bool,
}

impl Record {
    /// The state at the start.
    pub const NEW: Self = Self {
        good_ms: 0,
        counts: [0; Fault::COUNT],
        last: Outcome::Nothing,
        has_value: false,
        is_ancient: false,
    };

    fn age_ms(&self, now_ms: u32) -> u32 {
        let age = now_ms.wrapping_sub(self.good_ms);
        if !self.has_value {
            AGE_NEVER
        } else if self.is_ancient {
            AGE_LONG
        } else if age >= AHEAD_MS.wrapping_neg() {
            0
        } else if age >= ANCIENT_MS {
            AGE_LONG
        } else {
            age
        }
    }

    fn status(&self, age_ms: u32, cycle_ms: u32) -> Status {
        match self.last {
            Outcome::Nothing => Status::Never,
            Outcome::Fresh if cycle_ms != 0 && age_ms / STALE_CYCLES >= cycle_ms => Status::Stale,
            Outcome::Fresh => Status::Good,
            Outcome::Invalid => Status::Invalid,
            Outcome::WrongCrc
            | Outcome::NotAcknowledged
            | Outcome::BusError
            | Outcome::ArbitrationLost
            | Outcome::TimedOut
            | Outcome::WrongIdentity => Status::Failed,
        }
    }
}

/// The health of all devices, in `[Record; SCHEMA.items.len()]`.
#[derive(Debug)]
pub struct Health<R: ?Sized = [Record]> {
    cycles_ms: &'static [u32],
    looked_at: usize,
    records: R,
}

impl<const ITEMS: usize> Health<[Record; ITEMS]> {
    /// `cycles_ms`: how often each item is read; 0, or no entry: only when something happens, and
    /// then it is never stale.
    #[must_use]
    pub const fn new(cycles_ms: &'static [u32]) -> Self {
        Self { cycles_ms, looked_at: 0, records: [Record::NEW; ITEMS] }
    }
}

impl<const ITEMS: usize> Deref for Health<[Record; ITEMS]> {
    type Target = Health;

    fn deref(&self) -> &Health {
        self
    }
}

impl<const ITEMS: usize> DerefMut for Health<[Record; ITEMS]> {
    fn deref_mut(&mut self) -> &mut Health {
        self
    }
}

impl Health {
    /// How often an item is read; 0 if it has no cycle.
    pub(crate) fn cycle_ms(&self, index: usize) -> u32 {
        self.cycles_ms.get(index).copied().unwrap_or_default()
    }

    /// Notes the outcome of a reading of an item, before any filter withholds it from the host.
    /// `Nothing` is ignored.
    pub fn note(&mut self, index: usize, outcome: Outcome, now_ms: u32) {
        let Some(record) = self.records.get_mut(index).filter(|_| outcome != Outcome::Nothing)
        else {
            return;
        };
        record.last = outcome;
        match Fault::of(outcome) {
            Some(fault) => {
                if let Some(count) = record.counts.get_mut(fault as usize) {
                    *count = count.saturating_add(1);
                }
            }
            None => {
                record.good_ms = now_ms;
                record.has_value = true;
                record.is_ancient = false;
            }
        }
    }

    /// Must be called from time to time, so often that each device has its turn within 24 days,
    /// because the clock wraps.
    pub fn tick(&mut self, now_ms: u32) {
        match self.records.get_mut(self.looked_at) {
            Some(record) => {
                record.is_ancient = record.age_ms(now_ms) == AGE_LONG;
                self.looked_at += 1;
            }
            None => self.looked_at = 0,
        }
    }

    /// The age of a device's last good value, as in [`HealthRow`].
    pub(crate) fn age_ms(&self, index: usize, now_ms: u32) -> u32 {
        self.records.get(index).unwrap_or(&Record::NEW).age_ms(now_ms)
    }

    /// The health of a device.
    #[must_use]
    pub fn row(&self, index: usize, now_ms: u32) -> HealthRow {
        let record = self.records.get(index).unwrap_or(&Record::NEW);
        let age_ms = record.age_ms(now_ms);
        let status = record.status(age_ms, self.cycle_ms(index));
        HealthRow { status, age_ms, counts: record.counts }
    }
}
