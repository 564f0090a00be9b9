//! The registers of the version with a FIFO (G0, G4, H7 and later), which is not modelled: a port has room for one byte
//! in each direction. Flags are cleared by writing ICR.

use super::{COMPLETE, EMPTY, ERRORS, IDLE, RECEIVED, RECEIVER, TRANSMITTER, Usart};
use crate::registers::merge;
use crate::wires::{NEVER, Wires};

/// The bit of CR1 that switches the port on.
pub(super) const ENABLE: u32 = 1;
/// Bits of ISR that only this version has.
const BUSY: u32 = 1 << 16;
const TRANSMITS: u32 = 1 << 21;
const RECEIVES: u32 = 1 << 22;
/// The flags that ICR clears, at the same places.
const CLEARABLE: u32 = ERRORS | IDLE | COMPLETE;
/// The bits of RQR: give up the byte that was received, or the one that is to be sent.
const DROP_RECEIVED: u32 = 1 << 3;
const DROP_WAITING: u32 = 1 << 4;

/// The divider of the clock, by the code in PRESC.
pub(super) fn prescaler(code: u32) -> u64 {
    const BY: [u64; 12] = [1, 2, 4, 6, 8, 10, 12, 16, 32, 64, 128, 256];
    BY.get((code & 15) as usize).copied().unwrap_or(1)
}

impl Usart {
    pub(super) fn read_v4(&mut self, offset: u32) -> u32 {
        match offset {
            0x00 | 0x04 | 0x08 => self.cr[(offset / 4) as usize],
            0x0C => self.brr,
            0x10 => self.gtpr,
            0x14 => self.rtor,
            0x1C => self.isr(),
            0x24 => {
                self.sr &= !RECEIVED;
                u32::from(self.received)
            }
            0x2C => self.presc,
            _ => 0,
        }
    }

    fn isr(&self) -> u32 {
        let has = |bit: u32| self.is_on() && self.cr[0] & bit != 0;
        let bit = |is_set: bool, bit: u32| if is_set { bit } else { 0 };
        self.sr
            | bit(self.was_busy, BUSY)
            | bit(has(TRANSMITTER), TRANSMITS)
            | bit(has(RECEIVER), RECEIVES)
    }

    pub(super) fn write_v4(&mut self, offset: u32, value: u32, mask: u32, wires: &Wires) {
        let put = |old: &mut u32| *old = merge(*old, value, mask);
        match offset {
            0x00 | 0x04 | 0x08 => {
                put(&mut self.cr[(offset / 4) as usize]);
                if !self.is_on() {
                    // What is under way is given up.
                    self.sr = EMPTY | COMPLETE;
                    (self.waiting, self.shifting, self.shifted_at) = (None, None, NEVER);
                    self.was_busy = false;
                }
            }
            0x0C => put(&mut self.brr),
            0x10 => put(&mut self.gtpr),
            0x14 => put(&mut self.rtor),
            0x18 => {
                if value & mask & DROP_RECEIVED != 0 {
                    self.sr &= !RECEIVED;
                }
                if value & mask & DROP_WAITING != 0 {
                    self.waiting = None;
                    self.sr |= EMPTY;
                }
            }
            0x20 => self.sr &= !(value & mask & CLEARABLE),
            0x28 => self.transmit((value & 0xFF) as u8, wires),
            0x2C => put(&mut self.presc),
            _ => {}
        }
    }
}
