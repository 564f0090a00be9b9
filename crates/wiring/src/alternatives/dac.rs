//! `dac`: an output of a converter.

use sensedsl_board::signal::Function;
use sensedsl_board::table::Usage;
use sensedsl_model::kind::Role;
use sensedsl_model::kind::dac::Dac;

use super::candidates::Need;
use super::{Alternatives, Maker, Served, unit_fits};

impl Served for Dac {
    fn ways(&self, maker: &mut Maker<'_, '_>) -> Vec<Alternatives> {
        let (offer, wanted) = (maker.offer, maker.wanted);
        let profile = offer.board.profile();
        let serves = |usage: &Usage| {
            let Function::Dac { unit, channel } = usage.signal.function() else { return false };
            unit_fits(offer, wanted, &format!("DAC{unit}"))
                && profile.is_none_or(|profile| profile.dac_output(*unit, *channel).is_some())
        };
        let roles = vec![maker.role(Role::Out, &Need::Usage(&serves), None)];
        maker.finish(None, &[], roles)
    }
}
