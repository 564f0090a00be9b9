//! The converters of STM32F1: started by setting ADON a second time, by SWSTART or by a timer's trigger. Their clock is
//! divided in the RCC, they have no overrun, and a calibration is over at once.

use super::unit::{Adc, channel_at, code_of, injected, input_mv, sampling};
use crate::registers::merge;
use crate::wires::{NEVER, Wires, periods_ns};

/// Bits of SR.
const WATCHDOG: u32 = 1;
const DONE: u32 = 1 << 1;
const INJECTED_DONE: u32 = 1 << 2;
const INJECTED_STARTED: u32 = 1 << 3;
const STARTED: u32 = 1 << 4;
/// Bits of CR1.
const DONE_INTERRUPTS: u32 = 1 << 5;
const WATCHDOG_INTERRUPTS: u32 = 1 << 6;
const INJECTED_INTERRUPTS: u32 = 1 << 7;
const SCAN: u32 = 1 << 8;
const WATCHES_ONE: u32 = 1 << 9;
const WATCHES: u32 = 1 << 23;
/// Bits of CR2.
const ON: u32 = 1;
const CONTINUOUS: u32 = 1 << 1;
const CALIBRATE: u32 = 1 << 2;
const RESET_CALIBRATION: u32 = 1 << 3;
const DMA: u32 = 1 << 8;
const LEFT: u32 = 1 << 11;
const INJECTED_TRIGGERED: u32 = 1 << 15;
const TRIGGERED: u32 = 1 << 20;
const START_INJECTED: u32 = 1 << 21;
const START: u32 = 1 << 22;
const INTERNAL: u32 = 1 << 23;
/// The codes of triggers in EXTSEL and JEXTSEL: software, and the trigger output of TIM3.
const SOFTWARE: u32 = 7;
const TIM3: u32 = 4;

const BITS: u64 = 12;
/// The half cycles of a conversion with its sampling, by the code in SMPR.
const HALF_CYCLES: [u64; 8] = [28, 40, 52, 82, 108, 136, 168, 504];
/// The voltages at the internal inputs in millivolts: the temperature sensor at 25 degrees, and the reference.
const TEMPERATURE_MV: f64 = 1430.0;
const REFERENCE_MV: f64 = 1200.0;

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
        }
    }

    fn length(&self) -> u32 {
        if self.cr[0] & SCAN != 0 { (self.sqr[0] >> 20 & 15) + 1 } else { 1 }
    }

    fn conversion_ns(&self, channel: u32, wires: &Wires) -> u64 {
        let half_cycles = HALF_CYCLES[sampling(self.smpr, channel)];
        periods_ns(half_cycles, 2 * wires.clocks.adc).max(1)
    }

    fn sample(&self, channel: u32, wires: &Wires) -> u32 {
        let has_internal = self.unit == 1 && self.cr[1] & INTERNAL != 0;
        let millivolts = match channel {
            16 if has_internal => TEMPERATURE_MV,
            17 if has_internal => REFERENCE_MV,
            _ => input_mv(self.unit, channel, wires),
        };
        let code = code_of(millivolts, BITS);
        if self.cr[1] & LEFT != 0 { code << (16 - BITS) } else { code }
    }

    fn start(&mut self, wires: &Wires) {
        if self.cr[1] & ON != 0 && self.done_at == NEVER {
            self.at = 0;
            self.sr |= STARTED;
            self.done_at = wires.now + self.conversion_ns(channel_at(self.sqr, 0), wires);
        }
    }

    fn start_injected(&mut self, wires: &Wires) {
        self.sr |= INJECTED_STARTED;
        let times = injected(self.jsqr).map(|channel| self.conversion_ns(channel, wires));
        self.injected_at = wires.now + times.sum::<u64>();
    }

    fn finish(&mut self, wires: &Wires) {
        let at = self.done_at;
        self.done_at = NEVER;
        let channel = channel_at(self.sqr, self.at);
        // A value that nobody has taken is lost.
        self.dr = self.sample(channel, wires);
        // ADC2 has no request of its own.
        self.asking = self.cr[1] & DMA != 0;
        self.watch(channel);
        self.at += 1;
        if self.at >= self.length() {
            self.sr |= DONE;
            self.at = 0;
            if self.cr[1] & CONTINUOUS == 0 {
                return;
            }
        }
        self.done_at = at + self.conversion_ns(channel_at(self.sqr, self.at), wires);
    }

    fn watch(&mut self, channel: u32) {
        let is_watched = self.cr[0] & WATCHES_ONE == 0 || self.cr[0] & 31 == channel;
        let is_outside = self.dr > self.threshold[0] || self.dr < self.threshold[1];
        if self.cr[0] & WATCHES != 0 && is_watched && is_outside {
            self.sr |= WATCHDOG;
        }
    }

    fn finish_injected(&mut self, wires: &Wires) {
        self.injected_at = NEVER;
        for (index, channel) in injected(self.jsqr).enumerate() {
            let value = self.sample(channel, wires);
            self.jdr[index] = value.wrapping_sub(self.jofr[index]) & 0xFFFF;
        }
        self.sr |= INJECTED_DONE | DONE;
    }

    fn control(&mut self, new: u32, wires: &Wires) {
        let was = self.cr[1];
        self.cr[1] = new & !(CALIBRATE | RESET_CALIBRATION | START | START_INJECTED);
        if new & DMA == 0 {
            self.asking = false;
        }
        if new & ON == 0 {
            (self.done_at, self.injected_at) = (NEVER, NEVER);
            self.asking = false;
            return;
        }
        if was & ON == 0 {
            return;
        }
        // ADON starts a conversion if it is set once more, and nothing else changes.
        let is_again = self.cr[1] == was && new & (CALIBRATE | RESET_CALIBRATION) == 0;
        let is_started = new & START != 0 && new & TRIGGERED != 0 && new >> 17 & 7 == SOFTWARE;
        if is_again && new & (START | START_INJECTED) == 0 || is_started {
            self.start(wires);
        }
        if new & START_INJECTED != 0 && new & INJECTED_TRIGGERED != 0 && new >> 12 & 7 == SOFTWARE {
            self.start_injected(wires);
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
        let waits = self.cr[1] & TRIGGERED != 0 && self.cr[1] >> 17 & 7 == TIM3;
        if waits && triggers >> 2 & 1 == 1 {
            self.start(wires);
        }
    }

    fn asks(&self) -> bool {
        self.asking
    }

    /// Conversions go on until the program ends them.
    fn dma_ended(&mut self) {}

    fn interrupts(&self) -> bool {
        let holds = |enable: u32, flag: u32| self.cr[0] & enable != 0 && self.sr & flag != 0;
        holds(DONE_INTERRUPTS, DONE)
            || holds(WATCHDOG_INTERRUPTS, WATCHDOG)
            || holds(INJECTED_INTERRUPTS, INJECTED_DONE)
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
}
