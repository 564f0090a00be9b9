//! `spi`: SCK, MISO and MOSI of one unit, shared; a GPIO as chip select for each device. A strip of LEDs
//! has the unit for itself, and no chip select.

use sensedsl_board::signal::{Function, SpiLine, UnitName};
use sensedsl_board::table::Usage;
use sensedsl_model::kind::Role;
use sensedsl_model::kind::spi::Spi;

use super::buses::{Bus, Sharing};
use super::{Alternatives, Maker, Served};

impl Served for Spi {
    fn ways(&self, maker: &mut Maker<'_, '_>) -> Vec<Alternatives> {
        // A strip takes whatever is on its wire, as nothing selects it.
        let is_alone = self.encoding.is_strip();
        let sharing = if is_alone { Sharing::Exclusive } else { Sharing::Bus(0) };
        maker.units(&Bus { wire, sharing, address: None })
    }
}

fn wire(usage: &Usage) -> Option<(&UnitName, Role)> {
    let Function::Spi { unit, line } = usage.signal.function() else { return None };
    let role = match line {
        SpiLine::Sck => Role::Sck,
        SpiLine::Miso => Role::Miso,
        SpiLine::Mosi => Role::Mosi,
        // Any GPIO can select a chip.
        SpiLine::Nss => return None,
    };
    Some((unit, role))
}
