//! Handlers of pin interrupts that measure what a timer has no channel for: pulses, and quadrature.

use sensedsl_model::kind::Role;

use super::candidates::Need;
use super::{Alternatives, Maker};

impl Maker<'_, '_> {
    /// The ways to have these wires read by handlers of their interrupts; none if the system measures nothing by them, or
    /// if the file names the unit.
    pub(super) fn handlers(&mut self, wires: &[Role]) -> Vec<Alternatives> {
        let has_handlers = self.profile().is_some_and(|profile| profile.edges.is_some());
        if !has_handlers || self.wanted.unit.is_some() {
            return Vec::new();
        }
        let mut roles: Vec<_> =
            wires.iter().map(|role| self.role(*role, &Need::Interrupt, None)).collect();
        self.push_gpios(&mut roles);
        self.finish(None, &[], roles)
    }
}
