//! `can`: TX and RX of one unit, shared by devices of one bit rate.

use sensedsl_board::signal::{CanLine, Function, UnitName};
use sensedsl_board::table::Usage;
use sensedsl_model::kind::Role;
use sensedsl_model::kind::can::Can;

use super::buses::{Bus, Sharing};
use super::{Alternatives, Maker, Served};

impl Served for Can {
    fn ways(&self, maker: &mut Maker<'_, '_>) -> Vec<Alternatives> {
        let sharing = Sharing::Bus(self.bitrate_hz);
        maker.units(&Bus { wire, sharing, address: None })
    }
}

fn wire(usage: &Usage) -> Option<(&UnitName, Role)> {
    let Function::Can { unit, line } = usage.signal.function() else { return None };
    let role = match line {
        CanLine::Tx => Role::Tx,
        CanLine::Rx => Role::Rx,
    };
    Some((unit, role))
}
