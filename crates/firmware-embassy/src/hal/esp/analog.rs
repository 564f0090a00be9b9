//! Analog inputs of the first converter; the second one is the radio's.

use sensedsl_board::pin::PinName;
use sensedsl_board::profile::Cycles;

use super::settings::Settings;
use crate::context::Context;
use crate::hal::contract::inputs::{Analog, AnalogInput, each_round};
use crate::missing::Printed;
use crate::section::{Constructor, Section};

impl Analog for Settings {
    fn converter(
        &self,
        context: &Context<'_>,
        unit: &str,
        _section: &mut Section,
    ) -> Printed<Constructor> {
        let type_ = "crate::rt::converter::Converter";
        let (hal, starts) = (context.peripheral(unit), self.adc_starts);
        Ok(Constructor {
            type_: type_.to_owned(),
            make: format!("{type_}::new(p.{hal}, {starts})"),
        })
    }

    fn input(&self, _context: &Context<'_>, _unit: &str, pin: &PinName) -> Constructor {
        let type_ = "crate::rt::converter::Input";
        Constructor { type_: type_.to_owned(), make: format!("{type_}::new(p.{pin})") }
    }

    /// How long a sample takes cannot be set.
    fn sample(&self, inputs: &[AnalogInput<'_>], _sampling: Cycles, samples: &str) -> Vec<String> {
        vec![each_round(inputs, samples, |name, AnalogInput { wire, converter, .. }| {
            format!("{converter}.read(&mut {}, {name}).await;", wire.ident)
        })]
    }
}
