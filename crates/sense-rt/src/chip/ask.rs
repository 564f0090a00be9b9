//! The next transfer of a step.

use super::memory::{Memory, due_ms, ready_ms};
use super::table::NextTransfer;
use super::time::{early_ms, is_reached};
use super::{Chip, Pending, Stage, Step};
use crate::bytes::{copy, part_mut, split};

impl Chip {
    /// The next transfer of the step; `None` at its end. `now_ms` is the time of the call, not that
    /// of the step.
    pub(super) fn ask(&mut self, now_ms: u32) -> Option<(Pending, NextTransfer)> {
        loop {
            match self.stage {
                Stage::Idle | Stage::Over => return None,
                Stage::Look | Stage::Identify => match self.table.identity() {
                    Some(identity) => {
                        let asked = NextTransfer::Read(identity.select, identity.expected.len());
                        return Some((Pending::Identity, asked));
                    }
                    None => self.identified(),
                },
                Stage::Initialise => {
                    if let Some(asked) = self.ask_init(now_ms)? {
                        return Some((Pending::Init, asked));
                    }
                }
                Stage::Calibrate(block, _) => match self.table.calibration().get(block) {
                    Some(block) => {
                        let asked = NextTransfer::Read(block.select, block.count.into());
                        return Some((Pending::Calibration, asked));
                    }
                    None => self.begin_transfers(now_ms),
                },
                Stage::Free(transfer) => match self.table.transfers.get(transfer) {
                    None => self.stage = Stage::Turn(0),
                    Some(table) if table.trigger.is_empty() && self.is_free(transfer, now_ms) => {
                        return Some((Pending::Free(transfer), table.asked()));
                    }
                    Some(_) => self.stage = Stage::Free(transfer + 1),
                },
                Stage::Turn(turns) => return self.ask_triggered(turns, now_ms),
            }
        }
    }

    /// The write of the next step of the initialisation, if it has bytes; `None` during a pause.
    fn ask_init(&mut self, now_ms: u32) -> Option<Option<NextTransfer>> {
        if self.pause_until_ms.is_some_and(|until| !is_reached(self.now_ms, until)) {
            return None;
        }
        self.pause_until_ms = None;
        match self.table.init().get(self.init_at) {
            None => self.stage = Stage::Identify,
            Some(step) if step.bytes.is_empty() => {
                self.initialised();
                self.begin_wait(now_ms);
            }
            Some(step) => return Some(Some(NextTransfer::Write(step.bytes))),
        }
        Some(None)
    }

    /// Fetches what is ready and triggers the next transfer, repeatedly, so that a conversion that
    /// takes no time is fetched at once.
    fn ask_triggered(&mut self, turns: usize, now_ms: u32) -> Option<(Pending, NextTransfer)> {
        if turns > self.table.transfers.len() {
            return None;
        }
        if let Some(transfer) = self.in_flight {
            if !is_reached(now_ms, ready_ms(&self.memory, transfer)) {
                return None;
            }
            self.in_flight = None;
            let table = self.table.transfers.get(transfer)?;
            return Some((Pending::Fetch(transfer), table.asked()));
        }
        let transfer = self.next_triggered()?;
        let table = self.table.transfers.get(transfer)?;
        Some((Pending::Trigger(transfer), NextTransfer::Write(table.trigger)))
    }

    fn is_due(&self, transfer: usize) -> bool {
        let soon_ms = self.now_ms.wrapping_add(early_ms(self.table.cycle_ms));
        is_reached(soon_ms, due_ms(&self.memory, transfer))
    }

    fn is_free(&self, transfer: usize, now_ms: u32) -> bool {
        is_reached(now_ms, ready_ms(&self.memory, transfer)) && self.is_due(transfer)
    }

    /// The triggered transfer that has been due for longest.
    fn next_triggered(&self) -> Option<usize> {
        let mut found: Option<(usize, u32)> = None;
        for (transfer, table) in self.table.transfers.iter().enumerate() {
            if table.trigger.is_empty() || !self.is_due(transfer) {
                continue;
            }
            let due_ms = due_ms(&self.memory, transfer);
            if found.is_none_or(|(_, first_ms)| !is_reached(due_ms, first_ms)) {
                found = Some((transfer, due_ms));
            }
        }
        found.map(|(transfer, _)| transfer)
    }

    /// Bytes are sent from the chip's memory, because the DMA may be unable to reach constant
    /// tables.
    pub(super) fn hand_out(&mut self, asked: NextTransfer) -> Step<'_> {
        let work = Memory::split(&mut self.memory, &self.sizes).work;
        let (NextTransfer::Write(sent)
        | NextTransfer::Read(sent, _)
        | NextTransfer::Exchange(sent, _)) = asked;
        copy(work, sent);
        let (sent, rest) = split(work, sent.len());
        match asked {
            NextTransfer::Write(_) => Step::Write(sent),
            NextTransfer::Read(_, count) => Step::WriteRead(sent, part_mut(rest, 0, count)),
            NextTransfer::Exchange(_, count) => Step::Exchange(sent, part_mut(rest, 0, count)),
        }
    }
}
