//! Reads a wiring off the flow: the flow and the domains in, complete choices or a choice to branch
//! on out.
//!
//! If the relaxation already gives an answer, no search is needed.

use super::Engine;
use super::branch::Branch;
use crate::domains::streams;
use crate::index::{AltId, CandId, IdVec, RoleId, WireId};
use crate::model::{Choices, Chosen, Holding, Model, agree};
use crate::problem::{Claim, DeviceId, Holder, PinId, Problem, ResourceId, SignalId};

/// The holders of pins and resources while a wiring is read off the flow.
#[derive(Clone, Debug)]
pub(super) struct Holders {
    resource: IdVec<ResourceId, Option<(DeviceId, Holder)>>,
    pin: IdVec<PinId, Option<(DeviceId, Holder, SignalId)>>,
    held_resources: Vec<ResourceId>,
    held_pins: Vec<PinId>,
}

/// The numbers of resources and pins held at some point.
#[derive(Clone, Copy, Default)]
struct Mark {
    resources: usize,
    pins: usize,
}

impl Holders {
    pub(super) fn new(problem: &Problem, model: &Model) -> Self {
        Self {
            resource: IdVec::same(None, problem.resources as usize),
            pin: IdVec::same(None, model.pins.len()),
            held_resources: Vec::new(),
            held_pins: Vec::new(),
        }
    }

    fn mark(&self) -> Mark {
        Mark { resources: self.held_resources.len(), pins: self.held_pins.len() }
    }

    fn release(&mut self, mark: Mark) {
        for resource in self.held_resources.drain(mark.resources..) {
            self.resource[resource] = None;
        }
        for pin in self.held_pins.drain(mark.pins..) {
            self.pin[pin] = None;
        }
    }

    /// The device takes the pin and claims of a candidate.
    ///
    /// # Errors
    /// The device that already holds one of them.
    fn hold_cand(&mut self, model: &Model, device: DeviceId, id: CandId) -> Result<(), DeviceId> {
        let c = &model.cand[id];
        let held = self.pin[c.pin];
        if let Some((opponent, holder, signal)) = held
            && (!agree(holder, c.holder) || signal != c.signal)
        {
            return Err(opponent);
        }
        let mark = self.mark();
        if let Err(opponent) = self.hold_all(device, &model.cand_claims[id]) {
            self.release(mark);
            return Err(opponent);
        }
        if held.is_none() {
            self.held_pins.push(c.pin);
            self.pin[c.pin] = Some((device, c.holder, c.signal));
        }
        Ok(())
    }

    fn hold_all(&mut self, device: DeviceId, claims: &[Claim]) -> Result<(), DeviceId> {
        for &Claim { resource, holder } in claims {
            match self.resource[resource] {
                None => {
                    self.resource[resource] = Some((device, holder));
                    self.held_resources.push(resource);
                }
                // A device with two holders cannot share.
                Some((owner, held)) if owner == device => {
                    if held != holder {
                        self.resource[resource] = Some((device, Holder::Own));
                    }
                }
                Some((owner, held)) if !agree(held, holder) => return Err(owner),
                Some(_) => {}
            }
        }
        Ok(())
    }
}

impl Engine<'_> {
    /// Reads a wiring off the flow, or returns what to branch on.
    pub(super) fn read(&mut self) -> Result<Choices, Option<Branch>> {
        let model = self.model;
        let mut choices: IdVec<DeviceId, Option<Chosen>> = IdVec::same(None, model.devices.len());
        let mut wires = IdVec::same(None, model.wires.len());
        let mut fault = None;
        // Decided devices first: the others adapt.
        let decided = |d: &DeviceId| self.domains.alts_left(*d) == 1;
        let (first, others): (Vec<DeviceId>, Vec<DeviceId>) =
            model.devices.iter().partition(decided);
        for device in first.into_iter().chain(others) {
            match self.read_device(device, &mut wires) {
                Ok(chosen) => choices[device] = Some(chosen),
                Err(opponent) => {
                    fault = Some((device, opponent));
                    break;
                }
            }
        }
        self.holders.release(Mark::default());
        if let Some((device, opponent)) = fault {
            return Err(self.blame(device, opponent));
        }
        let choices: Choices = choices.into_iter().flatten().collect();
        if model.dma_matters && !streams::suffice(self.problem, model, &choices) {
            let uses = |d: &DeviceId| {
                self.domains.alts_left(*d) > 1
                    && self.domains.alts(model, *d).any(|alt| !model.alt_dma[alt].is_empty())
            };
            let device = model.devices.iter().find(uses);
            return Err(device.map(|d| Branch::Alt(choices[d].alt)));
        }
        Ok(choices)
    }

    /// Branches on a device that cannot follow the flow, or on its opponent if the device is
    /// decided.
    fn blame(&self, device: DeviceId, opponent: Option<DeviceId>) -> Option<Branch> {
        for d in [Some(device), opponent].into_iter().flatten() {
            if self.domains.alts_left(d) > 1 {
                return self.preferred(d).map(Branch::Alt);
            }
        }
        self.open_role(device)
            .or_else(|| opponent.and_then(|d| self.open_role(d)))
            .or_else(|| self.any_branch())
    }

    /// The alternative that the flow would give the device.
    fn preferred(&self, device: DeviceId) -> Option<AltId> {
        let model = self.model;
        let positions = 0..model.demands.of(device).len();
        let mut flow = positions
            .filter_map(|p| self.flow.at(model, device, p))
            .map(|(_, id)| model.cand_alt(id))
            .filter(|&alt| model.alt_device[alt] == device && self.domains.has_alt(alt));
        flow.next().or_else(|| self.domains.alts(model, device).next())
    }

    /// The choice of the device, or the device that is in its way, if it is a device.
    fn read_device(
        &mut self,
        device: DeviceId,
        wires: &mut IdVec<WireId, Option<PinId>>,
    ) -> Result<Chosen, Option<DeviceId>> {
        let model = self.model;
        let first = self.preferred(device);
        let mut opponent = None;
        let others = self.domains.alts(model, device).filter(|a| Some(*a) != first);
        let alts: Vec<AltId> = first.into_iter().chain(others).collect();
        for alt in alts {
            let mark = self.holders.mark();
            match self.read_alt(device, alt, wires) {
                Ok(cands) => {
                    for (role, &id) in model.roles.of(alt).iter().zip(&cands) {
                        if let Holding::Wire(wire) = model.holding[role] {
                            wires[wire] = Some(model.cand[id].pin);
                        }
                    }
                    return Ok(Chosen { alt, cands });
                }
                Err(culprit) => {
                    opponent = opponent.or(culprit);
                    self.holders.release(mark);
                }
            }
        }
        Err(opponent)
    }

    fn read_alt(
        &mut self,
        device: DeviceId,
        alt: AltId,
        wires: &IdVec<WireId, Option<PinId>>,
    ) -> Result<Vec<CandId>, Option<DeviceId>> {
        let model = self.model;
        self.holders.hold_all(device, &model.alt_claims[alt])?;
        let mut cands: Vec<CandId> = Vec::with_capacity(model.roles.of(alt).len());
        for (position, role) in model.roles.of(alt).iter().enumerate() {
            let wanted = self.wanted_pin(device, position, role, wires);
            let mut opponent = None;
            let mut found = None;
            for id in model.cands.of(role) {
                if !self.domains.has_cand(model, id) {
                    continue;
                }
                let pin = model.cand[id].pin;
                let twice = cands.iter().any(|&c| model.cand[c].pin == pin);
                if twice || wanted.is_some_and(|wanted| wanted != pin) {
                    continue;
                }
                match self.holders.hold_cand(model, device, id) {
                    Ok(()) => {
                        found = Some(id);
                        break;
                    }
                    Err(culprit) => opponent = Some(culprit),
                }
            }
            cands.push(found.ok_or(opponent)?);
        }
        Ok(cands)
    }

    /// The pin that the flow has for a role, if the role still has a choice.
    fn wanted_pin(
        &self,
        device: DeviceId,
        position: usize,
        role: RoleId,
        wires: &IdVec<WireId, Option<PinId>>,
    ) -> Option<PinId> {
        if self.domains.cands_left(role) == 1 {
            return None;
        }
        let flow = || self.flow.at(self.model, device, position).map(|(pin, _)| pin);
        match self.model.holding[role] {
            Holding::Own => flow(),
            Holding::Wire(wire) => self.flow.wire(self.model, wire).or(wires[wire]).or_else(flow),
            Holding::Irregular => None,
        }
    }
}
