//! `analog`: an input of any converter, or one alternative for each converter if their streams
//! count.

use sensedsl_board::signal::Function;
use sensedsl_board::table::Usage;
use sensedsl_model::kind::Role;
use sensedsl_model::kind::analog::Analog;

use super::candidates::Need;
use super::{Alternatives, Maker, Served, unit_fits};
use crate::builder::Converters;

impl Served for Analog {
    fn ways(&self, maker: &mut Maker<'_, '_>) -> Vec<Alternatives> {
        let (offer, wanted) = (maker.offer, maker.wanted);
        let converters = offer.board.profile().map(|profile| profile.adcs.as_slice());
        let converters = converters.unwrap_or_default().iter();
        let converters = converters.filter(|adc| unit_fits(offer, wanted, &adc.name));
        let converters: Vec<&str> = converters.map(|adc| adc.name.as_str()).collect();
        let is_later = maker.builder.converters == Converters::Later;
        if converters.is_empty() || (converters.len() > 1 && is_later) {
            return sampled(maker, &|unit| unit_fits(offer, wanted, unit), None);
        }
        let alone = |only: &str| sampled(maker, &|unit| unit == only, Some(only));
        converters.into_iter().flat_map(alone).collect()
    }
}

/// The inputs of the converters that fit; `only` if it is a single one.
fn sampled(
    maker: &mut Maker<'_, '_>,
    fits: &dyn Fn(&str) -> bool,
    only: Option<&str>,
) -> Vec<Alternatives> {
    let profile = maker.offer.board.profile();
    let serves = |usage: &Usage| {
        let Function::Adc { units, channel } = usage.signal.function() else { return false };
        units.iter().any(|one| {
            fits(&format!("ADC{one}"))
                && profile.is_none_or(|profile| {
                    profile.adc(*one).is_some_and(|adc| adc.inputs.contains(channel))
                })
        })
    };
    let roles = vec![maker.role(Role::In, &Need::Usage(&serves), None)];
    maker.finish(only, &[], roles)
}
