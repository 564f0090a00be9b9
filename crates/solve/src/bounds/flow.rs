//! The assignment bound: every wire that must exist gets a pin of its own at the least total cost.
//!
//! Computes a cheapest flow wire -> (gate) -> pin from the domains, or finds the wires for which
//! there is none. A gate is a resource of one holder (a timer, an interrupt line) that the wires of
//! different devices pass one at a time. The flow ignores that a device's roles must agree on one
//! alternative and that groups exclude each other, so its cost is a lower bound; a caller that
//! takes it for a wiring must check it.
//!
//! The method is successive shortest paths with label correction (R. K. Ahuja, T. L. Magnanti and
//! J. B. Orlin, *Network Flows*, 1993, ch. 9). While domains shrink, the flow is kept optimal by
//! rerouting only the wires that lost their pin; such a bound within constraint programming is from
//! F. Focacci, A. Lodi and M. Milano, *Cost-based domain filtering*, 1999.

mod network;

use self::network::{Layout, Node};
use crate::domains::{Domains, Pruned};
use crate::index::{AltId, CandId, DemandId, GateId, IdIter, IdVec, NodeId, RoleId, WireId};
use crate::model::{Cand, Holding, Model};
use crate::problem::{DeviceId, PinId};
use std::collections::VecDeque;

/// The distance of a node that is not reached.
const FAR: i64 = i64::MAX / 2;

/// The holder of a pin.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Owner {
    Demand(DemandId),
    Gate(GateId),
}

/// The state that a search returns to.
#[derive(Debug)]
pub(crate) struct Saved {
    /// The candidate whose arc a demand takes.
    arc: IdVec<DemandId, Option<CandId>>,
    owner: IdVec<PinId, Option<Owner>>,
    /// The demand that passes a gate, and the pin that it goes on to.
    gate_in: IdVec<GateId, Option<DemandId>>,
    gate_out: IdVec<GateId, Option<PinId>>,
    active: IdVec<DemandId, bool>,
    cost: i64,
}

impl Clone for Saved {
    fn clone(&self) -> Self {
        Self {
            arc: self.arc.clone(),
            owner: self.owner.clone(),
            gate_in: self.gate_in.clone(),
            gate_out: self.gate_out.clone(),
            active: self.active.clone(),
            cost: self.cost,
        }
    }

    /// Reuses the memory.
    fn clone_from(&mut self, other: &Self) {
        self.arc.clone_from(&other.arc);
        self.owner.clone_from(&other.owner);
        self.gate_in.clone_from(&other.gate_in);
        self.gate_out.clone_from(&other.gate_out);
        self.active.clone_from(&other.active);
        self.cost = other.cost;
    }
}

/// The last arc of a shortest path: the node before, and the candidate if it is one.
type Arc = (NodeId, Option<CandId>);

/// The flow. Demands are the role positions of all devices, then the shared wires.
#[derive(Clone, Debug)]
pub(crate) struct Flow {
    now: Saved,
    layout: Layout,
    /// Pins, those with the greatest weight first.
    dear_first: Vec<PinId>,
    /// Whether only the arc to a free pin costs anything.
    arcs_are_free: bool,
    /// Demands that are an unshared wire in every alternative.
    always: IdVec<DemandId, bool>,
    /// Role whose candidates represent a shared wire.
    wire_role: IdVec<WireId, Option<RoleId>>,
    wire_covered: IdVec<WireId, bool>,
    wanted: IdVec<DemandId, bool>,
    dist: IdVec<NodeId, i64>,
    from: IdVec<NodeId, Option<Arc>>,
    queue: VecDeque<NodeId>,
    queued: IdVec<NodeId, bool>,
    path: Vec<(NodeId, NodeId, Option<CandId>)>,
}

impl Flow {
    pub(crate) fn new(model: &Model) -> Self {
        let device_demands = model.demands.total();
        let demands = device_demands + model.wires.len();
        let gates = model.gates.len();
        let nodes = demands + 2 * gates + model.pins.len();
        let mut dear_first: Vec<PinId> = model.pins.iter().collect();
        dear_first.sort_by_key(|&pin| std::cmp::Reverse(model.pin_weight[pin]));
        let mut always = IdVec::same(false, demands);
        for device in model.devices {
            for (position, demand) in model.demands.of(device).iter().enumerate() {
                let own = |alt| own_at(model, alt, position);
                always[demand] = model.alts.of(device).iter().all(own);
            }
        }
        Self {
            now: Saved {
                arc: IdVec::same(None, demands),
                owner: IdVec::same(None, model.pins.len()),
                gate_in: IdVec::same(None, gates),
                gate_out: IdVec::same(None, gates),
                active: IdVec::same(false, demands),
                cost: 0,
            },
            layout: Layout { device_demands, demands, gates },
            dear_first,
            arcs_are_free: model.cand.iter().all(|cand| cand.extra == 0),
            always,
            wire_role: IdVec::same(None, model.wires.len()),
            wire_covered: IdVec::same(false, model.wires.len()),
            wanted: IdVec::same(false, demands),
            dist: IdVec::same(FAR, nodes),
            from: IdVec::same(None, nodes),
            queue: VecDeque::new(),
            queued: IdVec::same(false, nodes),
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

    /// The pin and candidate of a device's role position, if it is in the flow.
    pub(crate) fn at(
        &self,
        model: &Model,
        device: DeviceId,
        position: usize,
    ) -> Option<(PinId, CandId)> {
        let demand = model.demands.of(device).at(position);
        let held = self.now.arc[demand].filter(|_| self.now.active[demand])?;
        Some((self.pin_of(&model.cand[held])?, held))
    }

    /// The pin of a shared wire, if a decided device needs it.
    pub(crate) fn wire(&self, model: &Model, wire: WireId) -> Option<PinId> {
        let demand = self.layout.wire(wire);
        let held = self.now.arc[demand].filter(|_| self.now.active[demand])?;
        self.pin_of(&model.cand[held])
    }

    /// The pin of a demand that takes this candidate's arc.
    fn pin_of(&self, c: &Cand) -> Option<PinId> {
        c.gate.map_or(Some(c.pin), |gate| self.now.gate_out[gate])
    }

    /// Brings the flow up to date with the domains.
    ///
    /// # Errors
    /// [`Pruned`] if there is no pin for a wire; [`Self::stuck`] then lists the devices.
    pub(crate) fn refresh(&mut self, model: &Model, domains: &Domains) -> Result<(), Pruned> {
        self.find_wanted(model, domains);
        // Taking one demand out can move another into a gate whose pin is no longer possible.
        let mut changed = true;
        while changed {
            changed = false;
            for demand in self.wanted.ids() {
                if self.now.active[demand]
                    && (!self.wanted[demand] || !self.holds(model, domains, demand))
                {
                    self.withdraw(model, domains, demand);
                    changed = self.layout.gates > 0;
                }
            }
        }
        for demand in self.wanted.ids() {
            if self.wanted[demand] && !self.now.active[demand] {
                self.augment(model, domains, demand)?;
            }
        }
        Ok(())
    }

    fn find_wanted(&mut self, model: &Model, domains: &Domains) {
        self.wanted.copy_from(&self.always);
        if model.wires.is_empty() && self.always.iter().all(|a| *a) {
            return;
        }
        self.wire_role.fill(None);
        self.wire_covered.fill(false);
        for device in model.devices {
            let Some(alt) = domains.decided(device) else { continue };
            let demands = model.demands.of(device);
            for (role, demand) in model.roles.of(alt).iter().zip(demands) {
                match model.holding[role] {
                    Holding::Own => self.wanted[demand] = true,
                    Holding::Wire(wire) => {
                        self.wanted[self.layout.wire(wire)] = true;
                        self.wire_covered[wire] = true;
                        self.wire_role[wire].get_or_insert(role);
                    }
                    Holding::Irregular => {}
                }
            }
        }
        for device in model.devices {
            if domains.decided(device).is_none() {
                self.want_undecided(model, domains, device);
            }
        }
    }

    /// A device that can still choose needs the role positions that are unshared in every
    /// alternative, and shared ones unless a device that it might join has them.
    fn want_undecided(&mut self, model: &Model, domains: &Domains, device: DeviceId) {
        let demands = model.demands.of(device);
        if demands.iter().all(|d| self.always[d]) {
            return;
        }
        let mut wires = domains.alts(model, device).flat_map(|alt| model.alt_wires(alt));
        let free = wires.all(|wire| !self.wire_covered[wire]);
        for (position, demand) in demands.iter().enumerate() {
            let shared = |alt| {
                let role = model.roles.of(alt).nth(position);
                role.is_some_and(|role| matches!(model.holding[role], Holding::Wire(_)))
            };
            let mut alts = domains.alts(model, device);
            self.wanted[demand] =
                alts.clone().all(|alt| own_at(model, alt, position)) || (free && alts.all(shared));
        }
        if free {
            for wire in domains.alts(model, device).flat_map(|alt| model.alt_wires(alt)) {
                self.wire_covered[wire] = true;
            }
        }
    }

    /// The candidates whose arcs a demand may take.
    fn arcs<'a>(&self, model: &'a Model, demand: DemandId) -> Arcs<'a> {
        match self.layout.wire_of(demand) {
            None => Arcs::Listed(model.demand_cands[demand].iter()),
            Some(wire) => Arcs::OfRole(
                self.wire_role[wire].map(|role| model.cands.of(role)).unwrap_or_default().iter(),
            ),
        }
    }

    /// Whether the domains still allow what the demand has.
    fn holds(&self, model: &Model, domains: &Domains, demand: DemandId) -> bool {
        let Some(held) = self.now.arc[demand] else { return false };
        let c = &model.cand[held];
        let pin = self.pin_of(c);
        let own = self.layout.wire_of(demand).is_none();
        if pin == Some(c.pin) && own && domains.has_cand(model, held) {
            return true;
        }
        let Some(gate) = c.gate else {
            // The representative of a shared wire changes; any candidate on the pin will do.
            return self.arcs(model, demand).any(|id| {
                domains.has_cand(model, id)
                    && model.cand[id].pin == c.pin
                    && model.cand[id].extra == c.extra
            });
        };
        let enters = |id: CandId| {
            let o = &model.cand[id];
            o.gate == c.gate && o.extra == c.extra && domains.has_cand(model, id)
        };
        let leaves = |id: &CandId| Some(model.cand[*id].pin) == pin && domains.has_cand(model, *id);
        self.arcs(model, demand).any(enters) && model.gate_cands[gate].iter().any(leaves)
    }

    fn reach(&mut self, node: NodeId, dist: i64, arc: Option<Arc>) {
        if dist < self.dist[node] {
            self.dist[node] = dist;
            self.from[node] = arc;
            if !self.queued[node] {
                self.queued[node] = true;
                self.queue.push_back(node);
            }
        }
    }

    /// Finds shortest residual paths from the queued nodes (label correcting; most arcs cost
    /// nothing).
    fn explore(&mut self, model: &Model, domains: &Domains) {
        while let Some(node) = self.queue.pop_front() {
            self.queued[node] = false;
            let dist = self.dist[node];
            let back = Some((node, None));
            match self.layout.node(node) {
                Node::Demand(demand) => self.leave(model, domains, demand, dist),
                Node::Pin(pin) => match self.now.owner[pin] {
                    None => {}
                    Some(Owner::Demand(owner)) => self.return_to(model, owner, dist, back),
                    Some(Owner::Gate(gate)) => {
                        self.reach(self.layout.id(Node::GateOut(gate)), dist, back);
                    }
                },
                Node::GateIn(gate) => match self.now.gate_in[gate] {
                    None => self.reach(self.layout.id(Node::GateOut(gate)), dist, back),
                    Some(demand) => self.return_to(model, demand, dist, back),
                },
                Node::GateOut(gate) => {
                    for &id in &model.gate_cands[gate] {
                        let pin = model.cand[id].pin;
                        if Some(pin) != self.now.gate_out[gate] && domains.has_cand(model, id) {
                            let target = self.layout.id(Node::Pin(pin));
                            self.reach(target, dist, Some((node, Some(id))));
                        }
                    }
                    if self.now.gate_in[gate].is_some() {
                        self.reach(self.layout.id(Node::GateIn(gate)), dist, back);
                    }
                }
            }
        }
    }

    /// Reaches every node that the demand could take instead of its present one.
    fn leave(&mut self, model: &Model, domains: &Domains, demand: DemandId, dist: i64) {
        let node = self.layout.id(Node::Demand(demand));
        let held = self.now.arc[demand].map(|held| self.entry(&model.cand[held]));
        for id in self.arcs(model, demand) {
            if !domains.has_cand(model, id) {
                continue;
            }
            let c = &model.cand[id];
            let target = self.entry(c);
            if Some(target) != held {
                self.reach(target, dist + c.extra as i64, Some((node, Some(id))));
            }
        }
    }

    /// Goes back along the arc by which the demand left.
    fn return_to(&mut self, model: &Model, demand: DemandId, dist: i64, arc: Option<Arc>) {
        if let Some(held) = self.now.arc[demand] {
            let node = self.layout.id(Node::Demand(demand));
            self.reach(node, dist - model.cand[held].extra as i64, arc);
        }
    }

    /// The node that a candidate's arc leads to.
    fn entry(&self, c: &Cand) -> NodeId {
        self.layout.id(c.gate.map_or(Node::Pin(c.pin), Node::GateIn))
    }

    fn augment(
        &mut self,
        model: &Model,
        domains: &Domains,
        demand: DemandId,
    ) -> Result<(), Pruned> {
        self.dist.fill(FAR);
        self.reach(self.layout.id(Node::Demand(demand)), 0, None);
        self.explore(model, domains);
        let free = model.pins.iter().filter(|&pin| self.now.owner[pin].is_none());
        let ends = free.filter_map(|pin| {
            let node = self.layout.id(Node::Pin(pin));
            let dist = self.dist[node];
            (dist < FAR).then(|| (dist + model.pin_weight[pin] as i64, node))
        });
        let (dist, last) = ends.min().ok_or(Pruned)?;
        self.now.active[demand] = true;
        self.now.cost += dist;
        self.reroute(last);
        Ok(())
    }

    /// Takes a demand out of the flow, at the greatest gain.
    fn withdraw(&mut self, model: &Model, domains: &Domains, demand: DemandId) {
        self.dist.fill(FAR);
        let node = self.layout.id(Node::Demand(demand));
        let dear_first = std::mem::take(&mut self.dear_first);
        // Start with the most expensive pin, so that most nodes are reached only once.
        for &pin in &dear_first {
            if self.now.owner[pin].is_none() {
                continue;
            }
            self.reach(self.layout.id(Node::Pin(pin)), -(model.pin_weight[pin] as i64), None);
            self.explore(model, domains);
            if self.arcs_are_free && self.dist[node] < FAR {
                break;
            }
        }
        self.dear_first = dear_first;
        self.now.active[demand] = false;
        self.now.cost += self.dist[node];
        self.reroute(node);
        self.now.arc[demand] = None;
    }

    /// Reroutes along the path found to `last`.
    fn reroute(&mut self, last: NodeId) {
        self.path.clear();
        let mut node = last;
        while let Some((from, cand)) = self.from[node] {
            self.path.push((from, node, cand));
            node = from;
        }
        // A path that starts at a pin frees it first.
        if let Node::Pin(pin) = self.layout.node(node) {
            self.now.owner[pin] = None;
        }
        while let Some((from, to, cand)) = self.path.pop() {
            match (self.layout.node(from), self.layout.node(to)) {
                (Node::Demand(demand), Node::Pin(pin)) => {
                    self.now.arc[demand] = cand;
                    self.now.owner[pin] = Some(Owner::Demand(demand));
                }
                (Node::Demand(demand), Node::GateIn(gate)) => {
                    self.now.arc[demand] = cand;
                    self.now.gate_in[gate] = Some(demand);
                }
                (Node::GateOut(gate), Node::Pin(pin)) => {
                    self.now.gate_out[gate] = Some(pin);
                    self.now.owner[pin] = Some(Owner::Gate(gate));
                }
                (Node::GateOut(gate), Node::GateIn(_)) => {
                    self.now.gate_in[gate] = None;
                    self.now.gate_out[gate] = None;
                }
                _ => {}
            }
        }
    }

    /// The devices that compete for too few pins, after [`Self::refresh`] has failed.
    pub(crate) fn stuck(&self, model: &Model) -> Vec<DeviceId> {
        let reached = |demand| self.dist[self.layout.id(Node::Demand(demand))] < FAR;
        let fights = |&device: &DeviceId| model.demands.of(device).iter().any(reached);
        model.devices.iter().filter(fights).collect()
    }
}

/// Whether the alternative has a wire of its own at the position.
fn own_at(model: &Model, alt: AltId, position: usize) -> bool {
    let role = model.roles.of(alt).nth(position);
    role.is_some_and(|role| model.holding[role] == Holding::Own)
}

/// Candidates of a demand.
enum Arcs<'a> {
    Listed(std::slice::Iter<'a, CandId>),
    OfRole(IdIter<CandId>),
}

impl Iterator for Arcs<'_> {
    type Item = CandId;

    fn next(&mut self) -> Option<CandId> {
        match self {
            Self::Listed(list) => list.next().copied(),
            Self::OfRole(range) => range.next(),
        }
    }
}
