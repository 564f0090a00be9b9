//! The second version of the block (F2, F4, F7): eight streams, and eight channels in each of them.
//!
//! A stream moves an item whenever the peripheral of its channel requests it.

use super::{Direction, Dma, End, Item};
use crate::registers::merge;

const STREAMS: usize = 8;

/// The status bits of a stream: errors and completion.
const HALF: u32 = 1 << 4;
const COMPLETE: u32 = 1 << 5;
const FAILED: u32 = 1 << 3;
const FIFO_FAILED: u32 = 1;

/// The lowest status bit of a stream in its status register.
const SHIFTS: [u32; 4] = [0, 6, 16, 22];

/// Bits of a stream's CR.
const ENABLE: u32 = 1;
const CIRCULAR: u32 = 1 << 8;
const DOUBLE: u32 = 1 << 18;
const TARGET: u32 = 1 << 19;

/// A stream: its registers and its progress.
#[derive(Clone, Copy, Debug, Default)]
struct Stream {
    cr: u32,
    left: u32,
    peripheral: u32,
    memory: [u32; 2],
    fcr: u32,
    /// The number of items set when it was enabled.
    total: u32,
    done: u32,
}

impl Stream {
    fn is_enabled(&self) -> bool {
        self.cr & ENABLE != 0
    }

    fn direction(&self) -> Direction {
        match self.cr >> 6 & 3 {
            0 => Direction::FromPeripheral,
            1 => Direction::ToPeripheral,
            _ => Direction::Memory,
        }
    }

    /// The next item at the peripheral's side, and in memory. Both have the peripheral's size: the FIFO, which packs
    /// items, is not modelled.
    fn ends(&self) -> (End, End) {
        let bytes = 1 << (self.cr >> 11 & 3);
        let moved = bytes * self.done;
        let steps = |bit: u32| if self.cr >> bit & 1 == 1 { moved } else { 0 };
        let target = usize::from(self.cr & DOUBLE != 0 && self.cr & TARGET != 0);
        let peripheral = End { address: self.peripheral.wrapping_add(steps(9)), bytes };
        let memory = End { address: self.memory[target].wrapping_add(steps(10)), bytes };
        (peripheral, memory)
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
#[derive(Debug, Default)]
pub(super) struct Controller {
    streams: [Stream; STREAMS],
    status: [u32; 2],
}

impl Controller {
    fn write_stream(&mut self, index: usize, register: u32, value: u32, mask: u32) {
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
    }

    fn raise(&mut self, index: usize, bits: u32) {
        self.status[index / 4] |= bits << SHIFTS[index % 4];
    }

    /// Whether a stream holds its interrupt line.
    fn interrupts(&self, index: usize) -> bool {
        let status = self.status[index / 4] >> SHIFTS[index % 4];
        let stream = &self.streams[index];
        // DMEIE, TEIE, HTIE and TCIE are one bit below the status bits that they enable.
        status & (stream.cr << 1) & 0x3C != 0
            || (status & FIFO_FAILED != 0 && stream.fcr & 0x80 != 0)
    }
}

/// The numbers of streams as bits.
fn bits(has: impl Fn(usize) -> bool) -> u32 {
    (0..STREAMS).filter(|stream| has(*stream)).fold(0, |all, stream| all | 1 << stream)
}

impl Dma for Controller {
    fn read(&self, offset: u32) -> u32 {
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

    fn write(&mut self, offset: u32, value: u32, mask: u32) {
        match offset {
            0x08 => self.status[0] &= !(value & mask),
            0x0C => self.status[1] &= !(value & mask),
            0x10..=0xCC => {
                let index = ((offset - 0x10) / 0x18) as usize;
                self.write_stream(index, (offset - 0x10) % 0x18, value, mask);
            }
            _ => {}
        }
    }

    fn clears_flags(&self, offset: u32) -> bool {
        matches!(offset, 0x08 | 0x0C)
    }

    fn enabled(&self) -> u32 {
        bits(|stream| self.streams[stream].is_enabled())
    }

    fn held(&self) -> u32 {
        bits(|stream| self.interrupts(stream))
    }

    fn item(&self, stream: usize) -> Item {
        let own = &self.streams[stream];
        let (peripheral, memory) = own.ends();
        let (left, channel) = (own.left, own.cr >> 25 & 7);
        Item { direction: own.direction(), peripheral, memory, left, channel }
    }

    fn count(&mut self, stream: usize) {
        let status = self.streams[stream].count();
        self.raise(stream, status);
    }

    fn fail(&mut self, stream: usize) {
        self.streams[stream].cr &= !ENABLE;
        self.raise(stream, FAILED);
    }
}
