//! Voltages of the digital-analog converters.

use sensedsl_board::pin::PinName;

use super::settings::Settings;
use crate::context::Context;
use crate::hal::contract::outputs::Dac;
use crate::section::Constructor;

const CHANNEL: &str = "hal::dac::DacChannel<'static, hal::mode::Blocking>";

impl Dac for Settings {
    fn channel(&self, context: &Context<'_>, unit: &str, pin: &PinName) -> Constructor {
        let hal = context.peripheral(unit);
        Constructor {
            type_: CHANNEL.to_owned(),
            make: format!("hal::dac::DacChannel::new_blocking(p.{hal}, p.{pin})"),
        }
    }

    fn channels(
        &self,
        context: &Context<'_>,
        unit: &str,
        [first, second]: [&PinName; 2],
    ) -> Constructor {
        let hal = context.peripheral(unit);
        Constructor {
            type_: format!("({CHANNEL}, {CHANNEL})"),
            make: format!("hal::dac::Dac::new_blocking(p.{hal}, p.{first}, p.{second}).split()"),
        }
    }

    fn set(&self, field: &str, value: &str) -> String {
        format!("outputs.{field}.set(hal::dac::Value::Bit12Right({value}))")
    }
}
