//! What is broken around a board at a moment: a part, a wire or a bus in, whether it is out.

use sensedsl_model::design::{ConnectionIndex, PartIndex};

use super::Bench;
use super::broken::Broken;
use crate::world::FaultKind;

impl Bench {
    pub(super) fn has(&self, kind: FaultKind, part: PartIndex, now_ns: u64) -> bool {
        self.faults.iter().any(|one| one.is(kind, now_ns) && one.part == Some(part))
    }

    pub(super) fn is_cut(&self, connection: ConnectionIndex, now_ns: u64) -> bool {
        self.wires.get(&connection).is_some_and(|wired| {
            self.has(FaultKind::Torn, wired.part, now_ns)
                || self.has(FaultKind::Silent, wired.part, now_ns)
        })
    }

    /// Whether something holds a wire of a bus.
    pub(super) fn is_held(&self, kind: FaultKind, unit: u8, now_ns: u64) -> bool {
        let is_on = |one: &Broken| one.units.iter().any(|one| self.units.number(one) == Some(unit));
        self.faults.iter().any(|one| one.is(kind, now_ns) && is_on(one))
    }
}
