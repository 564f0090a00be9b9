//! How a unit for I²C forgets what it was doing: by being switched off, which leaves its settings.

use embassy_stm32::pac::i2c::I2c;

/// The unit lets go of its bus.
pub(super) fn reset(unit: I2c) {
    unit.cr1().modify(|control| control.set_pe(false));
    // Three cycles of the bus clock, which reading takes.
    for _ in 0..3 {
        let _ = unit.cr1().read();
    }
    unit.cr1().modify(|control| control.set_pe(true));
}
