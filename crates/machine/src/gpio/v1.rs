//! The ports of STM32F1: CRL and CRH have four bits for each pad. A pad does not choose its peripheral: the unit AFIO
//! moves each peripheral's signals from one block of pads to another.
//!
//! In: writes to the registers of AFIO. Out: the block of each peripheral, and the pads that the debug port holds.

use super::port::{Mode, Port, Pull};
use crate::registers::merge;
use sensedsl_surroundings::Pad;

/// A port, with the manual's names of its registers.
#[derive(Clone, Copy, Debug)]
pub(super) struct Registers {
    /// CRL and CRH.
    cr: [u32; 2],
    odr: u32,
    lckr: u32,
}

impl Registers {
    /// All pads float.
    pub(super) const fn new() -> Self {
        Self { cr: [0x4444_4444; 2], odr: 0, lckr: 0 }
    }

    /// The bits CNF and MODE of a pad.
    fn setting(&self, pin: u8) -> (u32, u32) {
        let bits = self.cr[usize::from(pin / 8)] >> (4 * u32::from(pin % 8));
        (bits >> 2 & 3, bits & 3)
    }
}

impl Port for Registers {
    fn levels_at(&self) -> u32 {
        0x08
    }

    fn read(&self, offset: u32) -> u32 {
        match offset {
            0x00 | 0x04 => self.cr[(offset / 4) as usize],
            0x0C => self.odr,
            0x18 => self.lckr,
            _ => 0,
        }
    }

    fn write(&mut self, offset: u32, value: u32, mask: u32) -> bool {
        let bits = value & mask;
        match offset {
            0x00 | 0x04 => {
                let register = &mut self.cr[(offset / 4) as usize];
                *register = merge(*register, value, mask);
                return true;
            }
            0x0C => self.odr = merge(self.odr, value, mask) & 0xFFFF,
            0x10 => self.odr = (self.odr & !(bits >> 16)) | (bits & 0xFFFF),
            0x14 => self.odr &= !bits,
            0x18 => self.lckr = merge(self.lckr, value, mask),
            _ => {}
        }
        false
    }

    fn mode(&self, pin: u8) -> Mode {
        match self.setting(pin) {
            (0, 0) => Mode::Analog,
            (_, 0) => Mode::Input,
            (0 | 1, _) => Mode::Output,
            _ => Mode::Alternate(None),
        }
    }

    fn pull(&self, pin: u8) -> Pull {
        match (self.setting(pin), self.is_high(pin)) {
            ((2, 0), true) => Pull::Up,
            ((2, 0), false) => Pull::Down,
            _ => Pull::None,
        }
    }

    fn is_open_drain(&self, pin: u8) -> bool {
        let (kind, speed) = self.setting(pin);
        speed != 0 && kind & 1 == 1
    }

    fn is_high(&self, pin: u8) -> bool {
        self.odr >> pin & 1 == 1
    }

    /// MODE has the codes 2, 1 and 3 for 2, 10 and 50 MHz.
    fn speed(&self, pin: u8) -> u8 {
        match self.setting(pin) {
            (_, 1) => 1,
            (_, 3) => 3,
            _ => 0,
        }
    }
}

/// A field of a register: its offset, its lowest bit and the number of its bits.
pub(crate) type Field = (u32, u32, u32);

/// The registers of AFIO that say where signals are. Those that choose the ports of interrupts are in `exti.rs`.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Afio {
    evcr: u32,
    mapr: u32,
    mapr2: u32,
    /// `SWJ_CFG`: what the debug port holds.
    debug: u32,
}

/// The pads that the debug port may hold, with their pull resistors and the setting of `SWJ_CFG` from which on each is
/// free.
const DEBUG: [(Pad, Pull, u32); 5] = [
    (Pad { port: 0, pin: 13 }, Pull::Up, 4),
    (Pad { port: 0, pin: 14 }, Pull::Down, 4),
    (Pad { port: 0, pin: 15 }, Pull::Up, 2),
    (Pad { port: 1, pin: 3 }, Pull::None, 2),
    (Pad { port: 1, pin: 4 }, Pull::Up, 1),
];
/// The bits of `SWJ_CFG` in MAPR, and the settings that it has; any other leaves it as it is.
const SWJ: u32 = 7 << 24;
const SWJ_SETTINGS: [u32; 4] = [0, 1, 2, 4];

impl Afio {
    /// The setting of the debug port does not read back.
    pub(crate) fn read(&self, offset: u32) -> u32 {
        match offset {
            0x00 => self.evcr,
            0x04 => self.mapr,
            0x1C => self.mapr2,
            _ => 0,
        }
    }

    /// Writes a register; returns whether signals may be on other pads now.
    pub(super) fn write(&mut self, offset: u32, value: u32, mask: u32) -> bool {
        let register = match offset {
            0x00 => &mut self.evcr,
            0x04 => &mut self.mapr,
            0x1C => &mut self.mapr2,
            _ => return false,
        };
        *register = merge(*register, value, mask);
        let setting = (self.mapr & SWJ) >> 24;
        if offset == 0x04 && mask & SWJ != 0 && SWJ_SETTINGS.contains(&setting) {
            self.debug = setting;
        }
        self.mapr &= !SWJ;
        offset != 0
    }

    /// The block of pads that a peripheral's field chooses; a peripheral without a field has one block.
    pub(super) fn block(&self, field: Option<Field>) -> u32 {
        let Some((offset, bit, bits)) = field else { return 0 };
        self.read(offset) >> bit & ((1 << bits) - 1)
    }

    /// The pull resistor of a pad that the debug port holds; `None` if the pad is free.
    pub(super) fn debugs(&self, pad: Pad) -> Option<Pull> {
        let held = DEBUG.iter().find(|(own, ..)| *own == pad);
        held.filter(|(.., free_from)| self.debug < *free_from).map(|(_, pull, _)| *pull)
    }
}
