//! `uart`: TX and RX of one unit, which it takes; only RX if nothing is sent.

use sensedsl_board::signal::{Function, UartLine, UnitName};
use sensedsl_board::silicon::{self, Ability};
use sensedsl_board::table::Usage;
use sensedsl_model::design::Board;
use sensedsl_model::kind::Role;
use sensedsl_model::kind::uart::Uart;

use super::buses::{Bus, Sharing};
use super::{Alternatives, Maker, Served};

impl Served for Uart {
    fn ways(&self, maker: &mut Maker<'_, '_>) -> Vec<Alternatives> {
        if self.ability(maker.offer.board).is_some() {
            return Vec::new();
        }
        maker.units(&Bus { wire, sharing: Sharing::Exclusive, address: None })
    }

    /// Ports that cannot invert their wires cannot serve a device that wants that.
    fn ability(&self, board: &Board) -> Option<&'static Ability> {
        board.mcu.as_deref().filter(|_| self.is_inverted).and_then(silicon::inversion)
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
