//! The converters of STM32F1: started by setting ADON a second time, by SWSTART or by a timer's trigger. Their clock is
//! divided in the RCC, they have no overrun, and a calibration is over at once.

use super::older::{self, CONTINUOUS, DMA, DONE, INJECTED_DONE, ON};
use super::unit::input_mv;
use crate::wires::{NEVER, Wires, periods_ns};

/// Bits of CR2 that the other version has not, or elsewhere.
const CALIBRATE: u32 = 1 << 2;
const RESET_CALIBRATION: u32 = 1 << 3;
const INJECTED_TRIGGERED: u32 = 1 << 15;
const TRIGGERED: u32 = 1 << 20;
const START_INJECTED: u32 = 1 << 21;
const START: u32 = 1 << 22;
const INTERNAL: u32 = 1 << 23;
/// The codes of triggers in EXTSEL and JEXTSEL: software, and the trigger output of TIM3.
const SOFTWARE: u32 = 7;
const TIM3: u32 = 4;

/// The half cycles of a conversion with its sampling, by the code in SMPR.
const HALF_CYCLES: [u64; 8] = [28, 40, 52, 82, 108, 136, 168, 504];
/// The voltages at the internal inputs in millivolts: the temperature sensor at 25 degrees, and the reference.
const TEMPERATURE_MV: f64 = 1430.0;
const REFERENCE_MV: f64 = 1200.0;

/// This version has nothing of its own to keep.
#[derive(Debug, Default)]
pub(super) struct Version;

type Unit = older::Unit<Version>;

impl older::Version for Version {
    const INJECTED_ENDS: u32 = INJECTED_DONE | DONE;

    fn bits(_: &Unit) -> u64 {
        12
    }

    fn millivolts(unit: &Unit, channel: u32, wires: &Wires) -> f64 {
        let has_internal = unit.unit == 1 && unit.cr[1] & INTERNAL != 0;
        match channel {
            16 if has_internal => TEMPERATURE_MV,
            17 if has_internal => REFERENCE_MV,
            _ => input_mv(unit.unit, channel, wires),
        }
    }

    fn conversion_ns(_: &Unit, sampling: usize, wires: &Wires) -> u64 {
        periods_ns(HALF_CYCLES[sampling], 2 * wires.clocks.adc).max(1)
    }

    fn finish(unit: &mut Unit, wires: &Wires) {
        let at = unit.done_at;
        unit.done_at = NEVER;
        let channel = unit.channel();
        // A value that nobody has taken is lost.
        unit.dr = unit.sample(channel, wires);
        // ADC2 has no request of its own.
        unit.asking = unit.cr[1] & DMA != 0;
        unit.watch(channel);
        unit.at += 1;
        if unit.at >= unit.length() {
            unit.sr |= DONE;
            unit.at = 0;
            if unit.cr[1] & CONTINUOUS == 0 {
                return;
            }
        }
        unit.go_on(at, wires);
    }

    fn control(unit: &mut Unit, new: u32, wires: &Wires) {
        let was = unit.cr[1];
        unit.cr[1] = new & !(CALIBRATE | RESET_CALIBRATION | START | START_INJECTED);
        if new & DMA == 0 {
            unit.asking = false;
        }
        if new & ON == 0 {
            unit.stop();
            return;
        }
        if was & ON == 0 {
            return;
        }
        // ADON starts a conversion if it is set once more, and nothing else changes.
        let is_again = unit.cr[1] == was && new & (CALIBRATE | RESET_CALIBRATION) == 0;
        let is_started = new & START != 0 && new & TRIGGERED != 0 && new >> 17 & 7 == SOFTWARE;
        if is_again && new & (START | START_INJECTED) == 0 || is_started {
            unit.start(wires);
        }
        if new & START_INJECTED != 0 && new & INJECTED_TRIGGERED != 0 && new >> 12 & 7 == SOFTWARE {
            unit.start_injected(wires);
        }
    }

    fn trigger(unit: &mut Unit, triggers: u32, wires: &Wires) {
        let waits = unit.cr[1] & TRIGGERED != 0 && unit.cr[1] >> 17 & 7 == TIM3;
        if waits && triggers >> 2 & 1 == 1 {
            unit.start(wires);
        }
    }

    /// Conversions go on until the program ends them.
    fn dma_ended(_: &mut Unit) {}
}
