//! Reads a wiring off the flow: the flow and the domains in, complete choices or what to branch on
//! out.
#![expect(clippy::indexing_slicing, reason = "all ids come from the model")]

use crate::model::{Kind, NONE, agree};
use crate::search::branching::Branch;
use crate::search::{Choices, Engine};

const NOBODY: usize = NONE;

/// Who holds what while a wiring is read off the flow.
#[derive(Clone, Debug)]
pub(crate) struct Scratch {
    resource: Vec<(usize, usize)>,
    pin: Vec<(usize, usize, usize)>,
    touched_resources: Vec<usize>,
    touched_pins: Vec<usize>,
}

impl Scratch {
    pub(crate) fn new(resources: usize, pins: usize) -> Self {
        Self {
            resource: vec![(NOBODY, 0); resources],
            pin: vec![(NOBODY, 0, 0); pins],
            touched_resources: Vec::new(),
            touched_pins: Vec::new(),
        }
    }
}

impl Engine<'_> {
    /// Reads a wiring off the flow, or tells what to branch on.
    pub(crate) fn read(&mut self) -> Result<Choices, Option<Branch>> {
        let model = self.model;
        let mut choices = Choices::with_capacity(model.devices);
        let mut wires = vec![NONE; model.wires];
        let mut fault = None;
        // Decided devices first: the others adapt.
        let order = (0..model.devices).filter(|&d| self.domains.device_left(d) == 1);
        let order: Vec<usize> =
            order.chain((0..model.devices).filter(|&d| self.domains.device_left(d) > 1)).collect();
        choices.resize(model.devices, (NONE, Vec::new()));
        for device in order {
            match self.read_device(device, &mut wires) {
                Ok(choice) => choices[device] = choice,
                Err(culprit) => {
                    fault = Some((device, culprit));
                    break;
                }
            }
        }
        for resource in self.scratch.touched_resources.drain(..) {
            self.scratch.resource[resource] = (NOBODY, 0);
        }
        for pin in self.scratch.touched_pins.drain(..) {
            self.scratch.pin[pin] = (NOBODY, 0, 0);
        }
        if let Some((device, culprit)) = fault {
            return Err(self.blame(device, culprit));
        }
        if model.dma_matters && !self.dma_fits(&choices) {
            let uses = |d: &usize| {
                self.domains.device_left(*d) > 1
                    && self.domains.alts(model, *d).any(|a| !model.alt_dma.at(a).is_empty())
            };
            let device = (0..model.devices).find(uses);
            return Err(device.map(|d| Branch::Alt(choices[d].0)));
        }
        Ok(choices)
    }

    /// A device that cannot follow the flow is to choose; if it has chosen, its opponent is.
    fn blame(&self, device: usize, culprit: usize) -> Option<Branch> {
        let model = self.model;
        for d in [device, culprit] {
            if d != NOBODY && self.domains.device_left(d) > 1 {
                return self.preferred(d).map(Branch::Alt);
            }
        }
        let culprit = (culprit != NOBODY).then_some(culprit);
        self.open_role(device)
            .or_else(|| culprit.and_then(|d| self.open_role(d)))
            .or_else(|| self.any_branch())
            .filter(|_| model.devices > 0)
    }

    /// The alternative that the flow would give the device.
    fn preferred(&self, device: usize) -> Option<usize> {
        let model = self.model;
        let positions = 0..model.demand[device + 1] - model.demand[device];
        let mut flow = positions
            .filter_map(|p| self.flow.at(model, device, p))
            .map(|(_, id)| model.cand_alt(id))
            .filter(|&alt| model.alt_device[alt] == device && self.domains.alt_on(alt));
        flow.next().or_else(|| self.domains.alts(model, device).next())
    }

    fn read_device(
        &mut self,
        device: usize,
        wires: &mut [usize],
    ) -> Result<(usize, Vec<usize>), usize> {
        let model = self.model;
        let first = self.preferred(device);
        let mut culprit = NOBODY;
        let others = self.domains.alts(model, device).filter(|a| Some(*a) != first);
        let alts: Vec<usize> = first.into_iter().chain(others).collect();
        for alt in alts {
            let resources = self.scratch.touched_resources.len();
            let pins = self.scratch.touched_pins.len();
            match self.read_alt(device, alt, wires) {
                Ok(cands) => {
                    for (role, &id) in model.roles.range(alt).zip(&cands) {
                        if let Kind::Wire(wire) = model.role_kind[role] {
                            wires[wire] = model.cand(id).pin;
                        }
                    }
                    return Ok((alt, cands));
                }
                Err(opponent) => {
                    if culprit == NOBODY {
                        culprit = opponent;
                    }
                    for r in self.scratch.touched_resources.drain(resources..) {
                        self.scratch.resource[r] = (NOBODY, 0);
                    }
                    for p in self.scratch.touched_pins.drain(pins..) {
                        self.scratch.pin[p] = (NOBODY, 0, 0);
                    }
                }
            }
        }
        Err(culprit)
    }

    fn read_alt(
        &mut self,
        device: usize,
        alt: usize,
        wires: &[usize],
    ) -> Result<Vec<usize>, usize> {
        let model = self.model;
        self.hold_all(device, model.alt_claims.at(alt))?;
        let mut cands = Vec::with_capacity(model.roles.range(alt).len());
        for (position, role) in model.roles.range(alt).enumerate() {
            let flow = self.flow.at(model, device, position).map(|(pin, _)| pin);
            let wanted = match model.role_kind[role] {
                _ if self.domains.role_left(role) == 1 => None,
                Kind::Own => flow,
                Kind::Wire(wire) => self
                    .flow
                    .wire(model, wire)
                    .or(Some(wires[wire]).filter(|p| *p != NONE))
                    .or(flow),
                Kind::Odd => None,
            };
            let mut culprit = NOBODY;
            let mut found = None;
            for id in model.cands.range(role) {
                if !self.domains.cand_on(model, id) {
                    continue;
                }
                let pin = model.cand(id).pin;
                let twice = cands.iter().any(|&c: &usize| model.cand(c).pin == pin);
                if twice || wanted.is_some_and(|wanted| wanted != pin) {
                    continue;
                }
                match self.hold_cand(device, id) {
                    Ok(()) => {
                        found = Some(id);
                        break;
                    }
                    Err(opponent) => culprit = opponent,
                }
            }
            cands.push(found.ok_or(culprit)?);
        }
        Ok(cands)
    }

    fn hold_cand(&mut self, device: usize, id: usize) -> Result<(), usize> {
        let model = self.model;
        let c = model.cand(id);
        let (holder, code, signal) = self.scratch.pin[c.pin];
        if holder != NOBODY && (!agree(code, c.holder) || signal != c.signal) {
            return Err(holder);
        }
        let mark = self.scratch.touched_resources.len();
        if let Err(opponent) = self.hold_all(device, model.cand_claims.at(id)) {
            for r in self.scratch.touched_resources.drain(mark..) {
                self.scratch.resource[r] = (NOBODY, 0);
            }
            return Err(opponent);
        }
        if holder == NOBODY {
            self.scratch.touched_pins.push(c.pin);
            self.scratch.pin[c.pin] = (device, c.holder, c.signal);
        }
        Ok(())
    }

    fn hold_all(&mut self, device: usize, claims: &[(usize, usize)]) -> Result<(), usize> {
        for &(resource, code) in claims {
            let (holder, held) = self.scratch.resource[resource];
            if holder == NOBODY {
                self.scratch.resource[resource] = (device, code);
                self.scratch.touched_resources.push(resource);
            } else if holder == device {
                // One device with two holders shares with nobody.
                if held != code {
                    self.scratch.resource[resource] = (device, 0);
                }
            } else if !agree(held, code) {
                return Err(holder);
            }
        }
        Ok(())
    }
}
