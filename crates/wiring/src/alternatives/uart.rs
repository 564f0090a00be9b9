//! `uart`: TX and RX of one unit, which it takes; only RX if nothing is sent, only TX if both directions are on one
//! wire. Parts with addresses share a unit where they agree on how the line is set.

use sensedsl_board::signal::{Function, UartLine, UnitName};
use sensedsl_board::silicon::{self, Ability};
use sensedsl_board::table::Usage;
use sensedsl_model::design::Board;
use sensedsl_model::kind::Role;
use sensedsl_model::kind::uart::{Duplex, Uart};

use super::buses::{Bus, Sharing};
use super::{Alternatives, Maker, Served};

impl Served for Uart {
    fn ways(&self, maker: &mut Maker<'_, '_>) -> Vec<Alternatives> {
        if self.ability(maker.offer.board).is_some() {
            return Vec::new();
        }
        let address = self.exchange.address;
        let shared = address.map(|_| Sharing::Bus(self.line()));
        maker.units(&Bus { wire, sharing: shared.unwrap_or(Sharing::Exclusive), address })
    }

    /// Ports that cannot invert their wires, or receive at TX, cannot serve a device that wants that.
    fn ability(&self, board: &Board) -> Option<&'static Ability> {
        let is_half = self.exchange.duplex == Duplex::Half;
        let mcu = board.mcu.as_deref()?;
        let lacks = |is: bool, of: fn(&str) -> Option<&'static Ability>| of(mcu).filter(|_| is);
        lacks(self.is_inverted, silicon::inversion).or_else(|| lacks(is_half, silicon::one_wire))
    }
}

fn wire(usage: &Usage) -> Option<(&UnitName, Role)> {
    let Function::Uart { unit, line } = usage.signal.function() else { return None };
    let role = match line {
        UartLine::Tx => Role::Tx,
        UartLine::Rx => Role::Rx,
    };
    Some((unit, role))
}
