//! The ports of the families after STM32F1: each pad has a mode, and a number for the peripheral that controls it.

use super::port::{Mode, Port, Pull};
use crate::registers::merge;

/// A port, with the manual's names of its registers.
#[derive(Clone, Copy, Debug)]
pub(super) struct Registers {
    moder: u32,
    otyper: u32,
    ospeedr: u32,
    pupdr: u32,
    odr: u32,
    lckr: u32,
    afr: [u32; 2],
    /// Whether this is a later family: pads are analog after a reset, and BRR exists.
    is_later: bool,
}

fn field(register: u32, pin: u8) -> u32 {
    (register >> (2 * u32::from(pin))) & 3
}

impl Registers {
    /// The state after a reset: the debugger has its own pads.
    pub(super) fn new(port: usize, is_later: bool) -> Self {
        let (debugger, ospeedr, pupdr) = match port {
            0 => (0xA800_0000, 0x0C00_0000, 0x6400_0000),
            1 => (0x0000_0280, 0x0000_00C0, 0x0000_0100),
            _ => (0, 0, 0),
        };
        let others = match port {
            _ if !is_later => 0,
            0 => 0x03FF_FFFF,
            1 => 0xFFFF_FC3F,
            _ => u32::MAX,
        };
        let moder = debugger | others;
        Self { moder, otyper: 0, ospeedr, pupdr, odr: 0, lckr: 0, afr: [0; 2], is_later }
    }
}

impl Port for Registers {
    fn levels_at(&self) -> u32 {
        0x10
    }

    fn read(&self, offset: u32) -> u32 {
        match offset {
            0x00 => self.moder,
            0x04 => self.otyper,
            0x08 => self.ospeedr,
            0x0C => self.pupdr,
            0x14 => self.odr,
            0x1C => self.lckr,
            0x20 | 0x24 => self.afr[((offset - 0x20) / 4) as usize],
            _ => 0,
        }
    }

    fn write(&mut self, offset: u32, value: u32, mask: u32) -> bool {
        let put = |old: &mut u32| *old = merge(*old, value, mask);
        match offset {
            0x00 => put(&mut self.moder),
            0x04 => put(&mut self.otyper),
            0x08 => put(&mut self.ospeedr),
            0x0C => put(&mut self.pupdr),
            0x14 => put(&mut self.odr),
            0x18 => {
                let (set, clear) = (value & mask & 0xFFFF, (value & mask) >> 16);
                self.odr = (self.odr & !clear) | set;
            }
            0x28 if self.is_later => self.odr &= !(value & mask),
            0x1C => put(&mut self.lckr),
            0x20 | 0x24 => put(&mut self.afr[((offset - 0x20) / 4) as usize]),
            _ => {}
        }
        self.odr &= 0xFFFF;
        matches!(offset, 0x00 | 0x20 | 0x24)
    }

    fn mode(&self, pin: u8) -> Mode {
        match field(self.moder, pin) {
            0 => Mode::Input,
            1 => Mode::Output,
            2 => {
                let register = self.afr[usize::from(pin / 8)];
                let number = (register >> (4 * u32::from(pin % 8))) & 15;
                Mode::Alternate(u8::try_from(number).ok())
            }
            _ => Mode::Analog,
        }
    }

    fn pull(&self, pin: u8) -> Pull {
        match field(self.pupdr, pin) {
            1 => Pull::Up,
            2 => Pull::Down,
            _ => Pull::None,
        }
    }

    fn is_open_drain(&self, pin: u8) -> bool {
        self.otyper >> pin & 1 == 1
    }

    fn is_high(&self, pin: u8) -> bool {
        self.odr >> pin & 1 == 1
    }

    fn speed(&self, pin: u8) -> u8 {
        u8::try_from(field(self.ospeedr, pin)).unwrap_or(0)
    }
}
