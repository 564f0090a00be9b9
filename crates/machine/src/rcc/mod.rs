//! Reset and clock control, with a file for each version of the block: the frequencies of clocks, the peripherals that
//! have one, the causes of resets.
//!
//! In: writes to the registers, the board's crystal, resets. Out: frequencies, and the peripherals that a write holds
//! in reset. Oscillators that are switched on are ready at once.

mod f1;
mod f4;
mod g4;
mod unit;

use std::collections::BTreeMap;

pub(crate) use self::unit::Rcc;
use crate::mcu::{Kernel, Mcu};

/// The unit of an MCU in its state after power-up.
pub(crate) fn new(mcu: &Mcu, crystal_hz: u64) -> Box<dyn Rcc> {
    match mcu.block("RCC") {
        "rcc_f1" => Box::new(unit::Unit::<f1::Version>::new(crystal_hz)),
        "rcc_g4" => Box::new(unit::Unit::<g4::Version>::new(crystal_hz)),
        _ => Box::new(unit::Unit::<f4::Version>::new(crystal_hz)),
    }
}

/// The frequencies of the units that select their kernel clock.
pub(crate) fn kernels<'m>(mcu: &'m Mcu, rcc: &dyn Rcc) -> BTreeMap<&'m str, u64> {
    let selected_hz = |kernel: &Kernel| {
        let (register, bit, bits) = kernel.field;
        let code = rcc.read(register) >> bit & ((1 << bits) - 1);
        kernel.clocks.get(code as usize).map_or(0, |clock| rcc.named_hz(clock))
    };
    mcu.kernels().map(|(unit, kernel)| (unit, selected_hz(kernel))).collect()
}
