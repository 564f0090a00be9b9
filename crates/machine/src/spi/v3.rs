//! The version with items of 4 to 16 bits and a FIFO of four bytes in each direction (F0, F3, F7, G0, G4, L4).
//!
//! An access of two bytes moves two items at once where an item is a byte or less. The surroundings take whole bytes:
//! an item of up to 8 bits is one, a longer one is two.

use std::collections::VecDeque;

use super::{
    BUSY, EMPTY, ENABLE, MASTER, OVERRUN, Place, RECEIVED, RECEIVES_BY_DMA, Spi, TRANSMITS_BY_DMA,
};
use crate::mcu::Mcu;
use crate::ports::PortState;
use crate::registers::merge;
use crate::wires::{NEVER, Wires, periods_ns};

const FIFO_BYTES: usize = 4;
/// The bit of CR2 for an RXNE that a single byte sets, and not only two.
const BYTE_COUNTS: u32 = 1 << 12;

/// An SPI port.
#[derive(Debug)]
pub(super) struct Unit {
    place: Place,
    cr: [u32; 2],
    other: [u32; 5],
    has_overrun: bool,
    received: VecDeque<u8>,
    waiting: VecDeque<u8>,
    /// The item on the wires.
    shifting: Option<u16>,
    until: u64,
    has_read_data: bool,
}

impl Unit {
    pub(super) fn new(unit: u8, mcu: &'static Mcu) -> Self {
        Self {
            place: Place::new(unit, mcu),
            cr: [0, 0x700],
            other: [7, 0, 0, 0, 2],
            has_overrun: false,
            received: VecDeque::new(),
            waiting: VecDeque::new(),
            shifting: None,
            until: NEVER,
            has_read_data: false,
        }
    }

    /// The bits of an item; codes for less than four stand for eight.
    fn bits(&self) -> u64 {
        match self.cr[1] >> 8 & 15 {
            0..=2 => 8,
            code => u64::from(code) + 1,
        }
    }

    /// The bytes that an item takes in a FIFO.
    fn item_bytes(&self) -> usize {
        if self.bits() > 8 { 2 } else { 1 }
    }

    /// The flags, with the fill levels of both FIFOs.
    fn sr(&self) -> u32 {
        let bit = |is_set: bool, bit: u32| if is_set { bit } else { 0 };
        let level = |fifo: &VecDeque<u8>| u32::try_from(fifo.len().min(3)).unwrap_or(3);
        let threshold = if self.cr[1] & BYTE_COUNTS == 0 { 2 } else { 1 };
        let is_busy = self.shifting.is_some() || !self.waiting.is_empty();
        bit(self.received.len() >= threshold, RECEIVED)
            | bit(self.waiting.len() <= FIFO_BYTES / 2, EMPTY)
            | bit(self.has_overrun, OVERRUN)
            | bit(is_busy && self.cr[0] & ENABLE != 0, BUSY)
            | level(&self.received) << 9
            | level(&self.waiting) << 11
    }

    fn begin(&mut self, at: u64, wires: &Wires) {
        self.until = NEVER;
        if self.cr[0] & (ENABLE | MASTER) != ENABLE | MASTER || self.shifting.is_some() {
            return;
        }
        if self.waiting.len() < self.item_bytes() {
            return;
        }
        let mut item = 0;
        for shift in (0..self.item_bytes()).map(|byte| 8 * byte) {
            item |= u16::from(self.waiting.pop_front().unwrap_or(0)) << shift;
        }
        self.shifting = Some(item);
        let periods = self.bits() << ((self.cr[0] >> 3 & 7) + 1);
        self.until = at + periods_ns(periods, self.place.clock_hz(wires));
    }

    fn finish(&mut self, item: u16, wires: &Wires) {
        let [high, low] = item.to_be_bytes();
        let exchange = |byte: u8| self.place.exchange(byte, wires);
        let answer = match self.item_bytes() {
            2 => vec![exchange(high), exchange(low)],
            _ => vec![exchange(low)],
        };
        if self.received.len() + answer.len() > FIFO_BYTES {
            self.has_overrun = true;
        } else {
            // The low byte of an item is read first.
            self.received.extend(answer.into_iter().rev());
        }
    }

    /// Takes bytes out of the FIFO.
    fn take(&mut self, bytes: u32) -> u32 {
        self.has_read_data = self.has_overrun;
        let bytes = bytes.min(2).max(u32::try_from(self.item_bytes()).unwrap_or(2));
        (0..bytes).fold(0, |value, at| {
            value | u32::from(self.received.pop_front().unwrap_or(0)) << (8 * at)
        })
    }

    /// Puts bytes into the FIFO; those for which it has no room are lost.
    fn put(&mut self, value: u32, mask: u32) {
        let bytes = if mask >> 8 & 0xFF != 0 { 2 } else { 1 }.max(self.item_bytes());
        for byte in value.to_le_bytes().into_iter().take(bytes) {
            if self.waiting.len() < FIFO_BYTES {
                self.waiting.push_back(byte);
            }
        }
    }

    fn report(&self, wires: &mut Wires) {
        self.place.report(self.cr[1], self.sr(), wires);
    }
}

impl Spi for Unit {
    fn restart(&mut self, wires: &mut Wires) {
        *self = Self::new(self.place.unit, self.place.mcu);
        self.report(wires);
    }

    fn state(&self, wires: &Wires) -> Option<PortState> {
        self.place.state(self.cr[0], wires)
    }

    fn deadline(&self) -> u64 {
        self.until
    }

    fn advance(&mut self, wires: &mut Wires) {
        while self.until <= wires.now {
            let at = self.until;
            let Some(item) = self.shifting.take() else { break };
            self.finish(item, wires);
            self.begin(at, wires);
        }
        self.report(wires);
    }

    fn asks(&self, transmits: bool) -> bool {
        let is_ready = |enable: u32, flag: u32| self.cr[1] & enable != 0 && self.sr() & flag != 0;
        if transmits {
            is_ready(TRANSMITS_BY_DMA, EMPTY) && self.cr[0] & ENABLE != 0
        } else {
            is_ready(RECEIVES_BY_DMA, RECEIVED)
        }
    }

    fn read(&mut self, offset: u32, bytes: u32, wires: &mut Wires) -> u32 {
        let value = match offset {
            0x00 | 0x04 => self.cr[(offset / 4) as usize],
            0x08 => {
                let value = self.sr();
                self.has_overrun &= !std::mem::take(&mut self.has_read_data);
                value
            }
            0x0C => self.take(bytes),
            0x10..=0x20 => self.other[((offset - 0x10) / 4) as usize],
            _ => 0,
        };
        self.report(wires);
        value
    }

    fn write(&mut self, offset: u32, value: u32, mask: u32, wires: &mut Wires) {
        let put = |old: &mut u32| *old = merge(*old, value, mask);
        match offset {
            0x00 | 0x04 => put(&mut self.cr[(offset / 4) as usize]),
            0x0C => self.put(value, mask),
            0x10..=0x20 => put(&mut self.other[((offset - 0x10) / 4) as usize]),
            _ => {}
        }
        if self.until == NEVER {
            self.begin(wires.now, wires);
        }
        self.report(wires);
    }
}
