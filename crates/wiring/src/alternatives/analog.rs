//! Converters: analog inputs and outputs.

use sensedsl_board::signal::Function;
use sensedsl_board::table::Usage;
use sensedsl_model::kind::Role;

use super::candidates::Need;
use super::{Made, Maker, unit_fits};
use crate::formulate::Converters;

impl Maker<'_, '_> {
    /// Any converter, or each one that there is for itself where its streams count.
    pub(super) fn analog(&mut self) -> Vec<Made> {
        let (offer, wanted) = (self.offer, self.wanted);
        let converters = offer.board.profile().map(|profile| profile.adcs.as_slice());
        let converters = converters.unwrap_or_default().iter();
        let converters = converters.filter(|adc| unit_fits(offer, wanted, &adc.name));
        let converters: Vec<&str> = converters.map(|adc| adc.name.as_str()).collect();
        if converters.len() > 1 && self.builder.converters == Converters::Later {
            return self.sampled(&|unit| unit_fits(offer, wanted, unit), None);
        }
        if converters.is_empty() {
            return self.sampled(&|unit| unit_fits(offer, wanted, unit), None);
        }
        converters
            .into_iter()
            .flat_map(|only| self.sampled(&|unit| unit == only, Some(only)))
            .collect()
    }

    /// Analog inputs of the converters that fit; `only` where it is a single one.
    pub(super) fn sampled(&mut self, fits: &dyn Fn(&str) -> bool, only: Option<&str>) -> Vec<Made> {
        let profile = self.offer.board.profile();
        let serves = |usage: &Usage| match usage.signal.function() {
            Function::Adc { units, channel } => units.iter().any(|one| {
                fits(&format!("ADC{one}"))
                    && profile.is_none_or(|profile| {
                        profile.adc(*one).is_some_and(|adc| adc.inputs.contains(channel))
                    })
            }),
            Function::I2c { .. }
            | Function::Timer { .. }
            | Function::Uart { .. }
            | Function::Spi { .. }
            | Function::Can { .. }
            | Function::Dac { .. }
            | Function::Other => false,
        };
        let roles = vec![self.role(Role::In, &Need::Usage(&serves), None)];
        self.finish(only, &[], roles)
    }

    pub(super) fn dac(&mut self) -> Vec<Made> {
        let (offer, wanted) = (self.offer, self.wanted);
        let profile = offer.board.profile();
        let serves = |usage: &Usage| match usage.signal.function() {
            Function::Dac { unit, channel } => {
                unit_fits(offer, wanted, &format!("DAC{unit}"))
                    && profile.is_none_or(|profile| profile.dac_output(*unit, *channel).is_some())
            }
            Function::Adc { .. }
            | Function::I2c { .. }
            | Function::Timer { .. }
            | Function::Uart { .. }
            | Function::Spi { .. }
            | Function::Can { .. }
            | Function::Other => false,
        };
        let roles = vec![self.role(Role::Out, &Need::Usage(&serves), None)];
        self.finish(None, &[], roles)
    }
}
