//! The DAC's two channels, set by software or by a trigger.

use super::wires::{SUPPLY_MV, Wires, merge};

/// Both channels.
#[derive(Debug, Default)]
pub(super) struct Dac {
    cr: u32,
    sr: u32,
    holding: [u32; 2],
    output: [u32; 2],
    told: [Option<u32>; 2],
}

impl Dac {
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
            0x34 => self.sr,
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
            _ => {}
        }
        for channel in 0..2 {
            // Without a trigger, the output follows at once.
            if self.cr >> (2 + 16 * channel) & 1 == 0 {
                self.output[channel] = self.holding[channel];
            }
        }
        self.tell(wires);
    }

    fn tell(&mut self, wires: &Wires) {
        for channel in 0..2 {
            let is_on = self.cr >> (16 * channel) & 1 == 1;
            let output = is_on.then_some(self.output[channel]);
            if output != self.told[channel] {
                self.told[channel] = output;
                let millivolts = f64::from(output.unwrap_or(0)) / 4096.0 * SUPPLY_MV;
                let number = u8::try_from(channel + 1).unwrap_or(0);
                wires.world(|world, now| world.dac(number, millivolts, now));
            }
        }
    }
}
