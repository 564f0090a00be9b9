//! Reset and clock control: the frequencies of clocks, the peripherals that have one, the causes of resets.

use super::wires::{Clocks, ResetCause, merge};

/// The internal oscillator.
const HSI_HZ: u64 = 16_000_000;
/// The clocks after a reset.
pub(super) const AT_RESET: Clocks =
    Clocks { core: HSI_HZ, apb1: HSI_HZ, apb2: HSI_HZ, timers1: HSI_HZ, timers2: HSI_HZ };

const CR: u32 = 0x00;
const PLLCFGR: u32 = 0x04;
const CFGR: u32 = 0x08;
const BDCR: u32 = 0x70;
const CSR: u32 = 0x74;
const DCKCFGR: u32 = 0x8C;
const TIMPRE: u32 = 1 << 24;

/// Oscillators that are switched on are ready at once: for each, the bit that switches it on and the bit that reports
/// it ready.
const READY: [(u32, u32); 5] = [(0, 1), (16, 17), (24, 25), (26, 27), (28, 29)];
/// The cause of the last reset in CSR: pin, power, software, independent watchdog.
const CAUSE_PIN: u32 = 1 << 26;
const CAUSE_POWER: u32 = (1 << 27) | (1 << 25);
const CAUSE_SOFTWARE: u32 = 1 << 28;
const CAUSE_WATCHDOG: u32 = 1 << 29;

/// The registers, by offset; the crystal is a property of the board.
#[derive(Clone, Debug)]
pub(super) struct Rcc {
    registers: [u32; 36],
    crystal_hz: u64,
}

impl Rcc {
    pub(super) fn new(crystal_hz: u64) -> Self {
        let mut rcc = Self { registers: [0; 36], crystal_hz };
        rcc.reset_registers();
        rcc.registers[index(CSR)] = CAUSE_POWER | CAUSE_PIN;
        rcc
    }

    fn reset_registers(&mut self) {
        let (csr, bdcr) = (self.registers[index(CSR)], self.registers[index(BDCR)]);
        self.registers = [0; 36];
        self.registers[index(CR)] = 0x83;
        self.registers[index(PLLCFGR)] = 0x2400_3010;
        self.registers[index(0x30)] = 0x0010_0000;
        self.registers[index(0x84)] = 0x2000_3000;
        self.registers[index(CSR)] = csr;
        self.registers[index(BDCR)] = bdcr;
    }

    /// A reset. Earlier causes stay until the program clears them, or until power is lost, which also clears the backup
    /// domain.
    pub(super) fn reset(&mut self, cause: ResetCause) {
        if cause == ResetCause::Power {
            self.registers = [0; 36];
        }
        self.reset_registers();
        self.registers[index(CSR)] |= CAUSE_PIN
            | match cause {
                ResetCause::Watchdog => CAUSE_WATCHDOG,
                ResetCause::Software => CAUSE_SOFTWARE,
                ResetCause::Power => CAUSE_POWER,
            };
    }

    /// The causes in CSR.
    pub(super) fn causes(&self) -> u32 {
        self.registers[index(CSR)] & 0xFE00_0000
    }

    pub(super) fn read(&self, offset: u32) -> u32 {
        self.registers.get(index(offset)).copied().unwrap_or(0)
    }

    /// Writes a register; returns the peripherals that this holds in reset, as (offset of the register, bits).
    pub(super) fn write(&mut self, offset: u32, value: u32, mask: u32) -> Option<(u32, u32)> {
        let old = self.read(offset);
        let mut new = merge(old, value, mask);
        match offset {
            CR => {
                for (on, ready) in READY {
                    new = (new & !(1 << ready)) | ((new >> on & 1) << ready);
                }
            }
            // The switch follows the selection once the oscillator runs.
            CFGR => {
                let ready = [1, 17, 25].get((new & 3) as usize);
                let is_ready = ready.is_some_and(|bit| self.registers[index(CR)] >> bit & 1 == 1);
                let status = if is_ready { new & 3 } else { old >> 2 & 3 };
                new = (new & !0xC) | status << 2;
            }
            BDCR => new = (new & !2) | (new & 1) << 1,
            CSR => {
                new = (old & 0xFE00_0000) | (new & 1) | (new & 1) << 1;
                if value & mask & (1 << 24) != 0 {
                    new &= 0x00FF_FFFF;
                }
            }
            _ => {}
        }
        if let Some(register) = self.registers.get_mut(index(offset)) {
            *register = new;
        }
        (0x10..=0x24).contains(&offset).then_some((offset, new & !old))
    }

    /// Whether the peripheral that belongs to a bit of an enable register has its clock.
    pub(super) fn is_enabled(&self, offset: u32, bit: u32) -> bool {
        self.read(offset) >> bit & 1 == 1
    }

    pub(super) fn clocks(&self) -> Clocks {
        let cfgr = self.read(CFGR);
        let system = match cfgr >> 2 & 3 {
            1 => self.crystal_hz,
            2 => self.pll_hz(),
            _ => HSI_HZ,
        };
        let ahb = [1, 1, 1, 1, 1, 1, 1, 1, 2, 4, 8, 16, 64, 128, 256, 512];
        let apb = [1, 1, 1, 1, 2, 4, 8, 16];
        let core = system / ahb[(cfgr >> 4 & 15) as usize];
        let (by1, by2) = (apb[(cfgr >> 10 & 7) as usize], apb[(cfgr >> 13 & 7) as usize]);
        // If TIMPRE is set, timers run at up to four times the speed of their bus.
        let fastest = if self.read(DCKCFGR) & TIMPRE == 0 { 2 } else { 4 };
        let timers = |by: u64| if by < fastest { core } else { core / by * fastest };
        Clocks {
            core,
            apb1: core / by1,
            apb2: core / by2,
            timers1: timers(by1),
            timers2: timers(by2),
        }
    }

    fn pll_hz(&self) -> u64 {
        let pll = u64::from(self.read(PLLCFGR));
        let source = if pll >> 22 & 1 == 1 { self.crystal_hz } else { HSI_HZ };
        let (m, n, p) = (pll & 63, pll >> 6 & 511, (pll >> 16 & 3) * 2 + 2);
        source * n / m.max(1) / p
    }
}

fn index(offset: u32) -> usize {
    (offset / 4) as usize
}
