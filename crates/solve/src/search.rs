//! Branch and bound: domains in, the cheapest complete choice below a limit out.
//!
//! Each node propagates, bounds by the flow, and tries to read a wiring off the flow. Where that
//! fails, the choice at fault is branched on: taken, or taken away from the device and all its
//! interchangeable siblings at once, which is what breaks their symmetry.
#![expect(clippy::indexing_slicing, reason = "all ids come from the model")]

use crate::dma::Matching;
use crate::dual::{Dual, NEVER, Terms};
use crate::flow::{Flow, Saved};
use crate::model::{Kind, Model, NONE, agree};
use crate::problem::Problem;
use crate::state::{Dead, State, Toll};

/// Alternative and candidates of each device, by id.
pub(crate) type Choices = Vec<(usize, Vec<usize>)>;

#[derive(Clone, Copy, Debug)]
enum Branch {
    Alt(usize),
    Cand(usize),
    Rule(usize),
    Board(usize),
}

/// The search and all its state.
pub(crate) struct Engine<'a> {
    pub(crate) problem: &'a Problem,
    pub(crate) model: &'a Model,
    pub(crate) state: State,
    pub(crate) flow: Flow,
    /// Only answers below this are looked for.
    limit: u64,
    /// Whether the first one is enough.
    first: bool,
    best: Option<(u64, Choices)>,
    /// Least bound of what was cut off because of the limit.
    pub(crate) cut: u64,
    pub(crate) nodes: u64,
    stop: Option<&'a dyn Fn() -> bool>,
    pub(crate) stopped: bool,
    scratch: Scratch,
    /// The second bound, made when the flow is not enough.
    dual: Option<Box<(Terms, Dual)>>,
    /// Nodes until which any answer will do, so that there is a limit to bound against.
    dive: u64,
}

/// An engine without what it borrows, to be kept between two steps of an iterator.
pub(crate) struct Parked {
    state: State,
    flow: Flow,
    cut: u64,
    nodes: u64,
    scratch: Scratch,
    dual: Option<Box<(Terms, Dual)>>,
}

/// Who holds what while a wiring is read off the flow.
#[derive(Clone, Debug)]
struct Scratch {
    resource: Vec<(usize, usize)>,
    pin: Vec<(usize, usize, usize)>,
    touched_resources: Vec<usize>,
    touched_pins: Vec<usize>,
}

const NOBODY: usize = NONE;

/// How long the search looks for a first answer by the flow alone.
const DIVE: u64 = 300;

/// Steps of the price ascent at the root and at other nodes.
const ROOT_STEPS: usize = 250;
const NODE_STEPS: usize = 30;

impl<'a> Engine<'a> {
    /// # Errors
    /// [`Dead`] when propagation alone shows that there is no answer.
    pub(crate) fn new(
        problem: &'a Problem,
        model: &'a Model,
        stop: Option<&'a dyn Fn() -> bool>,
    ) -> Result<Self, Dead> {
        Ok(Self {
            problem,
            model,
            state: State::new(model)?,
            flow: Flow::new(model),
            limit: u64::MAX,
            first: false,
            best: None,
            cut: u64::MAX,
            nodes: 0,
            stop,
            stopped: false,
            scratch: Scratch {
                resource: vec![(NOBODY, 0); problem.resources as usize],
                pin: vec![(NOBODY, 0, 0); model.pins],
                touched_resources: Vec::new(),
                touched_pins: Vec::new(),
            },
            dual: None,
            dive: 0,
        })
    }

    pub(crate) fn park(self) -> Parked {
        let Self { state, flow, cut, nodes, scratch, dual, .. } = self;
        Parked { state, flow, cut, nodes, scratch, dual }
    }

    pub(crate) fn unpark(problem: &'a Problem, model: &'a Model, parked: Parked) -> Self {
        let Parked { state, flow, cut, nodes, scratch, dual } = parked;
        Self {
            problem,
            model,
            state,
            flow,
            limit: u64::MAX,
            first: false,
            best: None,
            cut,
            nodes,
            stop: None,
            stopped: false,
            scratch,
            dual,
            dive: 0,
        }
    }

    /// The cheapest choice below `limit`, or with `first` any one below it.
    pub(crate) fn search(&mut self, limit: u64, first: bool) -> Option<(u64, Choices)> {
        self.limit = limit;
        self.first = first;
        self.best = None;
        let mark = self.state.mark();
        let saved = self.flow.save();
        if limit == u64::MAX && !first {
            self.dive = self.nodes + DIVE;
            self.node(0);
            self.dive = 0;
            self.back(mark, &saved);
        }
        self.node(0);
        self.back(mark, &saved);
        self.best.take()
    }

    pub(crate) fn bound(&self) -> u64 {
        self.state.paid + self.flow.cost()
    }

    /// Propagates and updates the bound.
    pub(crate) fn settle(&mut self) -> Result<(), Dead> {
        self.state.propagate(self.model)?;
        self.flow.refresh(self.model, &self.state)
    }

    pub(crate) fn back(&mut self, mark: usize, saved: &Saved) {
        self.state.undo(self.model, mark);
        self.flow.restore(saved);
    }

    /// Searches below the current domains; leaves them smaller.
    fn node(&mut self, depth: usize) {
        let mut fresh = true;
        loop {
            self.nodes += 1;
            if self.dive > 0 && (self.best.is_some() || self.nodes > self.dive) {
                return;
            }
            if self.stop.is_some_and(|stop| stop()) {
                self.stopped = true;
            }
            if self.stopped || self.settle().is_err() {
                return;
            }
            let bound = self.bound();
            if bound >= self.limit {
                self.cut = self.cut.min(bound);
                return;
            }
            if self.model.dma_matters && !self.dma_possible() {
                return;
            }
            let branch = match self.read() {
                Ok(choices) => {
                    let weight = self.model.evaluate(&choices);
                    let toll = self.open_toll(&choices);
                    if weight < self.limit {
                        self.limit = weight;
                        self.best = Some((weight, choices));
                    } else {
                        self.cut = self.cut.min(weight);
                    }
                    if self.first && self.best.is_some() || weight == bound {
                        return;
                    }
                    toll.or_else(|| self.any_branch())
                }
                Err(branch) => branch,
            };
            let Some(branch) = branch else { return };
            let mut branch = branch;
            if self.dive == 0 {
                let root = depth == 0 && !self.first;
                let steps = match (root, fresh) {
                    (true, true) => ROOT_STEPS,
                    (true, false) => ROOT_STEPS / 4,
                    (false, _) => NODE_STEPS,
                };
                fresh = false;
                match self.price(steps) {
                    Err(Dead) => return,
                    Ok(true) => continue,
                    Ok(false) => branch = self.guided(branch),
                }
            }
            let mark = self.state.mark();
            let saved = self.flow.save();
            let prices = self.dual.as_ref().map(|dual| dual.1.save());
            let limit = self.limit;
            if self.take(branch).is_ok() {
                self.node(depth + 1);
            }
            if self.first && self.best.is_some() {
                return;
            }
            self.back(mark, &saved);
            if let (Some(dual), Some(prices)) = (&mut self.dual, prices) {
                dual.1.restore(&prices);
            }
            // A better limit strikes more at the root than anywhere below it.
            if self.limit < limit && !self.first {
                if depth > 0 {
                    return;
                }
                continue;
            }
            if self.refuse(branch).is_err() {
                return;
            }
        }
    }

    /// The same branching with the alternative that the prices favour.
    fn guided(&self, branch: Branch) -> Branch {
        let (Branch::Alt(alt), Some(dual)) = (branch, &self.dual) else { return branch };
        let cheapest = dual.1.cheapest(self.model, self.model.alt_device[alt]);
        Branch::Alt(cheapest.filter(|a| self.state.alt_on(*a)).unwrap_or(alt))
    }

    /// Strikes all that cannot be in an answer below the limit, for good.
    pub(crate) fn narrow(&mut self, limit: u64) -> Result<(), Dead> {
        self.limit = limit;
        self.settle()?;
        while self.dual.is_some() && !self.stopped && self.price(ROOT_STEPS / 4)? {
            self.settle()?;
        }
        Ok(())
    }

    /// Bounds by prices; whether they narrowed the domains.
    fn price(&mut self, steps: usize) -> Result<bool, Dead> {
        let (problem, model) = (self.problem, self.model);
        let pair = self.dual.get_or_insert_with(|| {
            let terms = Terms::new(problem, model);
            let dual = Dual::new(&terms);
            Box::new((terms, dual))
        });
        let (terms, dual) = &mut **pair;
        let bound = dual.ascend(terms, model, &self.state, self.limit, steps);
        if bound >= NEVER {
            return Err(Dead);
        }
        if bound >= self.limit {
            self.cut = self.cut.min(bound);
            return Err(Dead);
        }
        let struck = dual.strike(terms, model, &mut self.state, bound, self.limit);
        self.cut = self.cut.min(dual.struck);
        struck
    }

    fn take(&mut self, branch: Branch) -> Result<(), Dead> {
        match branch {
            Branch::Alt(alt) => self.state.decide(self.model, alt),
            Branch::Cand(id) => self.state.pin(self.model, id),
            Branch::Rule(rule) => self.state.close_rule(self.model, rule),
            Branch::Board(board) => self.state.close_board(self.model, board),
        }
    }

    fn refuse(&mut self, branch: Branch) -> Result<(), Dead> {
        let model = self.model;
        match branch {
            Branch::Alt(alt) => {
                let device = model.alt_device[alt];
                let offset = alt - model.alts.range(device).start;
                for twin in self.twins(device) {
                    self.state.kill_alt(model, model.alts.range(twin).start + offset)?;
                }
                Ok(())
            }
            Branch::Cand(id) => {
                let device = model.cand_device(id);
                let offset = id - self.first_cand(device);
                for twin in self.twins(device) {
                    self.state.kill_cand(model, self.first_cand(twin) + offset)?;
                }
                Ok(())
            }
            Branch::Rule(rule) => self.state.pay_rule(model, rule),
            Branch::Board(board) => self.state.pay_board(model, board),
        }
    }

    fn first_cand(&self, device: usize) -> usize {
        let role = self.model.roles.range(self.model.alts.range(device).start).start;
        if role < self.model.role_alt.len() { self.model.cands.range(role).start } else { 0 }
    }

    /// The device and those that are interchangeable with it here and now.
    fn twins(&self, device: usize) -> Vec<usize> {
        let class = self.model.class[device];
        let same = |&d: &usize| {
            self.model.class[d] == class && (d == device || self.state.same_domain(self.model, d, device))
        };
        (class..self.model.devices).filter(same).collect()
    }

    /// Whether the streams suffice for all that is certain.
    fn dma_possible(&self) -> bool {
        let model = self.model;
        let mut users: Vec<usize> = (0..model.devices)
            .filter_map(|d| self.state.decided(d))
            .flat_map(|alt| model.alt_dma.at(alt).iter().copied())
            .collect();
        users.sort_unstable();
        users.dedup();
        let mut unions: Vec<Vec<crate::problem::StreamId>> = Vec::new();
        for device in (0..model.devices).filter(|&d| self.state.decided(d).is_none()) {
            self.undecided_requests(device, &mut unions);
        }
        let mut matching = Matching::new(self.problem.streams);
        let certain = users.iter().flat_map(|&u| &self.problem.dma[u].requests);
        let mut all = certain.map(|r| r.streams.as_slice()).chain(unions.iter().map(Vec::as_slice));
        all.all(|streams| matching.add(streams))
    }

    /// The requests of a device that needs streams of its own whatever it chooses.
    fn undecided_requests(&self, device: usize, unions: &mut Vec<Vec<crate::problem::StreamId>>) {
        let model = self.model;
        let requests = |alt: usize| {
            let users = model.alt_dma.at(alt).iter();
            users.filter(|u| model.user_private[**u]).flat_map(|&u| &self.problem.dma[u].requests)
        };
        let least = self.state.alts(model, device).map(|a| requests(a).count()).min();
        for position in 0..least.unwrap_or(0) {
            let mut union = Vec::new();
            for alt in self.state.alts(model, device) {
                union.extend(requests(alt).nth(position).into_iter().flat_map(|r| &r.streams));
            }
            unions.push(union);
        }
    }

    /// A rule or spare board that the wiring uses although the bound does not pay for it.
    fn open_toll(&self, choices: &Choices) -> Option<Branch> {
        let model = self.model;
        for (alt, cands) in choices {
            let rules = model.alt_rules.at(*alt).iter();
            let open = |r: &&usize| self.state.rule[**r] == Toll::Open && !model.rule_local[**r];
            let mut rules = rules.chain(cands.iter().flat_map(|&c| model.cand_rules.at(c)));
            if let Some(&rule) = rules.find(open) {
                return Some(Branch::Rule(rule));
            }
        }
        for (alt, _) in choices {
            let board = model.alt_board[*alt];
            if model.spare[board] && self.state.board[board] == Toll::Open {
                return Some(Branch::Board(board));
            }
        }
        None
    }

    /// Any open choice.
    fn any_branch(&self) -> Option<Branch> {
        let model = self.model;
        let open = (0..model.devices).filter(|&d| self.state.device_left(d) > 1);
        if let Some(device) = open.min_by_key(|&d| self.state.device_left(d)) {
            return self.state.alts(model, device).next().map(Branch::Alt);
        }
        (0..model.devices).find_map(|d| self.open_role(d))
    }

    fn open_role(&self, device: usize) -> Option<Branch> {
        let model = self.model;
        let alt = self.state.decided(device)?;
        let (position, role) = model
            .roles
            .range(alt)
            .enumerate()
            .filter(|(_, r)| self.state.role_left(*r) > 1)
            .min_by_key(|(_, r)| self.state.role_left(*r))?;
        let flow = self.flow.at(model, device, position).map(|(pin, _)| pin);
        let here = |c: &usize| Some(model.cand(*c).pin) == flow;
        let mut cands = self.state.cands(model, role);
        cands.clone().find(here).or_else(|| cands.next()).map(Branch::Cand)
    }

    /// Reads a wiring off the flow, or tells what to branch on.
    fn read(&mut self) -> Result<Choices, Option<Branch>> {
        let model = self.model;
        let mut choices = Choices::with_capacity(model.devices);
        let mut wires = vec![NONE; model.wires];
        let mut fault = None;
        // Decided devices first: the others adapt.
        let order = (0..model.devices).filter(|&d| self.state.device_left(d) == 1);
        let order: Vec<usize> =
            order.chain((0..model.devices).filter(|&d| self.state.device_left(d) > 1)).collect();
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
                self.state.device_left(*d) > 1
                    && self.state.alts(model, *d).any(|a| !model.alt_dma.at(a).is_empty())
            };
            let device = (0..model.devices).find(uses);
            return Err(device.map(|d| Branch::Alt(choices[d].0)));
        }
        Ok(choices)
    }

    fn dma_fits(&self, choices: &Choices) -> bool {
        let mut users: Vec<usize> =
            choices.iter().flat_map(|(alt, _)| self.model.alt_dma.at(*alt)).copied().collect();
        users.sort_unstable();
        users.dedup();
        let mut matching = Matching::new(self.problem.streams);
        let mut requests = users.iter().flat_map(|&u| &self.problem.dma[u].requests);
        requests.all(|r| matching.add(&r.streams))
    }

    /// A device that cannot follow the flow is to choose; if it has chosen, its opponent is.
    fn blame(&self, device: usize, culprit: usize) -> Option<Branch> {
        let model = self.model;
        for d in [device, culprit] {
            if d != NOBODY && self.state.device_left(d) > 1 {
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
            .filter(|&alt| model.alt_device[alt] == device && self.state.alt_on(alt));
        flow.next().or_else(|| self.state.alts(model, device).next())
    }

    fn read_device(
        &mut self,
        device: usize,
        wires: &mut [usize],
    ) -> Result<(usize, Vec<usize>), usize> {
        let model = self.model;
        let first = self.preferred(device);
        let mut culprit = NOBODY;
        let others = self.state.alts(model, device).filter(|a| Some(*a) != first);
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
                _ if self.state.role_left(role) == 1 => None,
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
                if !self.state.cand_on(model, id) {
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
