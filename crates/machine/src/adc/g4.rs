//! The converters of STM32G4: switched on in steps, started by ADSTART, then by software or a timer's trigger; each
//! group shares a clock and a divider.
//!
//! Calibrations are over at once. Not modelled are injected sequences, oversampling, offsets and pairs of converters.

use super::unit::{Adc, code_of, input_mv};
use crate::registers::merge;
use crate::wires::{NEVER, Wires, periods_ns};

/// Bits of ISR, which IER has at the same places.
const READY: u32 = 1;
const SAMPLED: u32 = 1 << 1;
const DONE: u32 = 1 << 2;
const SEQUENCE_DONE: u32 = 1 << 3;
const OVERRUN: u32 = 1 << 4;
const WATCHDOG: u32 = 1 << 7;
/// Bits of CR.
const ON: u32 = 1;
const OFF: u32 = 1 << 1;
const START: u32 = 1 << 2;
const STOP: u32 = 1 << 4;
const REGULATOR: u32 = 1 << 28;
const POWER_DOWN: u32 = 1 << 29;
const CALIBRATE: u32 = 1 << 31;
/// The bits of CR that stay as they are written while the converter is off.
const SETTINGS: u32 = REGULATOR | POWER_DOWN | 1 << 30;
/// Bits of CFGR.
const DMA: u32 = 1;
const DMA_GOES_ON: u32 = 1 << 1;
const TRIGGERED: u32 = 3 << 10;
const OVERWRITES: u32 = 1 << 12;
const CONTINUOUS: u32 = 1 << 13;
const LEFT: u32 = 1 << 15;
const WATCHES_ONE: u32 = 1 << 22;
const WATCHES: u32 = 1 << 23;
/// Bits of CCR, which switch the inputs inside on.
const HAS_REFERENCE: u32 = 1 << 22;
const HAS_TEMPERATURE: u32 = 1 << 23;
const HAS_BATTERY: u32 = 1 << 24;

/// The half cycles of a sampling, by the code in SMPR.
const SAMPLING: [u64; 8] = [5, 13, 25, 49, 95, 185, 495, 1281];
/// The divider of the clock that is selected in the RCC, by the code in CCR.
const DIVIDERS: [u64; 16] = [1, 2, 4, 6, 8, 10, 12, 16, 32, 64, 128, 256, 256, 256, 256, 256];
/// The timers whose trigger output starts a sequence, by the code in EXTSEL; counted from 1. They are the same for all
/// converters.
const TRIGGERS: [(u32, u32); 9] =
    [(4, 3), (7, 8), (9, 1), (11, 2), (12, 4), (13, 6), (14, 15), (16, 20), (30, 7)];
/// The voltages at the inputs inside in millivolts: the temperature sensor at 25 degrees, the reference, a third of the
/// battery's.
const TEMPERATURE_MV: f64 = 747.5;
const REFERENCE_MV: f64 = 1212.0;
const BATTERY_MV: f64 = 1100.0;

/// A converter.
#[derive(Debug, Default)]
pub(super) struct Unit {
    unit: u8,
    name: String,
    isr: u32,
    ier: u32,
    cr: u32,
    cfgr: [u32; 2],
    smpr: [u32; 2],
    thresholds: [u32; 3],
    sqr: [u32; 4],
    other: [u32; 4],
    dr: u32,
    /// Whether DR holds a value that the DMA has to take and has not taken yet.
    asking: bool,
    /// The index of the present conversion in the sequence.
    at: u32,
    done_at: u64,
    /// The register that the group shares.
    ccr: u32,
}

impl Unit {
    pub(super) fn new(unit: u8) -> Self {
        Self {
            unit,
            name: format!("ADC{unit}"),
            cr: POWER_DOWN,
            cfgr: [1 << 31, 0],
            thresholds: [0x0FFF_0000, 0x00FF_0000, 0x00FF_0000],
            done_at: NEVER,
            ..Self::default()
        }
    }

    fn bits(&self) -> u64 {
        12 - 2 * u64::from(self.cfgr[0] >> 3 & 3)
    }

    /// The channel at a place of the sequence. The first register begins with the length.
    fn channel(&self, at: u32) -> u32 {
        let place = at + 1;
        self.sqr[(place / 5) as usize & 3] >> (6 * (place % 5)) & 31
    }

    fn clock_hz(&self, wires: &Wires) -> u64 {
        let hz = match self.ccr >> 16 & 3 {
            0 => {
                let selected = wires.kernel_hz(&self.name).unwrap_or(0);
                selected / DIVIDERS[(self.ccr >> 18 & 15) as usize]
            }
            by => wires.clocks.adc >> (by - 1),
        };
        hz.max(1)
    }

    fn conversion_ns(&self, channel: u32, wires: &Wires) -> u64 {
        let code = self.smpr[(channel / 10).min(1) as usize] >> (3 * (channel % 10)) & 7;
        let half_cycles = SAMPLING[code as usize] + 2 * self.bits() + 1;
        periods_ns(half_cycles, 2 * self.clock_hz(wires)).max(1)
    }

    fn sample(&self, channel: u32, wires: &Wires) -> u32 {
        let has = |bit: u32| self.ccr & bit != 0;
        let millivolts = match (self.unit, channel) {
            (1, 16) | (5, 4) if has(HAS_TEMPERATURE) => TEMPERATURE_MV,
            (1 | 3 | 5, 17) if has(HAS_BATTERY) => BATTERY_MV,
            (1 | 3 | 4 | 5, 18) if has(HAS_REFERENCE) => REFERENCE_MV,
            _ => input_mv(self.unit, channel, wires),
        };
        let code = code_of(millivolts, self.bits());
        if self.cfgr[0] & LEFT != 0 { code << (16 - self.bits()) } else { code }
    }

    /// Starts a sequence, unless one is under way.
    fn start(&mut self, wires: &Wires) {
        if self.done_at == NEVER {
            self.at = 0;
            self.done_at = wires.now + self.conversion_ns(self.channel(0), wires);
        }
    }

    fn stop(&mut self) {
        self.cr &= !(START | STOP);
        self.done_at = NEVER;
        self.asking = false;
    }

    fn finish(&mut self, wires: &Wires) {
        let at = self.done_at;
        self.done_at = NEVER;
        let channel = self.channel(self.at);
        self.keep(self.sample(channel, wires), channel);
        self.at += 1;
        if self.at > self.sqr[0] & 15 {
            self.isr |= SEQUENCE_DONE;
            self.at = 0;
            if self.cfgr[0] & CONTINUOUS == 0 {
                if self.cfgr[0] & TRIGGERED == 0 {
                    self.cr &= !START;
                }
                return;
            }
        }
        self.done_at = at + self.conversion_ns(self.channel(self.at), wires);
    }

    /// Puts a sample into DR. If nobody has taken the last one, this one is lost, unless it is to replace that.
    fn keep(&mut self, sample: u32, channel: u32) {
        let is_late = self.isr & DONE != 0;
        if is_late {
            self.isr |= OVERRUN;
        }
        self.isr |= SAMPLED | DONE;
        self.watch(sample, channel);
        if is_late && self.cfgr[0] & OVERWRITES == 0 {
            self.asking = false;
            return;
        }
        self.dr = sample;
        self.asking = self.cfgr[0] & DMA != 0 && self.isr & OVERRUN == 0;
    }

    fn watch(&mut self, sample: u32, channel: u32) {
        let is_watched = self.cfgr[0] & WATCHES_ONE == 0 || self.cfgr[0] >> 26 & 31 == channel;
        let [limits, ..] = self.thresholds;
        let is_outside = sample > limits >> 16 & 0xFFF || sample < limits & 0xFFF;
        if self.cfgr[0] & WATCHES != 0 && is_watched && is_outside {
            self.isr |= WATCHDOG;
        }
    }

    /// Writes CR. Most bits are commands: the program sets them, and the converter clears them.
    fn control(&mut self, new: u32, wires: &Wires) {
        if self.cr & ON == 0 {
            self.cr = new & SETTINGS;
            let has_power = self.cr & (REGULATOR | POWER_DOWN) == REGULATOR;
            if new & ON != 0 && new & CALIBRATE == 0 && has_power {
                self.cr |= ON;
                self.isr |= READY;
            }
            return;
        }
        if new & STOP != 0 {
            self.stop();
        }
        if new & OFF != 0 && self.cr & START == 0 {
            self.cr &= !ON;
            self.isr &= !READY;
        } else if new & START != 0 && new & STOP == 0 && self.cr & START == 0 {
            self.cr |= START;
            if self.cfgr[0] & TRIGGERED == 0 {
                self.start(wires);
            }
        }
    }

    /// A register that holds what is written to it.
    fn setting(&mut self, offset: u32) -> Option<&mut u32> {
        Some(match offset {
            0x04 => &mut self.ier,
            0x0C | 0x10 => &mut self.cfgr[((offset - 0x0C) / 4) as usize],
            0x14 | 0x18 => &mut self.smpr[((offset - 0x14) / 4) as usize],
            0x20..=0x28 => &mut self.thresholds[((offset - 0x20) / 4) as usize],
            0x30..=0x3C => &mut self.sqr[((offset - 0x30) / 4) as usize],
            0xA0 | 0xA4 => &mut self.other[((offset - 0xA0) / 4) as usize],
            0xB0 | 0xB4 => &mut self.other[((offset - 0xA8) / 4) as usize],
            _ => return None,
        })
    }
}

impl Adc for Unit {
    fn deadline(&self) -> u64 {
        self.done_at
    }

    fn advance(&mut self, wires: &Wires) {
        if self.done_at <= wires.now {
            self.finish(wires);
        }
    }

    fn trigger(&mut self, triggers: u32, wires: &Wires) {
        let selected = self.cfgr[0] >> 5 & 31;
        let timer = TRIGGERS.iter().find(|(code, _)| *code == selected);
        let has_come = timer.is_some_and(|(_, timer)| triggers >> (timer - 1) & 1 == 1);
        if has_come && self.cr & START != 0 && self.cfgr[0] & TRIGGERED != 0 {
            self.start(wires);
        }
    }

    fn asks(&self) -> bool {
        self.asking
    }

    /// After the last item of a single run, conversions end, although START stays.
    fn dma_ended(&mut self) {
        if self.cfgr[0] & DMA_GOES_ON == 0 {
            self.done_at = NEVER;
        }
    }

    fn interrupts(&self) -> bool {
        self.isr & self.ier & 0x7FF != 0
    }

    fn status(&self) -> u32 {
        self.isr & 0x7FF
    }

    fn share(&mut self, ccr: u32) {
        self.ccr = ccr;
    }

    fn read(&mut self, offset: u32) -> u32 {
        match offset {
            0x00 => self.isr,
            0x08 => self.cr,
            0x40 => {
                self.isr &= !DONE;
                self.asking = false;
                self.dr
            }
            _ => self.setting(offset).map_or(0, |register| *register),
        }
    }

    fn write(&mut self, offset: u32, value: u32, mask: u32, wires: &Wires) {
        match offset {
            0x00 => self.isr &= !(value & mask),
            0x08 => self.control(merge(self.cr, value, mask), wires),
            _ => {
                if let Some(register) = self.setting(offset) {
                    *register = merge(*register, value, mask);
                }
            }
        }
    }
}
