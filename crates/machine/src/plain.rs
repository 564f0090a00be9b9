//! Peripherals that firmware sets up or reads, and that do little more than store what is written.

use super::registers::merge;

/// The size of a block.
const BYTES: u32 = 0x400;

/// A block of registers that keep what is written, except for the bits that hardware sets.
#[derive(Debug)]
pub(super) struct Plain {
    registers: Vec<u32>,
    /// The offsets of registers, and their bits that always read as 1.
    ready: &'static [(u32, u32)],
}

/// The registers of a block that have bits which always read as 1.
fn ready(block: &str) -> &'static [(u32, u32)] {
    match block {
        // The regulator has reached the selected voltage, including the higher one if there is one; the backup
        // regulator is ready.
        "pwr_f4" => &[(0x04, 0x0003_4008)],
        // The calendar can be set, and its registers are up to date.
        "rtc_v1" => &[(0x04, 0x28)],
        "rtc_v2_f4" | "rtc_v3_base" => &[(0x0C, 0x67)],
        // There is always another random number.
        "rng_v1" => &[(0x04, 1)],
        // The flash's latency can be read back, and it is never busy.
        _ => &[],
    }
}

impl Plain {
    /// A block in its state after a reset.
    pub(super) fn new(block: &str) -> Self {
        Self { registers: vec![0; (BYTES / 4) as usize], ready: ready(block) }
    }

    pub(super) fn read(&self, offset: u32) -> u32 {
        let value = self.registers.get((offset / 4) as usize).copied().unwrap_or(0);
        self.ready
            .iter()
            .filter(|(at, _)| *at == offset)
            .fold(value, |value, (_, bits)| value | bits)
    }

    pub(super) fn write(&mut self, offset: u32, value: u32, mask: u32) {
        if let Some(register) = self.registers.get_mut((offset / 4) as usize) {
            *register = merge(*register, value, mask);
        }
    }
}

/// A generator of numbers that are the same in each run (xorshift).
pub(super) fn next_random(state: u32) -> u32 {
    let mut x = if state == 0 { 0x2545_F491 } else { state };
    x ^= x << 13;
    x ^= x >> 17;
    x ^= x << 5;
    x
}
