//! Analog inputs: the one converter has a channel for each, and a conversion may fail.

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
        section.bind(interrupt, "hal::adc::InterruptHandler".to_owned());
        Ok(Constructor {
            type_: "hal::adc::Adc<'static, hal::adc::Async>".to_owned(),
            make: format!("hal::adc::Adc::new(p.{hal}, Irqs, hal::adc::Config::default())"),
        })
    }

    fn input(&self, _context: &Context<'_>, _unit: &str, pin: &PinName) -> Constructor {
        Constructor {
            type_: "hal::adc::Channel<'static>".to_owned(),
            make: format!("hal::adc::Channel::new_pin(p.{}, Pull::None)", self.pin(pin)),
        }
    }

    fn sample(&self, inputs: &[AnalogInput<'_>], _sampling: Cycles, samples: &str) -> Vec<String> {
        let round = each_round(inputs, samples, |name, AnalogInput { wire, converter, .. }| {
            format!(
                "is_whole &= rt::converter::read(&mut {converter}, &mut {}, {name}).await;",
                wire.ident
            )
        });
        vec!["let mut is_whole = true;".to_owned(), round]
    }

    fn report(&self, constant: &str, report: String) -> String {
        format!(
            "if is_whole {{ {report} }} else {{ BOARD.report(None, tables::{constant}, Outcome::Invalid, &mut []); }}"
        )
    }
}
