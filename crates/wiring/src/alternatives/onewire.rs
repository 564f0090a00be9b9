//! `onewire`: a GPIO that both ends pull low. 1-Wire parts with an address share one; a burst of the DHT22 is timed by
//! the interrupt of its pin.

use sensedsl_model::kind::onewire::{OneWire, OneWireProtocol};

use super::candidates::Need;
use super::{Alternatives, Maker, Served};

impl Served for OneWire {
    fn ways(&self, maker: &mut Maker<'_, '_>) -> Vec<Alternatives> {
        let need = match self.protocol {
            OneWireProtocol::Dht => Need::Interrupt,
            OneWireProtocol::W1 if self.rom.is_some() => Need::SharedGpio,
            OneWireProtocol::W1 => Need::Gpio,
        };
        let roles = maker.wanted.kind.roles(maker.wanted.direction);
        let roles = roles.into_iter().map(|role| maker.role(role, &need, None)).collect();
        maker.finish(None, &[], roles)
    }
}
