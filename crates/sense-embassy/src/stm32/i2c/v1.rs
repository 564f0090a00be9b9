//! How a unit for I²C forgets what it was doing: by a reset that takes its settings, too.

use embassy_stm32::pac::i2c::I2c;

/// The unit lets go of its bus and is as it was set up.
pub(super) fn reset(unit: I2c) {
    let (clock_mhz, period, rise) =
        (unit.cr2().read().freq(), unit.ccr().read(), unit.trise().read());
    unit.cr1().write(|control| control.set_swrst(true));
    unit.cr1().write(|control| control.set_swrst(false));
    unit.cr2().write(|control| control.set_freq(clock_mhz));
    unit.ccr().write_value(period);
    unit.trise().write_value(rise);
    unit.cr1().write(|control| control.set_pe(true));
}
