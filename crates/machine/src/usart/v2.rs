//! The registers of the first two versions (F1, F2, F4, L1): flags are cleared by reading SR, and then by an access to
//! DR. They differ in oversampling.

use super::{COMPLETE, ERRORS, IDLE, RECEIVED, Usart};
use crate::registers::merge;
use crate::wires::Wires;

/// The bit of CR1 that switches the port on.
pub(super) const ENABLE: u32 = 1 << 13;

impl Usart {
    pub(super) fn read_v2(&mut self, offset: u32) -> u32 {
        match offset {
            0x00 => {
                self.has_read_status = true;
                self.sr
            }
            0x04 => {
                self.sr &= !RECEIVED;
                if self.has_read_status {
                    self.sr &= !(ERRORS | IDLE);
                }
                self.has_read_status = false;
                u32::from(self.received)
            }
            0x08 => self.brr,
            0x0C | 0x10 | 0x14 => self.cr[((offset - 0x0C) / 4) as usize],
            0x18 => self.gtpr,
            _ => 0,
        }
    }

    pub(super) fn write_v2(&mut self, offset: u32, value: u32, mask: u32, wires: &Wires) {
        let put = |old: &mut u32| *old = merge(*old, value, mask);
        match offset {
            // Only these flags can be cleared by writing 0.
            0x00 => self.sr &= !(COMPLETE | RECEIVED) | value | !mask,
            0x04 => {
                self.has_read_status = false;
                self.transmit((value & 0xFF) as u8, wires);
            }
            0x08 => put(&mut self.brr),
            0x0C | 0x10 | 0x14 => put(&mut self.cr[((offset - 0x0C) / 4) as usize]),
            0x18 => put(&mut self.gtpr),
            _ => {}
        }
    }
}
