//! Analog inputs: the one converter is set up for each of them in turn.

use sensedsl_board::pin::PinName;
use sensedsl_board::profile::Cycles;

use super::settings::Settings;
use crate::context::Context;
use crate::hal::contract::inputs::{Analog, AnalogInput, each_round};
use crate::hal::contract::outputs::Pins as _;
use crate::missing::Printed;
use crate::section::{Constructor, Section};

impl Analog for Settings {
    fn converter(
        &self,
        context: &Context<'_>,
        unit: &str,
        section: &mut Section,
    ) -> Printed<Constructor> {
        let (hal, interrupt) = (context.peripheral(unit), context.interrupt(unit, "GLOBAL")?);
        section.bind(interrupt, "hal::saadc::InterruptHandler".to_owned());
        Ok(Constructor {
            type_: "crate::rt::converter::Converter<crate::wiring::Irqs>".to_owned(),
            make: format!("crate::rt::converter::Converter::new(p.{hal}, Irqs)"),
        })
    }

    fn input(&self, _context: &Context<'_>, _unit: &str, pin: &PinName) -> Constructor {
        Constructor {
            type_: "hal::saadc::AnyInput<'static>".to_owned(),
            make: format!("hal::saadc::Input::degrade_saadc(p.{})", self.pin(pin)),
        }
    }

    /// A cycle of the profile's clock is a microsecond.
    fn sample(&self, inputs: &[AnalogInput<'_>], sampling: Cycles, samples: &str) -> Vec<String> {
        let time_us = sampling.whole();
        vec![each_round(inputs, samples, |name, AnalogInput { wire, converter, .. }| {
            format!("{converter}.read(&mut {}, {time_us}, {name}).await;", wire.ident)
        })]
    }
}
