//! The unit of STM32F4.

use super::unit::{
    AHB, APB, CAUSE_PIN, CAUSE_SOFTWARE, CAUSE_WATCHDOG, CAUSES, Rcc, SOURCES, index, with_causes,
    with_ready, with_switch,
};
use crate::registers::merge;
use crate::wires::{Clocks, ResetCause};

/// The internal oscillators.
const HSI_HZ: u64 = 16_000_000;
const LSI_HZ: u64 = 32_000;

const CR: u32 = 0x00;
const PLLCFGR: u32 = 0x04;
const CFGR: u32 = 0x08;
const BDCR: u32 = 0x70;
const CSR: u32 = 0x74;
const DCKCFGR: u32 = 0x8C;
const TIMPRE: u32 = 1 << 24;
/// The enable registers, and how far the reset registers are below them.
const ENABLES: [u32; 5] = [0x30, 0x34, 0x38, 0x40, 0x44];
const RESETS_BELOW: u32 = 0x20;

const READY: [(u32, u32); 5] = [(0, 1), (16, 17), (24, 25), (26, 27), (28, 29)];
/// A power-up also counts as a brown-out.
const CAUSE_POWER: u32 = super::unit::CAUSE_POWER | 1 << 25;

/// The registers, by offset; the crystal is a property of the board.
#[derive(Debug)]
pub(super) struct Unit {
    registers: [u32; 36],
    crystal_hz: u64,
}

impl Unit {
    pub(super) fn new(crystal_hz: u64) -> Self {
        let mut unit = Self { registers: [0; 36], crystal_hz };
        unit.reset(ResetCause::Power);
        unit
    }

    /// The frequency before the last dividers of the PLL, which are the core's and the one of USB.
    fn pll_hz(&self) -> u64 {
        let pll = u64::from(self.read(PLLCFGR));
        let source = if pll >> 22 & 1 == 1 { self.crystal_hz } else { HSI_HZ };
        source * (pll >> 6 & 511) / (pll & 63).max(1)
    }
}

impl Rcc for Unit {
    fn reset(&mut self, cause: ResetCause) {
        let kept = [CSR, BDCR].map(|offset| self.read(offset));
        let [csr, bdcr] = if cause == ResetCause::Power { [0; 2] } else { kept };
        self.registers = [0; 36];
        self.registers[index(CR)] = 0x83;
        self.registers[index(PLLCFGR)] = 0x2400_3010;
        self.registers[index(0x30)] = 0x0010_0000;
        self.registers[index(0x84)] = 0x2000_3000;
        self.registers[index(BDCR)] = bdcr;
        let cause = match cause {
            ResetCause::Watchdog => CAUSE_WATCHDOG,
            ResetCause::Software => CAUSE_SOFTWARE,
            ResetCause::Power => CAUSE_POWER,
        };
        self.registers[index(CSR)] = csr | CAUSE_PIN | cause;
    }

    fn causes(&self) -> u32 {
        self.read(CSR) & CAUSES
    }

    fn read(&self, offset: u32) -> u32 {
        self.registers.get(index(offset)).copied().unwrap_or(0)
    }

    fn write(&mut self, offset: u32, value: u32, mask: u32) -> Option<(u32, u32)> {
        let old = self.read(offset);
        let written = merge(old, value, mask);
        let new = match offset {
            CR => with_ready(written, &READY),
            CFGR => with_switch(written, old, self.read(CR), SOURCES),
            BDCR => (written & !2) | (written & 1) << 1,
            CSR => with_causes(written, old),
            _ => written,
        };
        *self.registers.get_mut(index(offset))? = new;
        let enable = offset + RESETS_BELOW;
        ENABLES.contains(&enable).then_some((enable, new & !old))
    }

    fn enables(&self) -> &'static [u32] {
        &ENABLES
    }

    fn clocks(&self) -> Clocks {
        let (cfgr, pll) = (self.read(CFGR), u64::from(self.read(PLLCFGR)));
        let system = match cfgr >> 2 & 3 {
            1 => self.crystal_hz,
            2 => self.pll_hz() / ((pll >> 16 & 3) * 2 + 2),
            _ => HSI_HZ,
        };
        let core = system / AHB[(cfgr >> 4 & 15) as usize];
        let (by1, by2) = (APB[(cfgr >> 10 & 7) as usize], APB[(cfgr >> 13 & 7) as usize]);
        // If TIMPRE is set, timers run at up to four times the speed of their bus.
        let fastest = if self.read(DCKCFGR) & TIMPRE == 0 { 2 } else { 4 };
        let timers = |by: u64| if by < fastest { core } else { core / by * fastest };
        Clocks {
            core,
            apb1: core / by1,
            apb2: core / by2,
            timers1: timers(by1),
            timers2: timers(by2),
            // The converters have a divider of their own.
            adc: core / by2,
            usb: self.pll_hz() / (pll >> 24 & 15).max(1),
            lsi: LSI_HZ,
        }
    }
}
