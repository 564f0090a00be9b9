//! The converters of STM32F2, F4 and F7: started by software or by a timer's trigger; up to three share a divider.

use super::older::{self, CONTINUOUS, DMA, DONE, INJECTED_DONE, ON, OVERRUN};
use super::unit::input_mv;
use crate::wires::{NEVER, Wires, periods_ns};

/// Bits of CR2 that the other version has not, or elsewhere.
const DMA_GOES_ON: u32 = 1 << 9;
const EACH: u32 = 1 << 10;
const START_INJECTED: u32 = 1 << 22;
const START: u32 = 1 << 30;

/// The cycles that sampling takes, by the code in SMPR.
const SAMPLING: [u64; 8] = [3, 15, 28, 56, 84, 112, 144, 480];
/// The voltages at the internal inputs in millivolts: the temperature sensor at 25 degrees, the reference, half of the
/// battery's.
const TEMPERATURE_MV: f64 = 760.0;
const REFERENCE_MV: f64 = 1210.0;
const BATTERY_MV: f64 = 1650.0;

/// What this version keeps besides its registers.
#[derive(Debug)]
pub(super) struct Version {
    /// The common divider, from the common registers.
    divider: u64,
}

impl Default for Version {
    fn default() -> Self {
        Self { divider: 2 }
    }
}

type Unit = older::Unit<Version>;

impl older::Version for Version {
    const INJECTED_ENDS: u32 = INJECTED_DONE;

    fn bits(unit: &Unit) -> u64 {
        12 - 2 * u64::from(unit.cr[0] >> 24 & 3)
    }

    fn millivolts(unit: &Unit, channel: u32, wires: &Wires) -> f64 {
        match channel {
            16 => TEMPERATURE_MV,
            17 => REFERENCE_MV,
            18 => BATTERY_MV,
            _ => input_mv(unit.unit, channel, wires),
        }
    }

    fn conversion_ns(unit: &Unit, sampling: usize, wires: &Wires) -> u64 {
        let cycles = SAMPLING[sampling] + Self::bits(unit);
        periods_ns(cycles * unit.version.divider, wires.clocks.adc).max(1)
    }

    fn finish(unit: &mut Unit, wires: &Wires) {
        let at = unit.done_at;
        unit.done_at = NEVER;
        let is_last = unit.at + 1 >= unit.length();
        // Without DMA, an overrun is only noticed if each conversion is reported.
        let watches = unit.cr[1] & (DMA | EACH) != 0;
        let is_late = if unit.cr[1] & DMA != 0 { unit.asking } else { unit.sr & DONE != 0 };
        if watches && is_late {
            unit.sr |= OVERRUN;
        }
        if unit.sr & OVERRUN != 0 && watches {
            unit.asking = false;
            return;
        }
        let channel = unit.channel();
        unit.dr = unit.sample(channel, wires);
        unit.asking = unit.cr[1] & DMA != 0;
        if is_last || unit.cr[1] & EACH != 0 {
            unit.sr |= DONE;
        }
        unit.watch(channel);
        if !is_last {
            unit.at += 1;
        } else if unit.cr[1] & CONTINUOUS != 0 {
            unit.at = 0;
        } else {
            return;
        }
        unit.go_on(at, wires);
    }

    fn control(unit: &mut Unit, new: u32, wires: &Wires) {
        unit.cr[1] = new & !(START | START_INJECTED);
        if new & ON == 0 {
            unit.stop();
            return;
        }
        if new & DMA == 0 {
            unit.asking = false;
        }
        if new & START != 0 {
            unit.start(wires);
        }
        if new & START_INJECTED != 0 {
            unit.start_injected(wires);
        }
    }

    fn trigger(unit: &mut Unit, triggers: u32, wires: &Wires) {
        // EXTSEL: 6 is TIM2's trigger output, 8 TIM3's, 14 TIM8's.
        let timer = match unit.cr[1] >> 24 & 15 {
            6 => 1,
            8 => 2,
            14 => 7,
            _ => return,
        };
        if unit.cr[1] >> 28 & 3 != 0 && triggers >> timer & 1 == 1 {
            unit.start(wires);
        }
    }

    /// No more requests are made unless they are to go on.
    fn dma_ended(unit: &mut Unit) {
        if unit.cr[1] & DMA_GOES_ON == 0 {
            unit.done_at = if unit.cr[1] & CONTINUOUS == 0 { unit.done_at } else { NEVER };
        }
    }

    fn status(unit: &Unit) -> u32 {
        unit.sr & 0x3F
    }

    fn share(&mut self, ccr: u32) {
        self.divider = u64::from(ccr >> 16 & 3) * 2 + 2;
    }
}
