//! Flattens a problem: makes one vector for each property from nested vectors, and lists the users
//! of each pin, resource, rule and board.

use crate::index::{AltId, Id, IdVec, Rows};
use crate::model::{Cand, Model, Part, agree};
use crate::problem::{Alternative, Claim, DeviceId, Holder, Problem, ResourceId, Role};

impl Model {
    pub(super) fn flatten(&mut self, problem: &Problem) {
        let contested = contested(problem);
        for (device, d) in problem.devices.iter().enumerate() {
            for a in &d.alternatives {
                self.flatten_alternative(DeviceId::new(device), a, &contested);
            }
            self.alts.close(self.alt_device.len());
        }
    }

    fn flatten_alternative(
        &mut self,
        device: DeviceId,
        a: &Alternative,
        contested: &IdVec<ResourceId, bool>,
    ) {
        let alt = self.alt_device.push(device);
        self.alt_board.push(a.board);
        self.alt_claims.push(a.claims.iter().filter(|c| contested[c.resource]).copied());
        self.alt_groups.push(a.claims.iter().filter(|c| c.holder != Holder::Own).copied());
        self.alt_rules.push(a.violates.iter().copied());
        let dma_matters = self.dma_matters;
        self.alt_dma.push(a.dma.iter().filter(|_| dma_matters).copied());
        for r in &a.roles {
            self.flatten_role(alt, r, contested);
        }
        self.roles.close(self.role_alt.len());
    }

    fn flatten_role(&mut self, alt: AltId, r: &Role, contested: &IdVec<ResourceId, bool>) {
        let role = self.role_alt.push(alt);
        for c in &r.candidates {
            self.cand.push(Cand {
                role,
                pin: c.pin,
                holder: c.holder,
                signal: c.signal,
                moved: c.moved,
                extra: if c.moved { self.weights.moved } else { 0 },
                gate: None,
            });
            self.cand_claims.push(c.claims.iter().filter(|c| contested[c.resource]).copied());
            self.cand_rules.push(c.violates.iter().copied());
        }
        self.cands.close(self.cand.len());
    }

    /// Finds the users of each pin, resource, rule and board.
    pub(super) fn invert(&mut self, problem: &Problem) {
        let mut pins = Vec::with_capacity(self.cand.len());
        let mut resources = Vec::new();
        let mut rules = Vec::new();
        let mut boards = Vec::new();
        let user = |part: Part| move |claim: &Claim| (claim.resource, (part, claim.holder));
        for (alt, &board) in self.alt_board.enumerate() {
            let part = Part::Alt(alt);
            resources.extend(self.alt_claims[alt].iter().map(user(part)));
            rules.extend(self.alt_rules[alt].iter().map(|&rule| (rule, part)));
            boards.push((board, alt));
        }
        for (id, c) in self.cand.enumerate() {
            let part = Part::Cand(id);
            pins.push((c.pin, id));
            resources.extend(self.cand_claims[id].iter().map(user(part)));
            rules.extend(self.cand_rules[id].iter().map(|&rule| (rule, part)));
        }
        self.pin_cands = Rows::collect(self.pins.len(), &pins);
        self.resource_users = Rows::collect(problem.resources as usize, &resources);
        self.rule_users = Rows::collect(problem.rules as usize, &rules);
        self.board_alts = Rows::collect(problem.boards.len(), &boards);
    }
}

/// Resources over which two devices can be in conflict.
fn contested(problem: &Problem) -> IdVec<ResourceId, bool> {
    let resources = problem.resources as usize;
    let mut first: IdVec<ResourceId, Option<(usize, Holder)>> = IdVec::same(None, resources);
    let mut contested = IdVec::same(false, resources);
    for (device, d) in problem.devices.iter().enumerate() {
        for a in &d.alternatives {
            let wires = a.roles.iter().flat_map(|r| &r.candidates).flat_map(|c| &c.claims);
            for &Claim { resource, holder } in a.claims.iter().chain(wires) {
                match first[resource] {
                    None => first[resource] = Some((device, holder)),
                    Some((d, h)) => contested[resource] |= d != device && !agree(h, holder),
                }
                // One device with two holders: record that it cannot share.
                if first[resource].is_some_and(|(d, h)| d == device && h != holder) {
                    first[resource] = Some((device, Holder::Own));
                }
            }
        }
    }
    contested
}
