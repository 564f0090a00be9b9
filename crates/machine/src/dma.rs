//! The two DMA controllers, with eight streams each and eight channels in each stream.
//!
//! A stream moves an item whenever the peripheral of its channel requests it. Moving takes no time here.

use super::wires::merge;

/// The status bits of a stream: errors and completion.
pub(super) const HALF: u32 = 1 << 4;
pub(super) const COMPLETE: u32 = 1 << 5;
pub(super) const FAILED: u32 = 1 << 3;
const FIFO_FAILED: u32 = 1;

/// The lowest status bit of a stream in its status register.
const SHIFTS: [u32; 4] = [0, 6, 16, 22];

/// Bits of a stream's CR.
const ENABLE: u32 = 1;
const CIRCULAR: u32 = 1 << 8;
const DOUBLE: u32 = 1 << 18;
const TARGET: u32 = 1 << 19;

/// The direction of a stream.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Direction {
    FromPeripheral,
    ToPeripheral,
    Memory,
}

/// A stream: its registers and its progress.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Stream {
    pub cr: u32,
    pub left: u32,
    pub peripheral: u32,
    pub memory: [u32; 2],
    pub fcr: u32,
    /// The number of items set when it was enabled.
    total: u32,
    done: u32,
    /// The bytes that wait until they make up a whole item of memory.
    pub pending: u64,
    pub pending_bytes: u32,
}

impl Stream {
    pub(super) fn is_enabled(&self) -> bool {
        self.cr & ENABLE != 0
    }

    pub(super) fn direction(&self) -> Direction {
        match self.cr >> 6 & 3 {
            0 => Direction::FromPeripheral,
            1 => Direction::ToPeripheral,
            _ => Direction::Memory,
        }
    }

    /// The sizes of an item at the peripheral and in memory. In direct mode, both are the peripheral's.
    pub(super) fn sizes(&self) -> (u32, u32) {
        let peripheral = 1 << (self.cr >> 11 & 3);
        let memory = 1 << (self.cr >> 13 & 3);
        let is_direct = self.fcr & 4 == 0;
        (peripheral, if is_direct { peripheral } else { memory })
    }

    /// The address of the next item at the peripheral's side.
    pub(super) fn peripheral_address(&self) -> u32 {
        let step = if self.cr >> 9 & 1 == 1 { self.sizes().0 } else { 0 };
        self.peripheral.wrapping_add(step.wrapping_mul(self.done))
    }

    /// The address of the `bytes`-th byte in memory.
    pub(super) fn memory_address(&self, bytes: u32) -> u32 {
        let target = usize::from(self.cr & DOUBLE != 0 && self.cr & TARGET != 0);
        let base = self.memory[target];
        if self.cr >> 10 & 1 == 1 { base.wrapping_add(bytes) } else { base }
    }

    /// The number of the peripheral's bytes that have been moved.
    pub(super) fn moved(&self) -> u32 {
        self.done * self.sizes().0
    }

    /// Counts an item; returns the status bits that this sets.
    fn count(&mut self) -> u32 {
        self.left = self.left.saturating_sub(1);
        self.done += 1;
        let mut status = 0;
        if self.left == self.total / 2 && self.total > 1 {
            status |= HALF;
        }
        if self.left == 0 {
            status |= COMPLETE;
            self.done = 0;
            if self.cr & (CIRCULAR | DOUBLE) == 0 {
                self.cr &= !ENABLE;
            } else {
                self.left = self.total;
                self.cr ^= if self.cr & DOUBLE == 0 { 0 } else { TARGET };
            }
        }
        status
    }
}

/// A DMA controller.
#[derive(Clone, Debug, Default)]
pub(super) struct Dma {
    pub streams: [Stream; 8],
    status: [u32; 2],
}

impl Dma {
    pub(super) fn read(&self, offset: u32) -> u32 {
        match offset {
            0x00 => self.status[0],
            0x04 => self.status[1],
            0x10..=0xCC => {
                let stream = &self.streams[((offset - 0x10) / 0x18) as usize];
                match (offset - 0x10) % 0x18 {
                    0x00 => stream.cr,
                    0x04 => stream.left,
                    0x08 => stream.peripheral,
                    0x0C => stream.memory[0],
                    0x10 => stream.memory[1],
                    _ => stream.fcr | (4 << 3),
                }
            }
            _ => 0,
        }
    }

    /// Writes a register; returns the stream that this enables.
    pub(super) fn write(&mut self, offset: u32, value: u32, mask: u32) -> Option<usize> {
        match offset {
            0x08 => self.status[0] &= !(value & mask),
            0x0C => self.status[1] &= !(value & mask),
            0x10..=0xCC => {
                let index = ((offset - 0x10) / 0x18) as usize;
                return self
                    .write_stream(index, (offset - 0x10) % 0x18, value, mask)
                    .then_some(index);
            }
            _ => {}
        }
        None
    }

    fn write_stream(&mut self, index: usize, register: u32, value: u32, mask: u32) -> bool {
        let stream = &mut self.streams[index];
        let was_enabled = stream.is_enabled();
        match register {
            0x00 => {
                let new = merge(stream.cr, value, mask);
                // While it runs, only its interrupts can be changed, and it can be stopped.
                stream.cr = if was_enabled { (stream.cr & !0x1F) | (new & 0x1F) } else { new };
                if !was_enabled && stream.is_enabled() {
                    stream.total = stream.left;
                    stream.done = 0;
                    (stream.pending, stream.pending_bytes) = (0, 0);
                    return true;
                }
                // A stream that the program stops reports completion.
                if was_enabled && !stream.is_enabled() {
                    self.raise(index, COMPLETE);
                }
            }
            0x04 if !was_enabled => stream.left = merge(stream.left, value, mask) & 0xFFFF,
            0x08 if !was_enabled => stream.peripheral = merge(stream.peripheral, value, mask),
            0x0C => stream.memory[0] = merge(stream.memory[0], value, mask),
            0x10 => stream.memory[1] = merge(stream.memory[1], value, mask),
            0x14 => stream.fcr = merge(stream.fcr, value, mask) & 0x87,
            _ => {}
        }
        false
    }

    pub(super) fn count(&mut self, index: usize) {
        let status = self.streams[index].count();
        self.raise(index, status);
    }

    pub(super) fn fail(&mut self, index: usize) {
        self.streams[index].cr &= !ENABLE;
        self.raise(index, FAILED);
    }

    fn raise(&mut self, index: usize, bits: u32) {
        self.status[index / 4] |= bits << SHIFTS[index % 4];
    }

    /// Whether a stream holds its interrupt line.
    pub(super) fn interrupts(&self, index: usize) -> bool {
        let status = self.status[index / 4] >> SHIFTS[index % 4];
        let stream = &self.streams[index];
        // DMEIE, TEIE, HTIE and TCIE are one bit below the status bits that they enable.
        status & (stream.cr << 1) & 0x3C != 0
            || (status & FIFO_FAILED != 0 && stream.fcr & 0x80 != 0)
    }
}
