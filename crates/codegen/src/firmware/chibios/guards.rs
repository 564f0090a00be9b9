//! What the C compiler is asked to check against the user's tree, because nothing else would.

use sensedsl_timing::i2c_clock::BusClock;

use super::context::Context;
use super::i2c::I2cPlan;
use super::icu::IcuPlan;
use super::settings::SettingsPlan;

/// `_Static_assert(condition, message)`
#[derive(Clone, Debug)]
pub(super) struct GuardPlan {
    pub(super) condition: String,
    pub(super) message: String,
}

pub(super) fn plan(
    context: &Context<'_>,
    settings: &SettingsPlan,
    i2c: &I2cPlan,
    icus: &[IcuPlan],
) -> Vec<GuardPlan> {
    let mut guards = Vec::new();
    streams_differ(settings, &mut guards);
    for port in &i2c.ports {
        let (unit, unit_clock, BusClock { speed_hz, clocks, dividers, .. }) =
            (&port.unit, &port.unit_clock, &port.clock);
        let steps = format!("({clocks}U * {speed_hz}U)");
        let (least, greatest) = (dividers.start(), dividers.end());
        guards.push(GuardPlan {
            condition: format!(
                "{unit_clock} % {steps} == 0U && {unit_clock} / {steps} >= {least}U &&\n                   \
                 {unit_clock} / {steps} <= {greatest}U"
            ),
            message: format!("the clock of {unit} does not divide to {speed_hz} Hz"),
        });
    }
    for IcuPlan { timer, clock, tick_hz, channel, .. } in icus {
        guards.push(GuardPlan {
            condition: format!("{clock} % {tick_hz}U == 0U && {clock} / {tick_hz}U <= 65536U"),
            message: format!("the clock of {timer} does not divide to {tick_hz} Hz"),
        });
        guards.push(GuardPlan {
            condition: format!("STM32_{timer}_CHANNELS >= 2"),
            message: format!("{timer} cannot measure with channel {channel}"),
        });
    }
    let needed = context.chibios.clocks_hz.iter().filter(|(name, _)| {
        let icu = icus.iter().any(|icu| icu.clock == **name);
        icu || context.clocks().any(|clock| clock == name.as_str())
    });
    guards.extend(needed.map(|(name, hz)| GuardPlan {
        condition: format!("{name} == {hz}U"),
        message: format!("{name} is not what this wiring was made for"),
    }));
    guards
}

/// Two drivers on one stream compile, and fail at run time.
fn streams_differ(settings: &SettingsPlan, guards: &mut Vec<GuardPlan>) {
    for (at, first) in settings.dma.iter().enumerate() {
        for second in settings.dma.iter().skip(at + 1) {
            guards.push(GuardPlan {
                condition: format!("{first} !=\n               {second}"),
                message: "two drivers have one DMA stream".to_owned(),
            });
        }
    }
}
