//! The unit of STM32G4: the core's clock comes from one PLL, and units select among several clocks (CCIPR).

use super::unit::{self, AHB, APB, CAUSES, Rcc as _, with_ready, with_switch};
use crate::wires::Clocks;

/// The internal oscillators, and the crystal of a clock.
const HSI_HZ: u64 = 16_000_000;
const HSI48_HZ: u64 = 48_000_000;
const LSI_HZ: u64 = 32_000;
const LSE_HZ: u64 = 32_768;

const CR: u32 = 0x00;
const CFGR: u32 = 0x08;
const PLLCFGR: u32 = 0x0C;
const CCIPR: u32 = 0x88;
const BDCR: u32 = 0x90;
const CSR: u32 = 0x94;
const CRRCR: u32 = 0x98;

const READY: [(u32, u32); 3] = [(8, 10), (16, 17), (24, 25)];
/// The bits of CR that report the sources ready, by their code in CFGR; code 0 has none.
const SOURCES: [u32; 4] = [u32::MAX, 10, 17, 25];
/// The bit of CSR that clears the causes of resets.
const CLEAR: u32 = 1 << 23;

/// The version of the block.
#[derive(Debug)]
pub(super) struct Version;

type Unit = unit::Unit<Version>;

impl Unit {
    /// The frequency before the last dividers of the PLL; 0 if it is off.
    fn pll_hz(&self) -> u64 {
        let pll = u64::from(self.read(PLLCFGR));
        let source = match pll & 3 {
            2 => HSI_HZ,
            3 => self.crystal_hz,
            _ => 0,
        };
        let is_on = self.read(CR) >> 25 & 1 == 1;
        if is_on { source / ((pll >> 4 & 15) + 1) * (pll >> 8 & 127) } else { 0 }
    }

    /// The outputs P, Q and R of the PLL.
    fn outputs(&self) -> [u64; 3] {
        let pll = self.read(PLLCFGR);
        let by = |shift: u32| u64::from(pll >> shift & 3) * 2 + 2;
        let by_p = match (pll >> 27, pll >> 17 & 1) {
            (0, 0) => 7,
            (0, _) => 17,
            (by, _) => u64::from(by),
        };
        let outputs = [(16, by_p), (20, by(21)), (24, by(25))];
        outputs.map(|(enable, by)| if pll >> enable & 1 == 1 { self.pll_hz() / by } else { 0 })
    }

    fn system_hz(&self) -> u64 {
        match self.read(CFGR) >> 2 & 3 {
            2 => self.crystal_hz,
            3 => self.outputs()[2],
            _ => HSI_HZ,
        }
    }
}

impl unit::Version for Version {
    const REGISTERS: usize = 40;
    const RESET: &'static [(u32, u32)] =
        &[(CR, 0x500), (CFGR, 5), (PLLCFGR, 0x1000), (0x48, 0x100)];
    const BDCR: u32 = BDCR;
    const CSR: u32 = CSR;
    const ENABLES: &'static [u32] = &[0x48, 0x4C, 0x50, 0x58, 0x5C, 0x60];

    fn written(unit: &Unit, offset: u32, written: u32, was: u32) -> u32 {
        match offset {
            CR => with_ready(written, &READY),
            CFGR => with_switch(written, was, unit.read(CR), SOURCES),
            BDCR | CRRCR => with_ready(written, &[(0, 1)]),
            CSR => {
                let causes = if written & CLEAR == 0 { was & CAUSES } else { 0 };
                with_ready(causes | written & 1, &[(0, 1)])
            }
            _ => written,
        }
    }

    fn clocks(unit: &Unit) -> Clocks {
        let cfgr = unit.read(CFGR);
        let core = unit.system_hz() / AHB[(cfgr >> 4 & 15) as usize];
        let (by1, by2) = (APB[(cfgr >> 8 & 7) as usize], APB[(cfgr >> 11 & 7) as usize]);
        let timers = |by: u64| if by == 1 { core } else { core / by * 2 };
        let has_hsi48 = unit.read(CRRCR) >> 1 & 1 == 1;
        Clocks {
            core: core.max(1),
            apb1: core / by1,
            apb2: core / by2,
            timers1: timers(by1),
            timers2: timers(by2),
            // The converters have a divider of their own.
            adc: core,
            usb: match unit.read(CCIPR) >> 26 & 3 {
                0 if has_hsi48 => HSI48_HZ,
                2 => unit.outputs()[1],
                _ => 0,
            },
            lsi: LSI_HZ,
        }
    }

    fn named_hz(unit: &Unit, clock: &str) -> u64 {
        let clocks = Self::clocks(unit);
        match clock {
            "PCLK1" => clocks.apb1,
            "PCLK2" => clocks.apb2,
            "SYS" => unit.system_hz(),
            "HSI" => HSI_HZ,
            "HSE" => unit.crystal_hz,
            "LSE" => LSE_HZ,
            "PLL1_P" => unit.outputs()[0],
            "PLL1_Q" => unit.outputs()[1],
            _ => 0,
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
        let mut rcc = Unit::new(24_000_000);
        assert_eq!((rcc.clocks().core, rcc.clocks().usb), (16_000_000, 0));
        // HSE by 6, times 85: R by 2, Q by 8, P by 10.
        let pll = 3 | 5 << 4 | 85 << 8 | 1 << 16 | 1 << 20 | 3 << 21 | 1 << 24 | 10 << 27;
        rcc.write(PLLCFGR, pll, u32::MAX);
        rcc.write(CFGR, 3 | 4 << 8, u32::MAX);
        // The PLL is still off, so the switch did not follow.
        assert_eq!(rcc.read(CFGR) >> 2 & 3, 1);
        rcc.write(CR, 1 << 8 | 1 << 16 | 1 << 24, u32::MAX);
        rcc.write(CFGR, 3 | 4 << 8, u32::MAX);
        let found = rcc.clocks();
        assert_eq!([found.core, found.apb1, found.apb2], [170_000_000, 85_000_000, 170_000_000]);
        assert_eq!([found.timers1, found.timers2], [170_000_000; 2]);
        let named =
            ["PCLK1", "SYS", "HSI", "HSE", "PLL1_P", "PLL1_Q"].map(|name| rcc.named_hz(name));
        assert_eq!(
            named,
            [85, 170, 16, 24, 34, 42]
                .map(|mhz: u64| mhz * 1_000_000 + if mhz == 42 { 500_000 } else { 0 })
        );
        rcc.write(CRRCR, 1, u32::MAX);
        assert_eq!((rcc.read(CRRCR), rcc.clocks().usb), (3, 48_000_000));
        rcc.write(CCIPR, 2 << 26, u32::MAX);
        assert_eq!(rcc.clocks().usb, 42_500_000);
    }

    #[test]
    fn resets_are_noted_and_name_the_enable_register() {
        let mut rcc = Unit::new(24_000_000);
        assert_eq!(rcc.causes(), CAUSE_POWER | CAUSE_PIN);
        // The bit that clears causes in other families is not this one's.
        rcc.write(CSR, 1 << 24, u32::MAX);
        assert_eq!(rcc.causes(), CAUSE_POWER | CAUSE_PIN);
        rcc.write(CSR, CLEAR | 1, u32::MAX);
        assert_eq!(rcc.read(CSR), 3);
        rcc.reset(ResetCause::Watchdog);
        assert_eq!(rcc.causes(), CAUSE_WATCHDOG | CAUSE_PIN);
        // ADC12.
        assert_eq!(rcc.write(0x2C, 1 << 13, u32::MAX), Some((0x4C, 1 << 13)));
        assert_eq!(rcc.write(0x4C, 1 << 13, u32::MAX), None);
        assert!(rcc.is_enabled(0x4C, 13) && !rcc.is_enabled(0x4C, 14));
    }
}
