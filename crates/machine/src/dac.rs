//! A DAC's two channels, set by software or by a trigger.

use super::mcu::Mcu;
use super::registers::merge;
use super::wires::{SUPPLY_MV, Wires};

/// The bits of SR that report the channels of the later version ready.
const READY: [u32; 2] = [1 << 11, 1 << 27];

/// Both channels.
#[derive(Debug, Default)]
pub(super) struct Dac {
    /// The number of channels that the units before this one have.
    before: u8,
    /// Whether it is the version of STM32G4, with the trigger's switch in another place.
    is_later: bool,
    cr: u32,
    /// The mode of the later version.
    mcr: u32,
    sr: u32,
    holding: [u32; 2],
    output: [u32; 2],
    reported: [Option<u32>; 2],
}

impl Dac {
    /// The unit with a number, `1` for the only one, in its state after a reset.
    pub(super) fn new(number: u8, mcu: &Mcu) -> Self {
        let is_later = mcu.block(&mcu.unit("DAC", number)) == "dac_v7";
        Self { before: 2 * (number - 1), is_later, ..Self::default() }
    }

    fn status(&self) -> u32 {
        let is_ready = |channel: &usize| self.is_later && self.cr >> (16 * channel) & 1 == 1;
        let ready = (0..2).filter(is_ready).map(|channel| READY[channel]);
        ready.fold(self.sr, |all, bit| all | bit)
    }

    pub(super) fn read(&self, offset: u32) -> u32 {
        match offset {
            0x00 => self.cr,
            0x08 => self.holding[0],
            0x0C => self.holding[0] << 4,
            0x10 => self.holding[0] >> 4,
            0x14 => self.holding[1],
            0x18 => self.holding[1] << 4,
            0x1C => self.holding[1] >> 4,
            0x20 => self.holding[0] | self.holding[1] << 16,
            0x2C => self.output[0],
            0x30 => self.output[1],
            0x34 => self.status(),
            0x3C => self.mcr,
            _ => 0,
        }
    }

    pub(super) fn write(&mut self, offset: u32, value: u32, mask: u32, wires: &Wires) {
        let value = value & mask;
        match offset {
            0x00 => self.cr = merge(self.cr, value, mask),
            0x04 => {
                for channel in 0..2 {
                    if value >> channel & 1 == 1 {
                        self.output[channel] = self.holding[channel];
                    }
                }
            }
            0x08 => self.holding[0] = value & 0xFFF,
            0x0C => self.holding[0] = value >> 4 & 0xFFF,
            0x10 => self.holding[0] = (value & 0xFF) << 4,
            0x14 => self.holding[1] = value & 0xFFF,
            0x18 => self.holding[1] = value >> 4 & 0xFFF,
            0x1C => self.holding[1] = (value & 0xFF) << 4,
            0x20 => self.holding = [value & 0xFFF, value >> 16 & 0xFFF],
            0x34 => self.sr &= !value,
            0x3C => self.mcr = merge(self.mcr, value, mask),
            _ => {}
        }
        for channel in 0..2 {
            // Without a trigger, the output follows at once.
            let triggered = if self.is_later { 1 } else { 2 };
            if self.cr >> (triggered + 16 * channel) & 1 == 0 {
                self.output[channel] = self.holding[channel];
            }
        }
        self.report(wires);
    }

    fn report(&mut self, wires: &Wires) {
        for channel in 0..2 {
            let is_on = self.cr >> (16 * channel) & 1 == 1;
            let output = is_on.then_some(self.output[channel]);
            if output != self.reported[channel] {
                self.reported[channel] = output;
                let millivolts = f64::from(output.unwrap_or(0)) / 4096.0 * SUPPLY_MV;
                let number = self.before + u8::try_from(channel + 1).unwrap_or(0);
                wires.world(|world, now| world.dac(number, millivolts, now));
            }
        }
    }
}
