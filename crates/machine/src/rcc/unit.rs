//! What the versions of the unit have in common.
//!
//! In: values that are written to registers, resets, and what a version does in its own way. Out: what the registers
//! hold then, and what the chip asks of the unit, as a trait.

use std::marker::PhantomData;

use crate::registers::merge;
use crate::wires::{Clocks, ResetCause};

/// The unit, in one of its versions.
pub(crate) trait Rcc: Send {
    /// Restarts it in its state after a reset. Earlier causes stay until the program clears them, or until power is
    /// lost, which also clears the backup domain.
    fn reset(&mut self, cause: ResetCause);
    /// The causes of resets, as bits 25 to 31 of CSR.
    fn causes(&self) -> u32;
    fn read(&self, offset: u32) -> u32;
    /// Writes a register; returns the peripherals that this holds in reset, by their bits in the enable register at an
    /// offset.
    fn write(&mut self, offset: u32, value: u32, mask: u32) -> Option<(u32, u32)>;
    /// The offsets of the enable registers.
    fn enables(&self) -> &'static [u32];
    fn clocks(&self) -> Clocks;

    /// The frequency of a clock that units can select, by its name in the MCU's file.
    fn named_hz(&self, _: &str) -> u64 {
        0
    }

    /// Whether the peripheral that belongs to a bit of an enable register has its clock.
    fn is_enabled(&self, offset: u32, bit: u32) -> bool {
        self.read(offset) >> bit & 1 == 1
    }
}

/// What a version does in its own way.
pub(super) trait Version: Sized + Send {
    /// The number of registers.
    const REGISTERS: usize;
    /// The registers that are not 0 after a reset.
    const RESET: &'static [(u32, u32)];
    const BDCR: u32;
    const CSR: u32;
    /// The causes that a power-up counts as, besides the reset pin.
    const POWER_CAUSES: u32 = CAUSE_POWER;
    const ENABLES: &'static [u32];

    /// What a register holds after a write.
    fn written(unit: &Unit<Self>, offset: u32, written: u32, was: u32) -> u32;
    fn clocks(unit: &Unit<Self>) -> Clocks;

    /// The enable register of the peripherals that a reset register holds in reset.
    fn enable_of(reset: u32) -> Option<u32> {
        let enable = reset + 0x20;
        Self::ENABLES.contains(&enable).then_some(enable)
    }

    fn named_hz(_: &Unit<Self>, _: &str) -> u64 {
        0
    }
}

/// The registers of a version, by offset; the crystal is a property of the board.
#[derive(Debug)]
pub(super) struct Unit<V> {
    registers: Vec<u32>,
    pub crystal_hz: u64,
    version: PhantomData<V>,
}

impl<V: Version> Unit<V> {
    pub(super) fn new(crystal_hz: u64) -> Self {
        let registers = vec![0; V::REGISTERS];
        let mut unit = Self { registers, crystal_hz, version: PhantomData };
        unit.reset(ResetCause::Power);
        unit
    }
}

impl<V: Version> Rcc for Unit<V> {
    fn reset(&mut self, cause: ResetCause) {
        let kept = [V::CSR, V::BDCR].map(|offset| self.read(offset));
        let [csr, bdcr] = if cause == ResetCause::Power { [0; 2] } else { kept };
        let cause = match cause {
            ResetCause::Watchdog => CAUSE_WATCHDOG,
            ResetCause::Software => CAUSE_SOFTWARE,
            ResetCause::Power => V::POWER_CAUSES,
        };
        self.registers.fill(0);
        let others = [(V::BDCR, bdcr), (V::CSR, csr | CAUSE_PIN | cause)];
        for (offset, value) in V::RESET.iter().copied().chain(others) {
            self.registers[index(offset)] = value;
        }
    }

    fn causes(&self) -> u32 {
        self.read(V::CSR) & CAUSES
    }

    fn read(&self, offset: u32) -> u32 {
        self.registers.get(index(offset)).copied().unwrap_or(0)
    }

    fn write(&mut self, offset: u32, value: u32, mask: u32) -> Option<(u32, u32)> {
        let old = self.read(offset);
        let new = V::written(self, offset, merge(old, value, mask), old);
        *self.registers.get_mut(index(offset))? = new;
        Some((V::enable_of(offset)?, new & !old))
    }

    fn enables(&self) -> &'static [u32] {
        V::ENABLES
    }

    fn clocks(&self) -> Clocks {
        V::clocks(self)
    }

    fn named_hz(&self, clock: &str) -> u64 {
        V::named_hz(self, clock)
    }
}

/// The bits of CSR that the versions have in common: causes of resets, and the bit that clears them.
pub(super) const CLEAR: u32 = 1 << 24;
pub(super) const CAUSES: u32 = 0xFE00_0000;
pub(super) const CAUSE_PIN: u32 = 1 << 26;
pub(super) const CAUSE_POWER: u32 = 1 << 27;
pub(super) const CAUSE_SOFTWARE: u32 = 1 << 28;
pub(super) const CAUSE_WATCHDOG: u32 = 1 << 29;

/// The divider of the core's clock, by the code in HPRE, and those of the buses, by the codes in PPRE1 and PPRE2.
pub(super) const AHB: [u64; 16] = [1, 1, 1, 1, 1, 1, 1, 1, 2, 4, 8, 16, 64, 128, 256, 512];
pub(super) const APB: [u64; 8] = [1, 1, 1, 1, 2, 4, 8, 16];

/// CR after a write: what is switched on is ready. Each pair is the bit that switches an oscillator or a PLL on, and
/// the bit that reports it ready.
pub(super) fn with_ready(written: u32, pairs: &[(u32, u32)]) -> u32 {
    pairs
        .iter()
        .fold(written, |all, (on, ready)| (all & !(1 << ready)) | (written >> on & 1) << ready)
}

/// The bits of CR that report HSI, HSE and PLL ready, by their code in CFGR.
pub(super) const SOURCES: [u32; 4] = [1, 17, 25, u32::MAX];

/// CFGR after a write: the switch follows the selection once the oscillator runs.
pub(super) fn with_switch(written: u32, was: u32, cr: u32, sources: [u32; 4]) -> u32 {
    let ready = sources[(written & 3) as usize];
    let is_ready = cr.checked_shr(ready).is_some_and(|cr| cr & 1 == 1);
    let status = if is_ready { written & 3 } else { was >> 2 & 3 };
    (written & !0xC) | status << 2
}

/// CSR after a write: only the LSI's switch and the bit that clears causes have an effect.
pub(super) fn with_causes(written: u32, was: u32) -> u32 {
    let causes = if written & CLEAR == 0 { was & CAUSES } else { 0 };
    causes | (written & 1) | (written & 1) << 1
}

fn index(offset: u32) -> usize {
    (offset / 4) as usize
}
