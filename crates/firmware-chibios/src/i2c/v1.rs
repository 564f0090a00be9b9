//! `I2Cv1`: the driver is given the bus clock and divides; it halts the board if there is a remainder.

use sensedsl_diagnostics::Diagnostic;
use sensedsl_timing::i2c_clock::BusClock;

use super::bus::{self, Port, Version};
use crate::context::Context;
use crate::section::{GuardPlan, Section};

const VERSION: Version = Version { config, guard };

pub(super) fn plan(context: &Context<'_>, diagnostics: &mut Vec<Diagnostic>) -> Section {
    bus::plan(context, &VERSION, diagnostics)
}

fn config(clock: &BusClock) -> Vec<String> {
    vec![
        ".op_mode = OPMODE_I2C,".to_owned(),
        format!(".clock_speed = {}U,", clock.speed_hz),
        format!(".duty_cycle = {},", clock.duty),
    ]
}

fn guard(port: &Port) -> Option<GuardPlan> {
    let Port { unit, unit_clock, clock, .. } = port;
    let BusClock { speed_hz, clocks, dividers, .. } = clock;
    let steps = format!("({clocks}U * {speed_hz}U)");
    let (least, greatest) = (dividers.start(), dividers.end());
    Some(GuardPlan {
        condition: format!(
            "{unit_clock} % {steps} == 0U && {unit_clock} / {steps} >= {least}U &&\n                   \
             {unit_clock} / {steps} <= {greatest}U"
        ),
        message: format!("the clock of {unit} does not divide to {speed_hz} Hz"),
    })
}
