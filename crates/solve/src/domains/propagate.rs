//! Propagation: removes from all other devices what a decision rules out.
//!
//! This is forward checking (R. M. Haralick and G. L. Elliott, *Increasing tree search efficiency
//! for constraint satisfaction problems*, 1980): once a device has one alternative left, or a role
//! one candidate, no other device can have anything that this excludes. Stronger reasoning is left
//! to the bounds.

use super::{Domains, Pruned};
use crate::index::{AltId, CandId, RoleId, WireId};
use crate::model::{Holding, Model, Part, agree};
use crate::problem::{Claim, DeviceId};

impl Domains {
    /// Follows every decision until nothing new is decided.
    pub(crate) fn propagate(&mut self, model: &Model) -> Result<(), Pruned> {
        loop {
            if let Some(device) = self.decided.pop() {
                if let Some(alt) = self.decided(device) {
                    self.follow_alt(model, device, alt)?;
                }
            } else if let Some(role) = self.chosen.pop() {
                if let Some(id) = self.chosen(role) {
                    self.follow_cand(model, id)?;
                }
            } else {
                return Ok(());
            }
        }
    }

    pub(super) fn remove_part(&mut self, model: &Model, part: Part) -> Result<(), Pruned> {
        match part {
            Part::Alt(alt) => self.remove_alt(model, alt),
            Part::Cand(id) => self.remove_cand(model, id),
        }
    }

    /// A decided device cannot take this candidate, so no device on its wire can.
    pub(super) fn remove_on_wire(
        &mut self,
        model: &Model,
        wire: WireId,
        id: CandId,
    ) -> Result<(), Pruned> {
        let c = &model.cand[id];
        for &other in &model.wire_cands[wire] {
            let o = &model.cand[other];
            if (o.pin, o.signal) == (c.pin, c.signal) {
                self.remove_cand(model, other)?;
            }
        }
        Ok(())
    }

    fn follow_alt(&mut self, model: &Model, device: DeviceId, alt: AltId) -> Result<(), Pruned> {
        self.follow_claims(model, device, &model.alt_claims[alt])?;
        for &rule in &model.alt_rules[alt] {
            self.pay_rule(model, rule)?;
        }
        self.pay_board(model, model.alt_board[alt])?;
        for role in model.roles.of(alt) {
            if self.cands_left(role) == 1 {
                self.chosen.push(role);
            }
            if let Holding::Wire(wire) = model.holding[role] {
                self.join_wire(model, role, wire)?;
            }
        }
        Ok(())
    }

    /// A device joins a wire: all devices on the wire are limited to its candidates.
    fn join_wire(&mut self, model: &Model, role: RoleId, wire: WireId) -> Result<(), Pruned> {
        let device = model.alt_device[model.role_alt[role]];
        for &other in &model.wire_cands[wire] {
            if !self.has_cand(model, other) {
                continue;
            }
            let place = model.cand[other].place();
            let here = |c: CandId| model.cand[c].place() == place;
            if model.cand[other].role != role
                && model.cand_device(other) != device
                && !self.cands(model, role).any(here)
            {
                self.remove_cand(model, other)?;
            }
        }
        Ok(())
    }

    fn follow_claims(
        &mut self,
        model: &Model,
        device: DeviceId,
        claims: &[Claim],
    ) -> Result<(), Pruned> {
        for claim in claims {
            for &(part, holder) in &model.resource_users[claim.resource] {
                if agree(holder, claim.holder) || model.alt_device[model.part_alt(part)] == device {
                    continue;
                }
                self.remove_part(model, part)?;
            }
        }
        Ok(())
    }

    fn follow_cand(&mut self, model: &Model, id: CandId) -> Result<(), Pruned> {
        let c = &model.cand[id];
        let device = model.cand_device(id);
        self.follow_claims(model, device, &model.cand_claims[id])?;
        for &rule in &model.cand_rules[id] {
            self.pay_rule(model, rule)?;
        }
        for &other in &model.pin_cands[c.pin] {
            let o = &model.cand[other];
            let clash = if model.cand_device(other) == device {
                o.role != c.role
            } else {
                !agree(o.holder, c.holder) || o.signal != c.signal
            };
            if clash {
                self.remove_cand(model, other)?;
            }
        }
        Ok(())
    }
}
