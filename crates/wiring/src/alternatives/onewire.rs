//! `onewire`: a GPIO that both ends pull low. 1-Wire parts of a board that have an address share one, which is the pin
//! that any of them fixes; the burst of a DHT22 is timed by the interrupt of its pin.

use sensedsl_model::kind::onewire::{OneWire, OneWireProtocol};
use sensedsl_model::kind::{KindName, Role};

use super::candidates::Need;
use super::{Alternatives, Maker, Served};

/// The wire of parts that no file puts anywhere.
const ANYWHERE: &str = "1-Wire";

impl Served for OneWire {
    fn ways(&self, maker: &mut Maker<'_, '_>) -> Vec<Alternatives> {
        let shared = self.rom.is_some().then(|| wire(maker));
        let need = match (self.protocol, &shared) {
            (OneWireProtocol::Dht, _) => Need::Interrupt,
            (OneWireProtocol::W1, Some(wire)) => Need::Shared(wire),
            (OneWireProtocol::W1, None) => Need::Gpio,
        };
        let roles = maker.wanted.kind.roles(maker.wanted.direction);
        let roles = roles.into_iter().map(|role| maker.role(role, &need, None)).collect();
        maker.finish(None, &[], roles)
    }
}

/// The name of the wire that a part with an address shares: that of its own pin, or of the first that such a part fixes.
fn wire(maker: &Maker<'_, '_>) -> String {
    let board = maker.offer.index;
    let own = maker.wanted.fixed(Role::Data).and_then(|pin| pin.on(board));
    let connections = maker.builder.design.connections.iter().filter(|one| {
        one.kind.name() == KindName::OneWire
            && one.kind.onewire().is_some_and(|one| one.rom.is_some())
    });
    let fixed = connections.flat_map(|one| &one.placement.pins);
    let mut fixed = fixed.filter_map(|(_, pin)| pin.value.on(board));
    own.or_else(|| fixed.next()).map_or_else(|| ANYWHERE.to_owned(), ToString::to_string)
}
