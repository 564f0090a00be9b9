//! The unit of STM32F1 without a connectivity line.

use super::unit::{self, AHB, APB, Rcc as _, SOURCES, with_causes, with_ready, with_switch};
use crate::wires::Clocks;

/// The internal oscillators.
const HSI_HZ: u64 = 8_000_000;
const LSI_HZ: u64 = 40_000;

const CR: u32 = 0x00;
const CFGR: u32 = 0x04;
const APB2RSTR: u32 = 0x0C;
const APB1RSTR: u32 = 0x10;
const AHBENR: u32 = 0x14;
const APB2ENR: u32 = 0x18;
const APB1ENR: u32 = 0x1C;
const BDCR: u32 = 0x20;
const CSR: u32 = 0x24;

const READY: [(u32, u32); 3] = [(0, 1), (16, 17), (24, 25)];
/// Bits of CFGR: the PLL takes the crystal, which is halved before.
const PLL_OF_CRYSTAL: u32 = 1 << 16;
const CRYSTAL_BY_2: u32 = 1 << 17;
/// The USB unit has the PLL's clock as it is, and not two thirds of it.
const USB_WHOLE: u32 = 1 << 22;

/// The version of the block.
#[derive(Debug)]
pub(super) struct Version;

type Unit = unit::Unit<Version>;

impl Unit {
    fn pll_hz(&self) -> u64 {
        let cfgr = self.read(CFGR);
        let by = if cfgr & CRYSTAL_BY_2 == 0 { 1 } else { 2 };
        let source = if cfgr & PLL_OF_CRYSTAL == 0 { HSI_HZ / 2 } else { self.crystal_hz / by };
        // The highest two codes are the same.
        source * u64::from((cfgr >> 18 & 15).min(14) + 2)
    }
}

impl unit::Version for Version {
    const REGISTERS: usize = 10;
    /// The flash's interface and the SRAM have clocks.
    const RESET: &'static [(u32, u32)] = &[(CR, 0x83), (AHBENR, 0x14)];
    const BDCR: u32 = BDCR;
    const CSR: u32 = CSR;
    const ENABLES: &'static [u32] = &[AHBENR, APB2ENR, APB1ENR];

    fn written(unit: &Unit, offset: u32, written: u32, was: u32) -> u32 {
        match offset {
            CR => with_ready(written, &READY),
            CFGR => with_switch(written, was, unit.read(CR), SOURCES),
            BDCR => with_ready(written, &[(0, 1)]),
            CSR => with_causes(written, was),
            _ => written,
        }
    }

    fn enable_of(reset: u32) -> Option<u32> {
        match reset {
            APB2RSTR => Some(APB2ENR),
            APB1RSTR => Some(APB1ENR),
            _ => None,
        }
    }

    fn clocks(unit: &Unit) -> Clocks {
        let cfgr = unit.read(CFGR);
        let system = match cfgr >> 2 & 3 {
            1 => unit.crystal_hz,
            2 => unit.pll_hz(),
            _ => HSI_HZ,
        };
        let core = system / AHB[(cfgr >> 4 & 15) as usize];
        let (by1, by2) = (APB[(cfgr >> 8 & 7) as usize], APB[(cfgr >> 11 & 7) as usize]);
        let timers = |by: u64| if by == 1 { core } else { core / by * 2 };
        let pll_hz = if unit.read(CR) >> 25 & 1 == 1 { unit.pll_hz() } else { 0 };
        Clocks {
            core,
            apb1: core / by1,
            apb2: core / by2,
            timers1: timers(by1),
            timers2: timers(by2),
            adc: core / by2 / (u64::from(cfgr >> 14 & 3) * 2 + 2),
            usb: if cfgr & USB_WHOLE == 0 { pll_hz * 2 / 3 } else { pll_hz },
            lsi: LSI_HZ,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rcc::unit::{CAUSE_PIN, CAUSE_POWER, CAUSE_WATCHDOG};
    use crate::wires::ResetCause;

    #[test]
    fn the_clock_tree_is_what_the_registers_say() {
        let mut rcc = Unit::new(8_000_000);
        assert_eq!((rcc.clocks().core, rcc.clocks().usb), (8_000_000, 0));
        // HSE by 9, APB1 by 2, APB2 as it is, ADC by 6, USB by 1.5.
        let cfgr = 2 | 4 << 8 | 2 << 14 | PLL_OF_CRYSTAL | 7 << 18;
        rcc.write(CFGR, cfgr, u32::MAX);
        rcc.write(CR, 1 | 1 << 16, u32::MAX);
        // The PLL is still off, so the switch does not follow.
        assert_eq!(rcc.read(CFGR) >> 2 & 3, 0);
        rcc.write(CR, 1 | 1 << 16 | 1 << 24, u32::MAX);
        rcc.write(CFGR, cfgr, u32::MAX);
        let found = rcc.clocks();
        assert_eq!([found.core, found.apb1, found.apb2], [72_000_000, 36_000_000, 72_000_000]);
        assert_eq!([found.timers1, found.timers2], [72_000_000; 2]);
        assert_eq!([found.adc, found.usb, found.lsi], [12_000_000, 48_000_000, 40_000]);
        // The internal oscillator is halved: by 12, it is the 48 MHz that the USB unit takes as they are.
        rcc.write(CFGR, 2 | 10 << 18 | USB_WHOLE, u32::MAX);
        assert_eq!((rcc.clocks().core, rcc.clocks().usb), (48_000_000, 48_000_000));
    }

    #[test]
    fn resets_are_noted_and_name_the_enable_register() {
        let mut rcc = Unit::new(8_000_000);
        assert_eq!(rcc.causes(), CAUSE_POWER | CAUSE_PIN);
        rcc.write(CSR, 1 << 24, u32::MAX);
        rcc.write(BDCR, 1, u32::MAX);
        rcc.reset(ResetCause::Watchdog);
        assert_eq!((rcc.causes(), rcc.read(BDCR)), (CAUSE_WATCHDOG | CAUSE_PIN, 3));
        // USB and CAN.
        assert_eq!(rcc.write(APB1RSTR, 1 << 23, u32::MAX), Some((APB1ENR, 1 << 23)));
        assert_eq!(rcc.write(APB1RSTR, 0, u32::MAX), Some((APB1ENR, 0)));
        assert_eq!(rcc.write(APB2ENR, 4, u32::MAX), None);
        assert!(rcc.is_enabled(APB2ENR, 2) && !rcc.is_enabled(APB2ENR, 3));
    }
}
