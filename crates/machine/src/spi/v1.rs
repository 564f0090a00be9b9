//! The first two versions of the block (F1, F2, F4, L1): room for one item in each direction, of 8 or 16 bits.

use super::{
    BUSY, EMPTY, ENABLE, MASTER, OVERRUN, Place, RECEIVED, RECEIVES_BY_DMA, Spi, TRANSMITS_BY_DMA,
};
use crate::mcu::Mcu;
use crate::ports::PortState;
use crate::registers::merge;
use crate::wires::{NEVER, Wires, periods_ns};

/// The bit of CR1 for items of 16 bits.
const WIDE: u32 = 1 << 11;

/// An SPI port.
#[derive(Debug)]
pub(super) struct Unit {
    place: Place,
    cr: [u32; 2],
    other: [u32; 5],
    sr: u32,
    received: u16,
    waiting: Option<u16>,
    shifting: Option<u16>,
    until: u64,
    has_read_data: bool,
}

impl Unit {
    pub(super) fn new(unit: u8, mcu: &'static Mcu) -> Self {
        Self {
            place: Place::new(unit, mcu),
            cr: [0; 2],
            other: [7, 0, 0, 0, 2],
            sr: EMPTY,
            received: 0,
            waiting: None,
            shifting: None,
            until: NEVER,
            has_read_data: false,
        }
    }

    fn begin(&mut self, at: u64, wires: &Wires) {
        self.until = NEVER;
        if self.cr[0] & (ENABLE | MASTER) != ENABLE | MASTER || self.shifting.is_some() {
            return;
        }
        let Some(item) = self.waiting.take() else {
            self.sr &= !BUSY;
            return;
        };
        let bits = if self.cr[0] & WIDE != 0 { 16 } else { 8 };
        self.shifting = Some(item);
        self.sr |= EMPTY | BUSY;
        let periods = bits << ((self.cr[0] >> 3 & 7) + 1);
        self.until = at + periods_ns(periods, self.place.clock_hz(wires));
    }

    fn finish(&mut self, item: u16, wires: &Wires) {
        let [high, low] = item.to_be_bytes();
        let exchange = |byte: u8| self.place.exchange(byte, wires);
        let answer = if self.cr[0] & WIDE != 0 {
            u16::from_be_bytes([exchange(high), exchange(low)])
        } else {
            u16::from(exchange(low))
        };
        if self.sr & RECEIVED != 0 {
            self.sr |= OVERRUN;
        } else {
            self.received = answer;
            self.sr |= RECEIVED;
        }
    }

    fn report(&self, wires: &mut Wires) {
        self.place.report(self.cr[1], self.sr, wires);
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
        let is_ready = |enable: u32, flag: u32| self.cr[1] & enable != 0 && self.sr & flag != 0;
        if transmits {
            is_ready(TRANSMITS_BY_DMA, EMPTY) && self.cr[0] & ENABLE != 0
        } else {
            is_ready(RECEIVES_BY_DMA, RECEIVED)
        }
    }

    fn read(&mut self, offset: u32, _: u32, wires: &mut Wires) -> u32 {
        let value = match offset {
            0x00 | 0x04 => self.cr[(offset / 4) as usize],
            0x08 => {
                let value = self.sr;
                if self.has_read_data {
                    self.sr &= !OVERRUN;
                    self.has_read_data = false;
                }
                value
            }
            0x0C => {
                self.sr &= !RECEIVED;
                self.has_read_data = self.sr & OVERRUN != 0;
                u32::from(self.received)
            }
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
            0x0C => {
                self.waiting = Some((value & mask & 0xFFFF) as u16);
                self.sr &= !EMPTY;
            }
            0x10..=0x20 => put(&mut self.other[((offset - 0x10) / 4) as usize]),
            _ => {}
        }
        if self.until == NEVER {
            self.begin(wires.now, wires);
        }
        self.report(wires);
    }
}
