//! The wires of a board that both ends pull low, with the parts on them.

use sensedsl_job::{BoardJob, JobConnection};
use sensedsl_model::design::{ConnectionIndex, Device, PartIndex};
use sensedsl_model::kind::onewire::OneWire;
use sensedsl_model::words::Words;
use sensedsl_wire::Direction;

use super::Bench;
use crate::parts::onewire::{Ailment, Part, Reading, Wire};
use crate::world::FaultKind;

impl Bench {
    /// Puts a part on its wire, which others may be on already.
    pub(super) fn hang(&mut self, job: &BoardJob<'_>, one: &JobConnection<'_>, own: &OneWire) {
        let part = one.connection.part;
        let readings = job.devices.iter().map(|of| of.device).filter(|of| {
            of.part == part && of.direction == Direction::Sensor && of.kind.onewire().is_some()
        });
        let readings = readings.filter_map(|of: &Device| {
            let words = Words::of(of)?;
            Some(Reading { subject: self.subject(of)?, byte: of.coding.byte, words })
        });
        let made = Part::new((part, one.index), own, readings.collect());
        let pin = |one: &JobConnection<'_>| one.pads.first().map(|pad| pad.pin.name.clone());
        let shares = |other: &&JobConnection<'_>| pin(other) == pin(one);
        let others = job.connections.iter().filter(shares);
        let place = others.filter_map(|other| self.on_wire.get(&other.index)).next().copied();
        let place = place.unwrap_or_else(|| {
            self.one_wires.push(Wire::default());
            self.one_wires.len() - 1
        });
        if let Some(wire) = self.one_wires.get_mut(place) {
            wire.add(made);
        }
        self.on_wire.insert(one.index, place);
    }

    /// The wire of a connection, with what is wrong with its parts now.
    fn line_of(&mut self, connection: ConnectionIndex, now_ns: u64) -> Option<&mut Wire> {
        let place = *self.on_wire.get(&connection)?;
        let parts = self.one_wires.get(place)?.parts.iter();
        let ail = |part: PartIndex| {
            let has = |kind| self.has(kind, part, now_ns);
            Ailment {
                is_gone: has(FaultKind::NoAnswer) || has(FaultKind::Torn),
                is_late: has(FaultKind::Late),
                is_spoiled: has(FaultKind::BadChecksum),
            }
        };
        let ailments: Vec<Ailment> = parts.map(|part| ail(part.part)).collect();
        let wire = self.one_wires.get_mut(place)?;
        for (part, ailment) in wire.parts.iter_mut().zip(ailments) {
            part.ailment = ailment;
        }
        Some(wire)
    }

    /// The level of a wire; `None` if its connection is none.
    pub(super) fn line_level(&mut self, connection: ConnectionIndex, now_ns: u64) -> Option<bool> {
        Some(self.line_of(connection, now_ns)?.level(now_ns))
    }

    /// The next edge that a part makes.
    pub(super) fn line_edge(
        &self,
        connection: ConnectionIndex,
        after_ns: u64,
    ) -> Option<(u64, bool)> {
        self.one_wires.get(*self.on_wire.get(&connection)?)?.next_edge(after_ns)
    }

    /// The board drives a wire.
    pub(super) fn drive_line(
        &mut self,
        connection: ConnectionIndex,
        level: Option<bool>,
        now_ns: u64,
    ) {
        if self.line_of(connection, now_ns).is_none() {
            return;
        }
        let place = self.on_wire.get(&connection).copied();
        if let Some(wire) = place.and_then(|place| self.one_wires.get_mut(place)) {
            wire.driven(level == Some(false), &self.subjects, now_ns);
        }
    }

    /// A whole transfer with a part, for a board that makes no slots; `None` if it does not answer.
    pub(crate) fn line_transfer(
        &mut self,
        connection: ConnectionIndex,
        sent: &[u8],
        now_ns: u64,
    ) -> Option<Vec<u8>> {
        self.line_of(connection, now_ns)?;
        let wire = self.one_wires.get_mut(*self.on_wire.get(&connection)?)?;
        let part = wire.parts.iter_mut().find(|one| one.connection == connection)?;
        part.transfer(sent, &self.subjects, now_ns)
    }
}
