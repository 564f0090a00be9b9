//! The unit of STM32F4.

use super::unit::{
    self, AHB, APB, CAUSE_POWER, Rcc as _, SOURCES, with_causes, with_ready, with_switch,
};
use crate::wires::Clocks;

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

const READY: [(u32, u32); 5] = [(0, 1), (16, 17), (24, 25), (26, 27), (28, 29)];

/// The version of the block.
#[derive(Debug)]
pub(super) struct Version;

type Unit = unit::Unit<Version>;

impl Unit {
    /// The frequency before the last dividers of the PLL, which are the core's and the one of USB.
    fn pll_hz(&self) -> u64 {
        let pll = u64::from(self.read(PLLCFGR));
        let source = if pll >> 22 & 1 == 1 { self.crystal_hz } else { HSI_HZ };
        source * (pll >> 6 & 511) / (pll & 63).max(1)
    }
}

impl unit::Version for Version {
    const REGISTERS: usize = 36;
    const RESET: &'static [(u32, u32)] =
        &[(CR, 0x83), (PLLCFGR, 0x2400_3010), (0x30, 0x0010_0000), (0x84, 0x2000_3000)];
    const BDCR: u32 = BDCR;
    const CSR: u32 = CSR;
    /// A power-up also counts as a brown-out.
    const POWER_CAUSES: u32 = CAUSE_POWER | 1 << 25;
    const ENABLES: &'static [u32] = &[0x30, 0x34, 0x38, 0x40, 0x44];

    fn written(unit: &Unit, offset: u32, written: u32, was: u32) -> u32 {
        match offset {
            CR => with_ready(written, &READY),
            CFGR => with_switch(written, was, unit.read(CR), SOURCES),
            BDCR => with_ready(written, &[(0, 1)]),
            CSR => with_causes(written, was),
            _ => written,
        }
    }

    fn clocks(unit: &Unit) -> Clocks {
        let (cfgr, pll) = (unit.read(CFGR), u64::from(unit.read(PLLCFGR)));
        let system = match cfgr >> 2 & 3 {
            1 => unit.crystal_hz,
            2 => unit.pll_hz() / ((pll >> 16 & 3) * 2 + 2),
            _ => HSI_HZ,
        };
        let core = system / AHB[(cfgr >> 4 & 15) as usize];
        let (by1, by2) = (APB[(cfgr >> 10 & 7) as usize], APB[(cfgr >> 13 & 7) as usize]);
        // If TIMPRE is set, timers run at up to four times the speed of their bus.
        let fastest = if unit.read(DCKCFGR) & TIMPRE == 0 { 2 } else { 4 };
        let timers = |by: u64| if by < fastest { core } else { core / by * fastest };
        Clocks {
            core,
            apb1: core / by1,
            apb2: core / by2,
            timers1: timers(by1),
            timers2: timers(by2),
            // The converters have a divider of their own.
            adc: core / by2,
            usb: unit.pll_hz() / (pll >> 24 & 15).max(1),
            lsi: LSI_HZ,
        }
    }
}
