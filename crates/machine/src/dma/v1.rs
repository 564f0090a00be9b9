//! The first version of the block (F0, F1, F3, G0, G4, L0, L1, L4): up to eight streams, which the manual calls
//! channels, with fixed requests, or with those that a multiplexer selects.
//!
//! All peripherals of a stream ask through one line. An item may have one size at the peripheral and another in memory.

use super::{Direction, Dma, End, Item, STREAMS};
use crate::registers::merge;

/// Bits of CCR.
const ENABLE: u32 = 1;
const TO_PERIPHERAL: u32 = 1 << 4;
const CIRCULAR: u32 = 1 << 5;
const STEPS_PERIPHERAL: u32 = 1 << 6;
const STEPS_MEMORY: u32 = 1 << 7;
const MEMORY_TO_MEMORY: u32 = 1 << 14;
/// The status bits of a stream in ISR. The first one says that there is another; the others are at the place of their
/// enable bits in CCR.
const ANY: u32 = 1;
const COMPLETE: u32 = 1 << 1;
const HALF: u32 = 1 << 2;
const FAILED: u32 = 1 << 3;

/// A stream: its registers and its progress.
#[derive(Clone, Copy, Debug, Default)]
struct Stream {
    ccr: u32,
    left: u32,
    peripheral: u32,
    memory: u32,
    /// The number of items set when it was enabled, and of those moved since it began or began again.
    total: u32,
    done: u32,
}

/// A DMA controller. The manual counts streams from 1; the first place is empty.
#[derive(Debug, Default)]
pub(super) struct Controller {
    streams: [Stream; STREAMS],
    /// What the multiplexer has selected for each stream.
    channels: [u32; STREAMS],
    isr: u32,
}

/// The number of a stream, and the offset of a register within it.
fn place(offset: u32) -> Option<(usize, u32)> {
    let at = offset.checked_sub(0x08)?;
    let stream = (at / 0x14) as usize + 1;
    (stream < STREAMS).then_some((stream, at % 0x14))
}

impl Controller {
    fn raise(&mut self, stream: usize, bits: u32) {
        let bits = if bits == 0 { 0 } else { bits | ANY };
        self.isr |= bits << (4 * (stream - 1));
    }

    /// Clears flags; clearing the first of a stream clears all of them.
    fn clear(&mut self, bits: u32) {
        self.isr &= !bits;
        for shift in (0..32).step_by(4) {
            let is_all = bits >> shift & ANY != 0;
            let has_others = self.isr >> shift & (COMPLETE | HALF | FAILED) != 0;
            if is_all || !has_others {
                self.isr &= !(0xF << shift);
            }
        }
    }
}

impl Dma for Controller {
    fn read(&self, offset: u32) -> u32 {
        let Some((stream, register)) = place(offset) else {
            return if offset == 0x00 { self.isr } else { 0 };
        };
        let stream = &self.streams[stream];
        match register {
            0x00 => stream.ccr,
            0x04 => stream.left,
            0x08 => stream.peripheral,
            0x0C => stream.memory,
            _ => 0,
        }
    }

    fn write(&mut self, offset: u32, value: u32, mask: u32) {
        let Some((number, register)) = place(offset) else {
            if offset == 0x04 {
                self.clear(value & mask);
            }
            return;
        };
        let stream = &mut self.streams[number];
        let was_enabled = stream.ccr & ENABLE != 0;
        match register {
            0x00 => {
                stream.ccr = merge(stream.ccr, value, mask) & 0x7FFF;
                if !was_enabled && stream.ccr & ENABLE != 0 {
                    (stream.total, stream.done) = (stream.left, 0);
                }
            }
            // The other registers cannot be written while the stream runs.
            _ if was_enabled => {}
            0x04 => stream.left = merge(stream.left, value, mask) & 0xFFFF,
            0x08 => stream.peripheral = merge(stream.peripheral, value, mask),
            0x0C => stream.memory = merge(stream.memory, value, mask),
            _ => {}
        }
    }

    fn clears_flags(&self, offset: u32) -> bool {
        offset == 0x04
    }

    /// A stream that has moved everything stays enabled, but serves no request.
    fn enabled(&self) -> u32 {
        let runs = |stream: &Stream| stream.ccr & ENABLE != 0 && stream.left != 0;
        let streams = self.streams.iter().enumerate().filter(|(_, stream)| runs(stream));
        streams.fold(0, |all, (number, _)| all | 1 << number)
    }

    fn held(&self) -> u32 {
        let holds = |(number, stream): &(usize, &Stream)| {
            self.isr >> (4 * (number - 1)) & stream.ccr & (COMPLETE | HALF | FAILED) != 0
        };
        let streams = self.streams.iter().enumerate().skip(1).filter(holds);
        streams.fold(0, |all, (number, _)| all | 1 << number)
    }

    fn item(&self, stream: usize) -> Item {
        let Stream { ccr, left, peripheral, memory, done, .. } = self.streams[stream];
        let end = |base: u32, size: u32, steps: u32| {
            let bytes = 1_u32 << (size & 3).min(2);
            let step = if ccr & steps == 0 { 0 } else { bytes };
            End { address: base.wrapping_add(step.wrapping_mul(done)), bytes }
        };
        let direction = match (ccr & MEMORY_TO_MEMORY, ccr & TO_PERIPHERAL) {
            (0, 0) => Direction::FromPeripheral,
            (0, _) => Direction::ToPeripheral,
            _ => Direction::Memory,
        };
        let peripheral = end(peripheral, ccr >> 8, STEPS_PERIPHERAL);
        let memory = end(memory, ccr >> 10, STEPS_MEMORY);
        Item { direction, peripheral, memory, left, channel: self.channels[stream] }
    }

    fn count(&mut self, stream: usize) {
        let own = &mut self.streams[stream];
        own.left = own.left.saturating_sub(1);
        own.done += 1;
        let mut status = 0;
        if own.left == own.total / 2 && own.total > 1 {
            status |= HALF;
        }
        if own.left == 0 {
            status |= COMPLETE;
            if own.ccr & CIRCULAR != 0 {
                (own.left, own.done) = (own.total, 0);
            }
        }
        self.raise(stream, status);
    }

    fn select(&mut self, stream: usize, channel: u32) {
        self.channels[stream] = channel;
    }

    fn fail(&mut self, stream: usize) {
        self.streams[stream].ccr &= !ENABLE;
        self.raise(stream, FAILED);
    }
}

#[cfg(test)]
mod tests {
    use super::{Controller, Direction, Dma, End};

    /// The registers of the first stream.
    const CCR: u32 = 0x08;
    const CNDTR: u32 = 0x0C;

    fn put(dma: &mut Controller, offset: u32, value: u32) {
        dma.write(offset, value, u32::MAX);
    }

    #[test]
    fn items_have_a_size_at_each_end() {
        let mut dma = Controller::default();
        put(&mut dma, CNDTR, 2);
        put(&mut dma, 0x10, 0x4001_244C);
        put(&mut dma, 0x14, 0x2000_0000);
        // Half-words from one address to words at rising ones, with an interrupt at the end.
        put(&mut dma, CCR, 1 | 1 << 1 | 1 << 7 | 1 << 8 | 2 << 10);
        assert_eq!((dma.enabled(), dma.held()), (2, 0));
        dma.count(1);
        let item = dma.item(1);
        assert_eq!((item.direction, item.left), (Direction::FromPeripheral, 1));
        assert_eq!(item.peripheral, End { address: 0x4001_244C, bytes: 2 });
        assert_eq!(item.memory, End { address: 0x2000_0004, bytes: 4 });
        // While it runs, its address does not change.
        put(&mut dma, 0x14, 0);
        assert_eq!(dma.item(1), item);
        dma.count(1);
        assert_eq!((dma.enabled(), dma.held(), dma.read(0x00)), (0, 2, 0b0111));
        // It is still enabled, and a new length needs it off.
        put(&mut dma, CNDTR, 5);
        assert_eq!((dma.read(CCR) & 1, dma.read(CNDTR)), (1, 0));
        put(&mut dma, 0x04, 2);
        assert_eq!((dma.held(), dma.read(0x00)), (0, 0b0101));
        put(&mut dma, 0x04, 1);
        assert_eq!(dma.read(0x00), 0);
    }

    #[test]
    fn a_circular_stream_begins_again() {
        let mut dma = Controller::default();
        // The last stream, and so the last place of the status register.
        let ccr = CCR + 6 * 0x14;
        put(&mut dma, ccr + 4, 4);
        put(&mut dma, ccr + 12, 0x2000_0100);
        put(&mut dma, ccr, 1 | 1 << 2 | 1 << 4 | 1 << 5 | 1 << 7);
        for _ in 0..2 {
            dma.count(7);
        }
        assert_eq!((dma.held(), dma.read(0x00)), (1 << 7, 0b0101 << 24));
        assert_eq!(dma.item(7).direction, Direction::ToPeripheral);
        for _ in 0..2 {
            dma.count(7);
        }
        assert_eq!((dma.item(7).left, dma.item(7).memory.address), (4, 0x2000_0100));
        assert_eq!(dma.read(0x00) >> 24, 0b0111);
    }
}
