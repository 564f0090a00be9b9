//! What the versions of the converter before STM32G4 have in common: registers, sequences, the watchdog.
//!
//! In: accesses of the program, voltages, and what a version does in its own way. Out: samples, requests to the DMA,
//! interrupts.

use super::unit::{Adc, code_of};
use crate::registers::merge;
use crate::wires::{NEVER, Wires};

/// Bits of SR.
const WATCHDOG: u32 = 1;
pub(super) const DONE: u32 = 1 << 1;
pub(super) const INJECTED_DONE: u32 = 1 << 2;
const INJECTED_STARTED: u32 = 1 << 3;
const STARTED: u32 = 1 << 4;
pub(super) const OVERRUN: u32 = 1 << 5;
/// Bits of CR1 that enable interrupts, and the bits of SR that cause them.
const INTERRUPTS: [(u32, u32); 4] =
    [(1 << 5, DONE), (1 << 6, WATCHDOG), (1 << 7, INJECTED_DONE), (1 << 26, OVERRUN)];
/// Other bits of CR1.
const SCAN: u32 = 1 << 8;
const WATCHES_ONE: u32 = 1 << 9;
const WATCHES: u32 = 1 << 23;
/// Bits of CR2.
pub(super) const ON: u32 = 1;
pub(super) const CONTINUOUS: u32 = 1 << 1;
pub(super) const DMA: u32 = 1 << 8;
const LEFT: u32 = 1 << 11;

/// A converter.
#[derive(Debug, Default)]
pub(super) struct Unit<V> {
    pub unit: u8,
    /// What only this version has.
    pub version: V,
    pub sr: u32,
    pub cr: [u32; 2],
    smpr: [u32; 2],
    jofr: [u32; 4],
    threshold: [u32; 2],
    sqr: [u32; 3],
    jsqr: u32,
    jdr: [u32; 4],
    pub dr: u32,
    /// Whether DR holds a value that the DMA has to take and has not taken yet.
    pub asking: bool,
    /// The index of the present conversion in the sequence.
    pub at: u32,
    pub done_at: u64,
    injected_at: u64,
}

/// What a version does in its own way.
pub(super) trait Version: Default + Send {
    /// The bits of SR that an injected sequence sets at its end.
    const INJECTED_ENDS: u32;

    /// The bits of a sample.
    fn bits(unit: &Unit<Self>) -> u64;
    fn millivolts(unit: &Unit<Self>, channel: u32, wires: &Wires) -> f64;
    /// The time of a conversion with its sampling, for the code in SMPR.
    fn conversion_ns(unit: &Unit<Self>, sampling: usize, wires: &Wires) -> u64;
    /// Ends the present conversion, and begins the next one.
    fn finish(unit: &mut Unit<Self>, wires: &Wires);
    /// Writes CR2.
    fn control(unit: &mut Unit<Self>, new: u32, wires: &Wires);
    fn trigger(unit: &mut Unit<Self>, triggers: u32, wires: &Wires);
    fn dma_ended(unit: &mut Unit<Self>);

    fn status(_: &Unit<Self>) -> u32 {
        0
    }

    fn share(&mut self, _: u32) {}
}

impl<V: Version> Unit<V> {
    pub(super) fn new(unit: u8) -> Self {
        Self { unit, threshold: [0xFFF, 0], done_at: NEVER, injected_at: NEVER, ..Self::default() }
    }

    /// The length of the regular sequence.
    pub(super) fn length(&self) -> u32 {
        if self.cr[0] & SCAN != 0 { (self.sqr[0] >> 20 & 15) + 1 } else { 1 }
    }

    /// The channel of the present conversion, from SQR1 to SQR3.
    pub(super) fn channel(&self) -> u32 {
        match self.at {
            at @ 0..=5 => self.sqr[2] >> (5 * at) & 31,
            at @ 6..=11 => self.sqr[1] >> (5 * (at - 6)) & 31,
            at => self.sqr[0] >> (5 * (at - 12)) & 31,
        }
    }

    /// The channels of the injected sequence, from JSQR.
    fn injected(&self) -> impl Iterator<Item = u32> + use<V> {
        let jsqr = self.jsqr;
        let length = (jsqr >> 20 & 3) + 1;
        (0..length).map(move |index| jsqr >> (5 * (4 - length + index)) & 31)
    }

    /// The time of a conversion, whose sampling time has a code in SMPR1 or SMPR2.
    fn conversion_ns(&self, channel: u32, wires: &Wires) -> u64 {
        let code = match channel {
            0..=9 => self.smpr[1] >> (3 * channel) & 7,
            _ => self.smpr[0] >> (3 * (channel.min(18) - 10)) & 7,
        };
        V::conversion_ns(self, code as usize, wires)
    }

    pub(super) fn sample(&self, channel: u32, wires: &Wires) -> u32 {
        let bits = V::bits(self);
        let code = code_of(V::millivolts(self, channel, wires), bits);
        if self.cr[1] & LEFT != 0 { code << (16 - bits) } else { code }
    }

    /// Starts the sequence, unless it is under way.
    pub(super) fn start(&mut self, wires: &Wires) {
        if self.cr[1] & ON != 0 && self.done_at == NEVER {
            self.at = 0;
            self.sr |= STARTED;
            self.go_on(wires.now, wires);
        }
    }

    /// Begins the present conversion.
    pub(super) fn go_on(&mut self, at: u64, wires: &Wires) {
        self.done_at = at + self.conversion_ns(self.channel(), wires);
    }

    pub(super) fn stop(&mut self) {
        (self.done_at, self.injected_at) = (NEVER, NEVER);
        self.asking = false;
    }

    pub(super) fn start_injected(&mut self, wires: &Wires) {
        self.sr |= INJECTED_STARTED;
        let times = self.injected().map(|channel| self.conversion_ns(channel, wires));
        self.injected_at = wires.now + times.sum::<u64>();
    }

    fn finish_injected(&mut self, wires: &Wires) {
        self.injected_at = NEVER;
        for (index, channel) in self.injected().enumerate() {
            let value = self.sample(channel, wires);
            self.jdr[index] = value.wrapping_sub(self.jofr[index]) & 0xFFFF;
        }
        self.sr |= V::INJECTED_ENDS;
    }

    /// Compares a sample of the regular sequence with the thresholds.
    pub(super) fn watch(&mut self, channel: u32) {
        let is_watched = self.cr[0] & WATCHES_ONE == 0 || self.cr[0] & 31 == channel;
        let is_outside = self.dr > self.threshold[0] || self.dr < self.threshold[1];
        if self.cr[0] & WATCHES != 0 && is_watched && is_outside {
            self.sr |= WATCHDOG;
        }
    }

    /// A register that holds what is written to it.
    fn setting(&mut self, offset: u32) -> Option<&mut u32> {
        Some(match offset {
            0x04 => &mut self.cr[0],
            0x0C | 0x10 => &mut self.smpr[((offset - 0x0C) / 4) as usize],
            0x14..=0x20 => &mut self.jofr[((offset - 0x14) / 4) as usize],
            0x24 | 0x28 => &mut self.threshold[((offset - 0x24) / 4) as usize],
            0x2C..=0x34 => &mut self.sqr[((offset - 0x2C) / 4) as usize],
            0x38 => &mut self.jsqr,
            _ => return None,
        })
    }
}

impl<V: Version> Adc for Unit<V> {
    fn deadline(&self) -> u64 {
        self.done_at.min(self.injected_at)
    }

    fn advance(&mut self, wires: &Wires) {
        if self.injected_at <= wires.now {
            self.finish_injected(wires);
        }
        if self.done_at <= wires.now {
            V::finish(self, wires);
        }
    }

    fn trigger(&mut self, triggers: u32, wires: &Wires) {
        V::trigger(self, triggers, wires);
    }

    fn asks(&self) -> bool {
        self.asking
    }

    fn dma_ended(&mut self) {
        V::dma_ended(self);
    }

    fn interrupts(&self) -> bool {
        INTERRUPTS.iter().any(|(enable, flag)| self.cr[0] & enable != 0 && self.sr & flag != 0)
    }

    fn status(&self) -> u32 {
        V::status(self)
    }

    fn share(&mut self, ccr: u32) {
        self.version.share(ccr);
    }

    fn read(&mut self, offset: u32) -> u32 {
        match offset {
            0x00 => self.sr,
            0x08 => self.cr[1],
            0x3C..=0x48 => self.jdr[((offset - 0x3C) / 4) as usize],
            0x4C => {
                self.sr &= !DONE;
                self.asking = false;
                self.dr
            }
            _ => self.setting(offset).map_or(0, |register| *register),
        }
    }

    fn write(&mut self, offset: u32, value: u32, mask: u32, wires: &Wires) {
        match offset {
            0x00 => self.sr &= value | !mask,
            0x08 => V::control(self, merge(self.cr[1], value, mask), wires),
            _ => {
                if let Some(register) = self.setting(offset) {
                    *register = merge(*register, value, mask);
                }
            }
        }
    }
}
