//! A chip on a register bus (I2C or SPI), described by tables: initialisation, identity,
//! calibration, transfers, and the readings in them.
//!
//! A [`Chip`] makes no transfer itself. It says which one is next; the owner of the bus makes it,
//! blocking or async, and reports the outcome. The crate's README has such a loop.
//!
//! After a failed transfer the chip is started again. A chip with a wrong identity never gives
//! values. In every cycle it is asked only for its identity until that is right; then, and after
//! every 16th failed attempt, it is started from the beginning. Of the transfers with a trigger
//! only one is under way at a time, the one that has been due for longest, because they share the
//! chip's converter.

mod ask;
mod memory;
mod say;
mod table;
mod time;

use core::ops::{Deref, DerefMut};

use crate::bytes::{copy, part, part_mut};
use crate::outcome::{Outcome, Sink};
use crate::schema::Schema;
use crate::uses;

use self::memory::{Memory, Sizes, due_ms, ready_ms, set_due_ms, set_ready_ms};
pub use self::table::{Calibration, ChipTable, Command, Identity, InitStep, Reading, Transfer};
use self::time::{after, early_ms, is_reached, left_ms};

/// After this many attempts a chip with a wrong identity is started anyway: a few parts identify
/// themselves only after they have been set up.
const IDENTITY_ATTEMPTS: u32 = 16;

/// The next thing to do. The address is in the table.
#[derive(Debug, PartialEq, Eq)]
pub enum Step<'a> {
    /// Send these bytes, at least one.
    Write(&'a [u8]),
    /// Send these bytes (possibly none), then fill the others without releasing the device in
    /// between: a repeated start, or one chip select around both.
    WriteRead(&'a [u8], &'a mut [u8]),
    /// SPI only: send these bytes and receive the others, equally many, at the same time.
    Exchange(&'a [u8], &'a mut [u8]),
    /// Nothing for this many milliseconds; 0: less than one. Calling later does no harm, and
    /// calling earlier disturbs nothing.
    Wait(u32),
}

/// Event counts since the start of the board; each wraps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ChipCounts {
    /// Starts that were completed: initialised, identified and calibrated.
    pub starts: u32,
    /// Commands that succeeded.
    pub written: u32,
    /// By [`Outcome`]: values that are fresh, invalid or have a wrong checksum; transfers that
    /// failed; identities that were wrong.
    pub causes: [u32; Outcome::COUNT],
}

/// How far a step has come.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Stage {
    /// No step is under way.
    Idle,
    /// Something failed: the step is over.
    Over,
    /// Reads the identity only: nothing is written to a chip with a wrong identity.
    Look,
    Initialise,
    Identify,
    /// The block that is read next, and its place in the memory.
    Calibrate(usize, usize),
    /// The next transfer without a trigger to consider.
    Free(usize),
    /// The number of triggers so far.
    Turn(usize),
}

/// The transfer that is under way.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Pending {
    Init,
    Identity,
    Calibration,
    Free(usize),
    Fetch(usize),
    Trigger(usize),
    Command,
}

/// A wait that counts from the end of the transfer before it, which is when [`Chip::next`] is
/// called again.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Begun {
    /// The pause after a step of the initialisation.
    Pause(u16),
    /// The conversion whose result this transfer fetches.
    Conversion(usize),
}

/// A chip, with its memory in `[u8; TABLE.chip_bytes(&SCHEMA)]`.
#[derive(Debug)]
pub struct Chip<M: ?Sized = [u8]> {
    table: &'static ChipTable,
    schema: &'static Schema,
    sizes: Sizes,
    counts: ChipCounts,
    /// The time of the step.
    now_ms: u32,
    stage: Stage,
    pending: Option<Pending>,
    /// Whether the step has produced any result.
    is_touched: bool,
    fault: Outcome,
    identity_seen: u8,
    init_at: usize,
    pause_until_ms: Option<u32>,
    /// The wait that begins now.
    begun: Option<Begun>,
    /// The triggered transfer that has not been fetched yet.
    in_flight: Option<usize>,
    is_running: bool,
    has_wrong_identity: bool,
    memory: M,
}

impl<const BYTES: usize> Chip<[u8; BYTES]> {
    /// A chip that was never started. `BYTES` is [`ChipTable::chip_bytes`].
    #[must_use]
    pub const fn new(table: &'static ChipTable, schema: &'static Schema) -> Self {
        Self {
            table,
            schema,
            sizes: Sizes::new(table, schema),
            counts: ChipCounts { starts: 0, written: 0, causes: [0; Outcome::COUNT] },
            now_ms: 0,
            stage: Stage::Idle,
            pending: None,
            is_touched: false,
            fault: Outcome::Nothing,
            identity_seen: 0,
            init_at: 0,
            pause_until_ms: None,
            begun: None,
            in_flight: None,
            is_running: false,
            has_wrong_identity: false,
            memory: [0; BYTES],
        }
    }
}

impl<const BYTES: usize> Deref for Chip<[u8; BYTES]> {
    type Target = Chip;

    fn deref(&self) -> &Chip {
        self
    }
}

impl<const BYTES: usize> DerefMut for Chip<[u8; BYTES]> {
    fn deref_mut(&mut self) -> &mut Chip {
        self
    }
}

impl Chip {
    /// The table that describes the chip.
    #[must_use]
    pub fn table(&self) -> &'static ChipTable {
        self.table
    }

    /// The event counts since the start of the board.
    #[must_use]
    pub fn counts(&self) -> &ChipCounts {
        &self.counts
    }

    /// The fault found by the last step that read anything (a start counts once it is complete);
    /// `Nothing` if there is none.
    #[must_use]
    pub fn fault(&self) -> Outcome {
        self.fault
    }

    /// The first wrong byte of the last identity read.
    #[must_use]
    pub fn identity_seen(&self) -> u8 {
        self.identity_seen
    }

    /// Whether the chip is started: transfers are made and commands are accepted.
    #[must_use]
    pub fn is_running(&self) -> bool {
        self.is_running
    }

    /// The next transfer of a step, or how long there is nothing to do. A step begins with the
    /// first call after a wait, and cycles count from that time; pauses and conversions count from
    /// the call after their transfer. A transfer whose outcome was not reported is taken for lost,
    /// and the chip is started again.
    pub fn next(&mut self, now_ms: u32) -> Step<'_> {
        if self.pending.take().is_some() {
            self.restart();
            self.stage = Stage::Idle;
        }
        if self.stage == Stage::Idle {
            self.now_ms = now_ms;
            self.is_touched = false;
            self.stage = match (self.is_running, self.has_wrong_identity) {
                (true, _) => Stage::Free(0),
                (false, true) => Stage::Look,
                (false, false) => Stage::Initialise,
            };
        }
        self.begin_wait(now_ms);
        let Some((pending, asked)) = self.ask(now_ms) else {
            self.stage = Stage::Idle;
            return Step::Wait(self.idle_ms(now_ms));
        };
        self.pending = Some(pending);
        self.hand_out(asked)
    }

    /// Reports the outcome of the transfer: `Fresh` if it succeeded. Passes to `sink` one result
    /// for each reading of a transfer that was read or failed, and the cause for all readings if
    /// the chip could not be started.
    pub fn done(&mut self, outcome: Outcome, sink: &mut Sink<'_>) {
        let Some(pending) = self.pending.take() else { return };
        if outcome != Outcome::Fresh {
            self.count_fault(outcome);
            self.restart();
            match pending {
                Pending::Init | Pending::Identity | Pending::Calibration => {
                    self.say_fault(None, sink);
                }
                Pending::Free(transfer) | Pending::Fetch(transfer) | Pending::Trigger(transfer) => {
                    self.say_fault(Some(transfer), sink);
                }
                Pending::Command => self.stage = Stage::Idle,
            }
            return;
        }
        // A start proves nothing until it is complete.
        if pending != Pending::Command && !self.is_touched && self.is_running {
            self.fault = Outcome::Nothing;
            self.is_touched = true;
        }
        self.go_on(pending, sink);
    }

    /// Writes a value: returns the transfer, whose outcome must be reported to [`Self::done`].
    ///
    /// A restart loses what was written to the chip before: when [`ChipCounts::starts`] has
    /// changed, the caller must write all commands again.
    ///
    /// # Errors
    ///
    /// `Nothing` if the chip is not started, so ask again after the next step; `Invalid` if the
    /// value does not fit into the command.
    pub fn write(&mut self, command: &'static Command, value: &[u8]) -> Result<Step<'_>, Outcome> {
        let item = self.schema.items.get(usize::from(command.item));
        let can_write = uses::CHIP_COMMANDS && self.is_running && self.pending.is_none();
        let Some(item) = item.filter(|_| can_write) else {
            return Err(Outcome::Nothing);
        };
        let Memory { work, kept, .. } = Memory::split(&mut self.memory, &self.sizes);
        copy(work, command.prefix);
        let bytes = work.get_mut(command.prefix.len()..).unwrap_or_default();
        let size = command.value.encode(item, value, bytes);
        if size == 0 {
            return Err(Outcome::Invalid);
        }
        command.join(self.table.kept, kept, bytes);
        self.pending = Some(Pending::Command);
        Ok(Step::Write(part(work, 0, command.prefix.len() + size)))
    }

    /// How long from now until a step has something to do: 0 for at once, a cycle after a failure.
    #[must_use]
    pub fn idle_ms(&self, now_ms: u32) -> u32 {
        if !self.is_running {
            return self.pause_until_ms.map_or(self.table.cycle_ms, |until| left_ms(now_ms, until));
        }
        let ready_ms = |transfer: usize| left_ms(now_ms, ready_ms(&self.memory, transfer));
        let mut idle_ms = self.in_flight.map(ready_ms);
        for (transfer, table) in self.table.transfers.iter().enumerate() {
            let due_ms = left_ms(now_ms, due_ms(&self.memory, transfer));
            let wait_ms = if table.trigger.is_empty() {
                due_ms.max(ready_ms(transfer))
            } else if self.in_flight.is_none() {
                due_ms
            } else {
                continue;
            };
            idle_ms = Some(idle_ms.map_or(wait_ms, |idle_ms| idle_ms.min(wait_ms)));
        }
        idle_ms.unwrap_or(self.table.cycle_ms)
    }

    // ---- continuing ----

    /// A transfer succeeded.
    fn go_on(&mut self, pending: Pending, sink: &mut Sink<'_>) {
        match pending {
            Pending::Init => self.initialised(),
            Pending::Identity => self.compare_identity(sink),
            Pending::Calibration => self.take_calibration(),
            Pending::Free(transfer) => {
                self.say_values(transfer, sink);
                self.set_next(transfer);
                let wait_ms = self.table.transfers.get(transfer).map_or(0, |table| table.wait_ms);
                let early_ms = early_ms(self.table.cycle_ms);
                let ready_ms = self.now_ms.wrapping_add(wait_ms).wrapping_sub(early_ms);
                set_ready_ms(&mut self.memory, transfer, ready_ms);
                self.stage = Stage::Free(transfer + 1);
            }
            Pending::Fetch(transfer) => self.say_values(transfer, sink),
            Pending::Trigger(transfer) => {
                self.set_next(transfer);
                self.begun = Some(Begun::Conversion(transfer));
                self.in_flight = Some(transfer);
                if let Stage::Turn(turns) = self.stage {
                    self.stage = Stage::Turn(turns + 1);
                }
            }
            Pending::Command => self.counts.written = self.counts.written.wrapping_add(1),
        }
    }

    /// A step of the initialisation is complete; a pause may follow.
    fn initialised(&mut self) {
        let pause_ms = self.table.init().get(self.init_at).map_or(0, |step| step.pause_ms);
        self.init_at += 1;
        self.begun = (pause_ms > 0).then_some(Begun::Pause(pause_ms));
    }

    /// Begins the wait that follows the last transfer.
    fn begin_wait(&mut self, now_ms: u32) {
        match self.begun.take() {
            None => {}
            Some(Begun::Pause(pause_ms)) => {
                self.pause_until_ms = Some(after(now_ms, pause_ms.into()));
            }
            Some(Begun::Conversion(transfer)) => {
                let wait_ms = self.table.transfers.get(transfer).map_or(0, |table| table.wait_ms);
                set_ready_ms(&mut self.memory, transfer, after(now_ms, wait_ms));
            }
        }
    }

    fn compare_identity(&mut self, sink: &mut Sink<'_>) {
        let Some(identity) = self.table.identity() else { return };
        let work = Memory::split(&mut self.memory, &self.sizes).work;
        let found = work.get(identity.select.len()..).unwrap_or_default();
        let mut pairs = found.iter().zip(identity.expected).enumerate();
        let wrong = pairs.find(|(place, (found, expected))| {
            let mask = identity.mask.get(*place).copied().unwrap_or(0xFF);
            (*found ^ *expected) & mask != 0
        });
        let Some((_, (found, _))) = wrong else {
            self.identified();
            return;
        };
        self.identity_seen = *found;
        self.count_fault(Outcome::WrongIdentity);
        let looks = self.counts.causes.get(Outcome::WrongIdentity as usize);
        self.has_wrong_identity = looks.is_some_and(|looks| looks % IDENTITY_ATTEMPTS != 0);
        self.restart();
        self.say_fault(None, sink);
    }

    fn identified(&mut self) {
        self.has_wrong_identity = false;
        let had_wrong_identity = self.stage == Stage::Look;
        self.stage = if had_wrong_identity { Stage::Initialise } else { Stage::Calibrate(0, 0) };
    }

    fn take_calibration(&mut self) {
        let Stage::Calibrate(block, place) = self.stage else { return };
        let Some(table) = self.table.calibration().get(block) else { return };
        let Memory { calibration, work, .. } = Memory::split(&mut self.memory, &self.sizes);
        let count = usize::from(table.count);
        copy(part_mut(calibration, place, count), part(work, table.select.len(), count));
        self.stage = Stage::Calibrate(block + 1, place + count);
    }

    fn begin_transfers(&mut self, now_ms: u32) {
        for (transfer, table) in self.table.transfers.iter().enumerate() {
            let ready_ms = now_ms.wrapping_add(table.wait_ms);
            set_due_ms(&mut self.memory, transfer, self.now_ms);
            set_ready_ms(&mut self.memory, transfer, ready_ms);
        }
        self.is_running = true;
        self.fault = Outcome::Nothing;
        self.is_touched = true;
        self.counts.starts = self.counts.starts.wrapping_add(1);
        self.stage = Stage::Free(0);
    }

    fn restart(&mut self) {
        self.stage = Stage::Over;
        self.init_at = 0;
        self.in_flight = None;
        self.pause_until_ms = None;
        self.begun = None;
        self.is_running = false;
    }

    fn count(&mut self, outcome: Outcome) {
        if let Some(count) = self.counts.causes.get_mut(outcome as usize) {
            *count = count.wrapping_add(1);
        }
    }

    fn count_fault(&mut self, cause: Outcome) {
        self.count(cause);
        self.fault = cause;
        self.is_touched = true;
    }

    /// Moves a transfer to the next time on its own grid; missed times are skipped.
    fn set_next(&mut self, transfer: usize) {
        let own_ms = self.table.transfers.get(transfer).map_or(0, |table| table.cycle_ms);
        let cycle_ms = own_ms.max(self.table.cycle_ms);
        let due_ms = due_ms(&self.memory, transfer);
        let late_ms = self.now_ms.wrapping_sub(due_ms);
        let next_ms = match late_ms.checked_div(cycle_ms) {
            None => self.now_ms,
            Some(missed) if is_reached(self.now_ms, due_ms) => {
                due_ms.wrapping_add(cycle_ms.wrapping_mul(missed.wrapping_add(1)))
            }
            Some(_) => due_ms.wrapping_add(cycle_ms),
        };
        set_due_ms(&mut self.memory, transfer, next_ms);
    }
}
