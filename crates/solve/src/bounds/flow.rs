//! The bound: every wire that must exist gets a pin of its own at least total cost.
//!
//! Domains in, a cheapest flow wire -> (gate) -> pin out, or the wires for which there is none. A
//! gate is a resource of one holder (a timer, an interrupt line) that the wires of different
//! devices pass one at a time. The flow forgets that a device's roles must agree on one
//! alternative and that groups exclude each other, so its cost is a lower bound; whoever takes it
//! for a wiring must check it. It stays optimal while domains shrink by rerouting only the wires
//! that lost their pin.
#![expect(clippy::indexing_slicing, reason = "all ids come from the model")]

use crate::domains::{Dead, Domains};
use crate::model::{Kind, Model, NONE};
use std::collections::VecDeque;

const FAR: i64 = i64::MAX / 2;

/// What a search returns to.
#[derive(Clone, Debug)]
pub(crate) struct Saved {
    /// Candidate by which a demand leaves.
    arc: Vec<usize>,
    /// Demand that holds a pin, or gate + number of demands.
    owner: Vec<usize>,
    gate_in: Vec<usize>,
    gate_out: Vec<usize>,
    active: Vec<bool>,
    cost: i64,
}

/// The flow. Demands are the role positions of all devices, then the shared wires.
#[derive(Clone, Debug)]
pub(crate) struct Flow {
    now: Saved,
    demands: usize,
    /// Device position that is a wire of its own in every alternative.
    always: Vec<bool>,
    /// Role whose candidates stand for a shared wire.
    wire_role: Vec<usize>,
    wire_covered: Vec<bool>,
    wanted: Vec<bool>,
    dist: Vec<i64>,
    from: Vec<(usize, usize)>,
    queue: VecDeque<usize>,
    queued: Vec<bool>,
    path: Vec<(usize, usize, usize)>,
}

#[derive(Clone, Copy)]
enum Node {
    Demand(usize),
    GateIn(usize),
    GateOut(usize),
    Pin(usize),
}

impl Flow {
    pub(crate) fn new(model: &Model) -> Self {
        let devices = model.demand.last().copied().unwrap_or(0);
        let demands = devices + model.wires;
        let nodes = demands + 2 * model.gates + model.pins;
        let mut always = vec![false; devices];
        for device in 0..model.devices {
            for (position, demand) in (model.demand[device]..model.demand[device + 1]).enumerate() {
                always[demand] = model.alts.range(device).all(|alt| {
                    let role = model.roles.range(alt).start + position;
                    position < model.roles.range(alt).len() && model.role_kind[role] == Kind::Own
                });
            }
        }
        Self {
            now: Saved {
                arc: vec![NONE; demands],
                owner: vec![NONE; model.pins],
                gate_in: vec![NONE; model.gates],
                gate_out: vec![NONE; model.gates],
                active: vec![false; demands],
                cost: 0,
            },
            demands,
            always,
            wire_role: vec![NONE; model.wires],
            wire_covered: vec![false; model.wires],
            wanted: vec![false; demands],
            dist: vec![FAR; nodes],
            from: vec![(NONE, NONE); nodes],
            queue: VecDeque::new(),
            queued: vec![false; nodes],
            path: Vec::new(),
        }
    }

    pub(crate) fn save(&self) -> Saved {
        self.now.clone()
    }

    pub(crate) fn restore(&mut self, saved: &Saved) {
        self.now.clone_from(saved);
    }

    pub(crate) fn cost(&self) -> u64 {
        self.now.cost as u64
    }

    /// Pin and candidate of a role position of a device, when the flow has it.
    pub(crate) fn at(
        &self,
        model: &Model,
        device: usize,
        position: usize,
    ) -> Option<(usize, usize)> {
        let demand = model.demand[device] + position;
        self.now.active[demand].then(|| (self.pin_of(model, demand), self.now.arc[demand]))
    }

    /// Pin of a shared wire, when a decided device wants it.
    pub(crate) fn wire(&self, model: &Model, wire: usize) -> Option<usize> {
        let demand = model.demand[model.devices] + wire;
        self.now.active[demand].then(|| self.pin_of(model, demand))
    }

    fn pin_of(&self, model: &Model, demand: usize) -> usize {
        let c = model.cand(self.now.arc[demand]);
        if c.gate == NONE { c.pin } else { self.now.gate_out[c.gate] }
    }

    /// Brings the flow up to date with the domains.
    ///
    /// # Errors
    /// [`Dead`] when a wire finds no pin; [`Self::stuck`] then tells whose.
    pub(crate) fn refresh(&mut self, model: &Model, domains: &Domains) -> Result<(), Dead> {
        self.find_wanted(model, domains);
        // Taking one demand out can move another into a gate whose pin is no longer possible.
        let mut changed = true;
        while changed {
            changed = false;
            for demand in 0..self.demands {
                if self.now.active[demand]
                    && (!self.wanted[demand] || !self.holds(model, domains, demand))
                {
                    self.withdraw(model, domains, demand);
                    changed = model.gates > 0;
                }
            }
        }
        for demand in 0..self.demands {
            if self.wanted[demand] && !self.now.active[demand] {
                self.augment(model, domains, demand)?;
            }
        }
        Ok(())
    }

    fn find_wanted(&mut self, model: &Model, domains: &Domains) {
        let devices = model.demand[model.devices];
        self.wanted[..devices].copy_from_slice(&self.always);
        if self.wanted.len() == devices && self.always.iter().all(|a| *a) {
            return;
        }
        self.wanted[devices..].fill(false);
        self.wire_role.fill(NONE);
        self.wire_covered.fill(false);
        for device in 0..model.devices {
            let Some(alt) = domains.decided(device) else { continue };
            for (position, role) in model.roles.range(alt).enumerate() {
                match model.role_kind[role] {
                    Kind::Own => self.wanted[model.demand[device] + position] = true,
                    Kind::Wire(wire) => {
                        self.wanted[devices + wire] = true;
                        self.wire_covered[wire] = true;
                        if self.wire_role[wire] == NONE {
                            self.wire_role[wire] = role;
                        }
                    }
                    Kind::Odd => {}
                }
            }
        }
        for device in 0..model.devices {
            if domains.decided(device).is_none() {
                self.want_undecided(model, domains, device);
            }
        }
    }

    /// A device that may still choose wants the role positions that are its own in every
    /// alternative, and shared ones as long as nobody it might join has them.
    fn want_undecided(&mut self, model: &Model, domains: &Domains, device: usize) {
        let demands = model.demand[device]..model.demand[device + 1];
        if demands.clone().all(|d| self.always[d]) {
            return;
        }
        let wires = |alt: usize| {
            model.roles.range(alt).filter_map(|role| match model.role_kind[role] {
                Kind::Wire(wire) => Some(wire),
                Kind::Own | Kind::Odd => None,
            })
        };
        let free = domains.alts(model, device).flat_map(wires).all(|w| !self.wire_covered[w]);
        for (position, demand) in demands.enumerate() {
            let kind = |alt: usize| {
                let role = model.roles.range(alt).start + position;
                let exists = position < model.roles.range(alt).len();
                if exists { model.role_kind[role] } else { Kind::Odd }
            };
            let mut kinds = domains.alts(model, device).map(kind);
            self.wanted[demand] = kinds.clone().all(|k| k == Kind::Own)
                || (free && kinds.all(|k| matches!(k, Kind::Wire(_))));
        }
        if free {
            for wire in domains.alts(model, device).flat_map(wires) {
                self.wire_covered[wire] = true;
            }
        }
    }

    /// The candidates a demand may leave by.
    fn arcs<'a>(&self, model: &'a Model, demand: usize) -> Arcs<'a> {
        let devices = model.demand[model.devices];
        if demand < devices {
            Arcs::List(model.demand_cands.at(demand).iter())
        } else {
            let role = self.wire_role[demand - devices];
            Arcs::Range(if role == NONE { 0..0 } else { model.cands.range(role) })
        }
    }

    /// Whether the demand may stay where it is.
    fn holds(&self, model: &Model, domains: &Domains, demand: usize) -> bool {
        let held = self.now.arc[demand];
        let c = model.cand(held);
        let straight = c.gate == NONE || self.now.gate_out[c.gate] == c.pin;
        if straight && demand < model.demand[model.devices] && domains.cand_on(model, held) {
            return true;
        }
        if c.gate == NONE {
            // The representative of a shared wire changes; any candidate on the pin will do.
            return self.arcs(model, demand).any(|id| {
                domains.cand_on(model, id)
                    && model.cand(id).pin == c.pin
                    && model.cand(id).extra == c.extra
            });
        }
        let pin = self.now.gate_out[c.gate];
        let enters = |id: usize| {
            let o = model.cand(id);
            o.gate == c.gate && o.extra == c.extra && domains.cand_on(model, id)
        };
        let leaves = |id: &usize| model.cand(*id).pin == pin && domains.cand_on(model, *id);
        self.arcs(model, demand).any(enters) && model.gate_cands.at(c.gate).iter().any(leaves)
    }

    fn node(&self, model: &Model, index: usize) -> Node {
        let pins = self.demands + 2 * model.gates;
        if index < self.demands {
            Node::Demand(index)
        } else if index >= pins {
            Node::Pin(index - pins)
        } else if (index - self.demands).is_multiple_of(2) {
            Node::GateIn((index - self.demands) / 2)
        } else {
            Node::GateOut((index - self.demands) / 2)
        }
    }

    fn gate_in(&self, gate: usize) -> usize {
        self.demands + 2 * gate
    }

    fn pin(&self, model: &Model, pin: usize) -> usize {
        self.demands + 2 * model.gates + pin
    }

    fn reach(&mut self, node: usize, dist: i64, from: usize, cand: usize) {
        if dist < self.dist[node] {
            self.dist[node] = dist;
            self.from[node] = (from, cand);
            if !self.queued[node] {
                self.queued[node] = true;
                self.queue.push_back(node);
            }
        }
    }

    /// Shortest residual paths from what is queued (label correcting; most arcs cost nothing).
    fn explore(&mut self, model: &Model, domains: &Domains) {
        while let Some(index) = self.queue.pop_front() {
            self.queued[index] = false;
            let dist = self.dist[index];
            match self.node(model, index) {
                Node::Demand(demand) => {
                    let held = self.now.arc[demand];
                    let held = if held == NONE { NONE } else { self.entry(model, held) };
                    for id in self.arcs(model, demand) {
                        if !domains.cand_on(model, id) {
                            continue;
                        }
                        let target = self.entry(model, id);
                        if target != held {
                            self.reach(target, dist + model.cand(id).extra as i64, index, id);
                        }
                    }
                }
                Node::Pin(pin) => {
                    let owner = self.now.owner[pin];
                    if owner == NONE {
                        continue;
                    }
                    if owner < self.demands {
                        let extra = model.cand(self.now.arc[owner]).extra as i64;
                        self.reach(owner, dist - extra, index, NONE);
                    } else {
                        let out = self.gate_in(owner - self.demands) + 1;
                        self.reach(out, dist, index, NONE);
                    }
                }
                Node::GateIn(gate) => {
                    let demand = self.now.gate_in[gate];
                    if demand == NONE {
                        self.reach(index + 1, dist, index, NONE);
                    } else {
                        let extra = model.cand(self.now.arc[demand]).extra as i64;
                        self.reach(demand, dist - extra, index, NONE);
                    }
                }
                Node::GateOut(gate) => {
                    for &id in model.gate_cands.at(gate) {
                        let pin = model.cand(id).pin;
                        if pin != self.now.gate_out[gate] && domains.cand_on(model, id) {
                            self.reach(self.pin(model, pin), dist, index, id);
                        }
                    }
                    if self.now.gate_in[gate] != NONE {
                        self.reach(index - 1, dist, index, NONE);
                    }
                }
            }
        }
    }

    /// Where a candidate's arc leads.
    fn entry(&self, model: &Model, id: usize) -> usize {
        let c = model.cand(id);
        if c.gate == NONE { self.pin(model, c.pin) } else { self.gate_in(c.gate) }
    }

    fn augment(&mut self, model: &Model, domains: &Domains, demand: usize) -> Result<(), Dead> {
        self.dist.fill(FAR);
        self.reach(demand, 0, NONE, NONE);
        self.explore(model, domains);
        let first = self.pin(model, 0);
        let mut best = (FAR, NONE);
        for pin in 0..model.pins {
            if self.now.owner[pin] == NONE && self.dist[first + pin] < FAR {
                let dist = self.dist[first + pin] + model.pin_weight[pin] as i64;
                best = best.min((dist, first + pin));
            }
        }
        if best.1 == NONE {
            return Err(Dead);
        }
        self.now.active[demand] = true;
        self.now.cost += best.0;
        self.apply(model, best.1);
        Ok(())
    }

    /// Takes a demand out of the flow, at the greatest gain.
    fn withdraw(&mut self, model: &Model, domains: &Domains, demand: usize) {
        self.dist.fill(FAR);
        for pin in 0..model.pins {
            if self.now.owner[pin] != NONE {
                self.reach(self.pin(model, pin), -(model.pin_weight[pin] as i64), NONE, NONE);
            }
        }
        self.explore(model, domains);
        self.now.active[demand] = false;
        self.now.cost += self.dist[demand];
        self.apply(model, demand);
        self.now.arc[demand] = NONE;
    }

    /// Reroutes along the path found to `last`.
    fn apply(&mut self, model: &Model, last: usize) {
        self.path.clear();
        let mut node = last;
        while self.from[node].0 != NONE {
            let (from, cand) = self.from[node];
            self.path.push((from, node, cand));
            node = from;
        }
        // A path that starts at a pin frees it first.
        if let Node::Pin(pin) = self.node(model, node) {
            self.now.owner[pin] = NONE;
        }
        while let Some((from, to, cand)) = self.path.pop() {
            match (self.node(model, from), self.node(model, to)) {
                (Node::Demand(demand), Node::Pin(pin)) => {
                    self.now.arc[demand] = cand;
                    self.now.owner[pin] = demand;
                }
                (Node::Demand(demand), Node::GateIn(gate)) => {
                    self.now.arc[demand] = cand;
                    self.now.gate_in[gate] = demand;
                }
                (Node::GateOut(gate), Node::Pin(pin)) => {
                    self.now.gate_out[gate] = pin;
                    self.now.owner[pin] = self.demands + gate;
                }
                (Node::GateOut(gate), Node::GateIn(_)) => {
                    self.now.gate_in[gate] = NONE;
                    self.now.gate_out[gate] = NONE;
                }
                _ => {}
            }
        }
    }

    /// Devices that fight for too few pins, after [`Self::refresh`] failed.
    pub(crate) fn stuck(&self, model: &Model) -> Vec<usize> {
        let reached = |d: &usize| {
            (model.demand[*d]..model.demand[*d + 1]).any(|demand| self.dist[demand] < FAR)
        };
        (0..model.devices).filter(reached).collect()
    }
}

/// Candidates of a demand.
enum Arcs<'a> {
    List(std::slice::Iter<'a, usize>),
    Range(std::ops::Range<usize>),
}

impl Iterator for Arcs<'_> {
    type Item = usize;

    fn next(&mut self) -> Option<usize> {
        match self {
            Self::List(list) => list.next().copied(),
            Self::Range(range) => range.next(),
        }
    }
}
