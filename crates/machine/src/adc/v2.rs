//! The converters of STM32F2, F4 and F7: started by software or by a timer's trigger; up to three share a divider.

use super::unit::{Adc, channel_at, code_of, injected, input_mv, sampling};
use crate::registers::merge;
use crate::wires::{NEVER, Wires, periods_ns};

/// Bits of SR.
const WATCHDOG: u32 = 1;
const DONE: u32 = 1 << 1;
const INJECTED_DONE: u32 = 1 << 2;
const INJECTED_STARTED: u32 = 1 << 3;
const STARTED: u32 = 1 << 4;
const OVERRUN: u32 = 1 << 5;
/// Bits of CR2.
const ON: u32 = 1;
const CONTINUOUS: u32 = 1 << 1;
const DMA: u32 = 1 << 8;
const DMA_GOES_ON: u32 = 1 << 9;
const EACH: u32 = 1 << 10;
const LEFT: u32 = 1 << 11;

/// The cycles that sampling takes, by the code in SMPR.
const SAMPLING: [u64; 8] = [3, 15, 28, 56, 84, 112, 144, 480];
/// The voltages at the internal inputs in millivolts: the temperature sensor at 25 degrees, the reference, half of the
/// battery's.
const TEMPERATURE_MV: f64 = 760.0;
const REFERENCE_MV: f64 = 1210.0;
const BATTERY_MV: f64 = 1650.0;

/// A converter.
#[derive(Debug)]
pub(super) struct Unit {
    unit: u8,
    sr: u32,
    cr: [u32; 2],
    smpr: [u32; 2],
    jofr: [u32; 4],
    threshold: [u32; 2],
    sqr: [u32; 3],
    jsqr: u32,
    jdr: [u32; 4],
    dr: u32,
    /// Whether DR holds a value that the DMA has to take and has not taken yet.
    asking: bool,
    /// The index of the present conversion in the sequence.
    at: u32,
    done_at: u64,
    injected_at: u64,
    /// The common divider, from the common registers.
    divider: u64,
}

impl Unit {
    pub(super) fn new(unit: u8) -> Self {
        Self {
            unit,
            sr: 0,
            cr: [0; 2],
            smpr: [0; 2],
            jofr: [0; 4],
            threshold: [0xFFF, 0],
            sqr: [0; 3],
            jsqr: 0,
            jdr: [0; 4],
            dr: 0,
            asking: false,
            at: 0,
            done_at: NEVER,
            injected_at: NEVER,
            divider: 2,
        }
    }

    fn bits(&self) -> u64 {
        12 - 2 * u64::from(self.cr[0] >> 24 & 3)
    }

    fn length(&self) -> u32 {
        if self.cr[0] >> 8 & 1 == 1 { (self.sqr[0] >> 20 & 15) + 1 } else { 1 }
    }

    fn conversion_ns(&self, channel: u32, wires: &Wires) -> u64 {
        let cycles = SAMPLING[sampling(self.smpr, channel)] + self.bits();
        periods_ns(cycles * self.divider, wires.clocks.adc).max(1)
    }

    fn sample(&self, channel: u32, wires: &Wires) -> u32 {
        let millivolts = match channel {
            16 => TEMPERATURE_MV,
            17 => REFERENCE_MV,
            18 => BATTERY_MV,
            _ => input_mv(self.unit, channel, wires),
        };
        let code = code_of(millivolts, self.bits());
        if self.cr[1] & LEFT != 0 { code << (16 - self.bits()) } else { code }
    }

    fn start(&mut self, wires: &Wires) {
        if self.cr[1] & ON != 0 && self.done_at == NEVER {
            self.at = 0;
            self.sr |= STARTED;
            self.done_at = wires.now + self.conversion_ns(channel_at(self.sqr, 0), wires);
        }
    }

    fn finish(&mut self, wires: &Wires) {
        let at = self.done_at;
        self.done_at = NEVER;
        let is_last = self.at + 1 >= self.length();
        // Without DMA, an overrun is only noticed if each conversion is reported.
        let watches = self.cr[1] & (DMA | EACH) != 0;
        let is_late = if self.cr[1] & DMA != 0 { self.asking } else { self.sr & DONE != 0 };
        if watches && is_late {
            self.sr |= OVERRUN;
        }
        if self.sr & OVERRUN != 0 && watches {
            self.asking = false;
            return;
        }
        let channel = channel_at(self.sqr, self.at);
        self.dr = self.sample(channel, wires);
        self.asking = self.cr[1] & DMA != 0;
        if is_last || self.cr[1] & EACH != 0 {
            self.sr |= DONE;
        }
        self.watch(channel);
        if !is_last {
            self.at += 1;
        } else if self.cr[1] & CONTINUOUS != 0 {
            self.at = 0;
        } else {
            return;
        }
        self.done_at = at + self.conversion_ns(channel_at(self.sqr, self.at), wires);
    }

    fn watch(&mut self, channel: u32) {
        let watches = self.cr[0] >> 23 & 1 == 1;
        let one = self.cr[0] >> 9 & 1 == 1;
        let is_outside = self.dr > self.threshold[0] || self.dr < self.threshold[1];
        if watches && is_outside && (!one || self.cr[0] & 31 == channel) {
            self.sr |= WATCHDOG;
        }
    }

    fn finish_injected(&mut self, wires: &Wires) {
        self.injected_at = NEVER;
        for (index, channel) in injected(self.jsqr).enumerate() {
            let value = self.sample(channel, wires);
            self.jdr[index] = value.wrapping_sub(self.jofr[index]) & 0xFFFF;
        }
        self.sr |= INJECTED_DONE;
    }

    fn control(&mut self, new: u32, wires: &Wires) {
        self.cr[1] = new & !((1 << 30) | (1 << 22));
        if new & ON == 0 {
            (self.done_at, self.injected_at) = (NEVER, NEVER);
            self.asking = false;
            return;
        }
        if new & DMA == 0 {
            self.asking = false;
        }
        if new >> 30 & 1 == 1 {
            self.start(wires);
        }
        if new >> 22 & 1 == 1 {
            self.sr |= INJECTED_STARTED;
            let time = injected(self.jsqr).map(|channel| self.conversion_ns(channel, wires));
            self.injected_at = wires.now + time.sum::<u64>();
        }
    }
}

impl Adc for Unit {
    fn deadline(&self) -> u64 {
        self.done_at.min(self.injected_at)
    }

    fn advance(&mut self, wires: &Wires) {
        if self.injected_at <= wires.now {
            self.finish_injected(wires);
        }
        if self.done_at <= wires.now {
            self.finish(wires);
        }
    }

    fn trigger(&mut self, triggers: u32, wires: &Wires) {
        // EXTSEL: 6 is TIM2's trigger output, 8 TIM3's, 14 TIM8's.
        let timer = match self.cr[1] >> 24 & 15 {
            6 => 1,
            8 => 2,
            14 => 7,
            _ => return,
        };
        if self.cr[1] >> 28 & 3 != 0 && triggers >> timer & 1 == 1 {
            self.start(wires);
        }
    }

    fn asks(&self) -> bool {
        self.asking
    }

    /// No more requests are made unless they are to go on.
    fn dma_ended(&mut self) {
        if self.cr[1] & DMA_GOES_ON == 0 {
            self.done_at = if self.cr[1] & CONTINUOUS == 0 { self.done_at } else { NEVER };
        }
    }

    fn interrupts(&self) -> bool {
        let enabled = (self.cr[0] >> 5 & 1) << 1
            | (self.cr[0] >> 6 & 1)
            | (self.cr[0] >> 7 & 1) << 2
            | (self.cr[0] >> 26 & 1) << 5;
        self.sr & enabled != 0
    }

    fn status(&self) -> u32 {
        self.sr & 0x3F
    }

    fn read(&mut self, offset: u32) -> u32 {
        match offset {
            0x00 => self.sr,
            0x04 => self.cr[0],
            0x08 => self.cr[1],
            0x0C | 0x10 => self.smpr[((offset - 0x0C) / 4) as usize],
            0x14..=0x20 => self.jofr[((offset - 0x14) / 4) as usize],
            0x24 | 0x28 => self.threshold[((offset - 0x24) / 4) as usize],
            0x2C..=0x34 => self.sqr[((offset - 0x2C) / 4) as usize],
            0x38 => self.jsqr,
            0x3C..=0x48 => self.jdr[((offset - 0x3C) / 4) as usize],
            0x4C => {
                self.sr &= !DONE;
                self.asking = false;
                self.dr
            }
            _ => 0,
        }
    }

    fn write(&mut self, offset: u32, value: u32, mask: u32, wires: &Wires) {
        let put = |old: &mut u32| *old = merge(*old, value, mask);
        match offset {
            0x00 => self.sr &= value | !mask,
            0x04 => put(&mut self.cr[0]),
            0x08 => self.control(merge(self.cr[1], value, mask), wires),
            0x0C | 0x10 => put(&mut self.smpr[((offset - 0x0C) / 4) as usize]),
            0x14..=0x20 => put(&mut self.jofr[((offset - 0x14) / 4) as usize]),
            0x24 | 0x28 => put(&mut self.threshold[((offset - 0x24) / 4) as usize]),
            0x2C..=0x34 => put(&mut self.sqr[((offset - 0x2C) / 4) as usize]),
            0x38 => put(&mut self.jsqr),
            _ => {}
        }
    }

    fn share(&mut self, ccr: u32) {
        self.divider = u64::from(ccr >> 16 & 3) * 2 + 2;
    }
}
