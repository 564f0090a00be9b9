//! `I2Cv2`, `I2Cv3` and `I2Cv4`: the driver is given the timing register. The analog filter is on and the digital one
//! off, as after a reset.

use sensedsl_diagnostics::Diagnostic;
use sensedsl_timing::i2c_clock::{BusClock, TimingRegister};

use super::bus::{self, Version};
use crate::context::Context;
use crate::section::Section;

const VERSION: Version = Version { config, guard: |_| None };

pub(super) fn plan(context: &Context<'_>, diagnostics: &mut Vec<Diagnostic>) -> Section {
    bus::plan(context, &VERSION, diagnostics)
}

fn config(clock: &BusClock) -> Vec<String> {
    let lines = |register: TimingRegister| {
        let TimingRegister { prescaler, data_setup, data_hold, high, low, .. } = register;
        vec![
            format!(
                ".timingr = STM32_TIMINGR_PRESC({prescaler}U) | STM32_TIMINGR_SCLDEL({data_setup}U) |"
            ),
            format!(
                "           STM32_TIMINGR_SDADEL({data_hold}U) | STM32_TIMINGR_SCLH({high}U) | \
                 STM32_TIMINGR_SCLL({low}U),"
            ),
        ]
    };
    clock.register.map(lines).unwrap_or_default()
}
