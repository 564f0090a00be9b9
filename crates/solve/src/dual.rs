//! The second bound: prices on pins, resources, units and streams.
//!
//! Every thing that can be held once gets a price instead of a limit; then each group of alike
//! devices, and each shared unit, chooses for itself what is cheapest, and the sum less the prices
//! is a lower bound whatever the prices are. A subgradient ascent looks for good ones. Unlike the
//! flow, this bound sees that a device's wires come from one alternative, that a shared unit is
//! opened as a whole and that groups exclude each other. What would cost too much at the prices
//! found is struck from the domains. All arithmetic is in integers, so the bound is exact.
#![expect(clippy::indexing_slicing, reason = "all indices are made here or come from the model")]

use crate::model::{Kind, Model, NONE};
use crate::state::{Dead, State};
use crate::terms::Terms;
use crate::view::{Group, View, Way};

/// Prices count in weights times 2^SHIFT.
pub(crate) const SHIFT: u32 = 8;

/// More than any sum of costs ([`crate::answer::Fault::TooLarge`] sees to that).
const FAR: i64 = 1 << 54;

/// Prices and the work space of the ascent.
#[derive(Clone, Debug)]
pub(crate) struct Dual {
    prices: Vec<i64>,
    best: Vec<i64>,
    slope: Vec<i64>,
    drift: Vec<i64>,
    view: View,
    opening_of: Vec<usize>,
}

impl Dual {
    pub(crate) fn new(terms: &Terms) -> Self {
        Self {
            prices: vec![0; terms.prices],
            best: vec![0; terms.prices],
            slope: vec![0; terms.prices],
            drift: vec![0; terms.prices],
            view: View::default(),
            opening_of: Vec::new(),
        }
    }

    pub(crate) fn save(&self) -> Vec<i64> {
        self.prices.clone()
    }

    pub(crate) fn restore(&mut self, saved: &[i64]) {
        self.prices.copy_from_slice(saved);
    }

    /// Improves the prices for some steps and returns the bound, which counts everything.
    pub(crate) fn ascend(
        &mut self,
        terms: &Terms,
        model: &Model,
        state: &State,
        limit: u64,
        steps: usize,
    ) -> u64 {
        self.build(terms, model, state);
        let paid = (state.paid as i64) << SHIFT;
        let known = limit < model.most;
        let unit = (model.weights.cost as i64) << SHIFT;
        let mut best = i64::MIN;
        let (mut pace, mut idle) = (256, 0);
        self.drift.fill(0);
        for step in 0..=steps {
            let value = self.evaluate(terms, model) + paid;
            if value > best {
                // Small gains count as none: the pace is what is wrong.
                idle = if value > best + unit / 64 { 0 } else { idle + 1 };
                best = value;
                self.best.copy_from_slice(&self.prices);
            } else {
                idle += 1;
            }
            if idle >= 8 {
                (pace, idle) = (pace / 2, 0);
                self.prices.copy_from_slice(&self.best);
            }
            let goal = (limit as i64) << SHIFT;
            let target = if known { goal } else { best + best / 8 + unit };
            if value >= goal || step == steps || pace < 4 {
                break;
            }
            self.step(terms, (target - value).max(unit / 8), pace);
        }
        self.prices.copy_from_slice(&self.best);
        let value = self.evaluate(terms, model) + paid;
        value.max(0).unsigned_abs().div_ceil(1 << SHIFT)
    }

    /// The alternative that is cheapest for a device at the last prices.
    pub(crate) fn cheapest(&self, model: &Model, device: usize) -> Option<usize> {
        let group = self.view.groups.iter().find(|g| g.devices.contains(&device))?;
        let choices = &self.view.choices[group.choices.0..group.choices.1];
        let best = choices.iter().min_by_key(|c| c.cost)?;
        let first = model.alts.range(group.devices[0]).start;
        Some(best.alt - first + model.alts.range(device).start)
    }

    /// Moves the prices along the slope, with some of the last move in it.
    fn step(&mut self, terms: &Terms, gap: i64, pace: i64) {
        let mut norm = 0;
        for ((drift, slope), price) in self.drift.iter_mut().zip(&self.slope).zip(&self.prices) {
            *drift = slope * 16 + *drift * 5 / 8;
            if *price == 0 && *drift < 0 {
                *drift = 0;
            }
            norm += *drift * *drift;
        }
        if norm == 0 {
            return;
        }
        debug_assert_eq!(terms.prices, self.prices.len());
        for (price, drift) in self.prices.iter_mut().zip(&self.drift) {
            if *drift != 0 {
                let move_by = i128::from(gap) * i128::from(pace * drift) / i128::from(16 * norm);
                *price = (*price + move_by as i64).max(0);
            }
        }
    }

    /// Strikes what no answer below the limit can use. Returns whether anything was struck.
    pub(crate) fn strike(
        &mut self,
        terms: &Terms,
        model: &Model,
        state: &mut State,
        bound: u64,
        limit: u64,
    ) -> Result<bool, Dead> {
        if bound >= limit {
            return Ok(false);
        }
        let value = self.evaluate(terms, model) + ((state.paid as i64) << SHIFT);
        // An answer of weight limit - 1 must survive.
        let room = ((limit as i64 - 1) << SHIFT) - value;
        let mark = state.mark();
        self.strike_groups(model, state, room)?;
        self.strike_openings(terms, model, state, room)?;
        Ok(state.mark() > mark)
    }

    fn strike_groups(&self, model: &Model, state: &mut State, room: i64) -> Result<(), Dead> {
        for (index, group) in self.view.groups.iter().enumerate() {
            let margin = self.view.margin[index];
            for choice in &self.view.choices[group.choices.0..group.choices.1] {
                let over = if group.spread && !choice.once {
                    // Each way stands for itself.
                    choice.cost - self.view.cheapest[choice.roles.0].0 - margin
                } else {
                    (choice.cost - margin).max(0)
                };
                let first = model.alts.range(group.devices[0]).start;
                if (!group.spread || choice.once) && over > room {
                    for &device in &group.devices {
                        let start = model.alts.range(device).start;
                        state.kill_alt(model, start + choice.alt - first)?;
                    }
                    continue;
                }
                for role in choice.roles.0..choice.roles.1 {
                    let cheapest = self.view.cheapest[role].0;
                    for way in self.ways(role) {
                        if way.id == NONE {
                            continue;
                        }
                        let cost = self.way_cost(way);
                        let extra = if group.spread && !choice.once {
                            (over + cost).max(0)
                        } else {
                            over + cost - cheapest
                        };
                        if extra > room {
                            for &device in &group.devices {
                                let twin = twin_cand(model, group.devices[0], device, way.id);
                                state.kill_cand(model, twin)?;
                            }
                        }
                    }
                }
            }
        }
        Ok(())
    }

    fn strike_openings(
        &self,
        terms: &Terms,
        model: &Model,
        state: &mut State,
        room: i64,
    ) -> Result<(), Dead> {
        for opening in &self.view.openings {
            let over = if opening.open { 0 } else { (opening.cost - opening.spares).max(0) };
            if over > room {
                for &alt in &terms.facilities[opening.facility].alts {
                    state.kill_alt(model, alt)?;
                }
                continue;
            }
            for role in opening.roles.0..opening.roles.1 {
                let cheapest = self.view.cheapest[role].0;
                for way in self.ways(role) {
                    let extra = over + self.way_cost(way) - cheapest;
                    if way.id == NONE || extra <= room {
                        continue;
                    }
                    let c = model.cand(way.id);
                    let Kind::Wire(wire) = model.role_kind[c.role] else { continue };
                    for &other in model.wire_cands.at(wire) {
                        let o = model.cand(other);
                        if (o.pin, o.signal, o.holder) == (c.pin, c.signal, c.holder) {
                            state.kill_cand(model, other)?;
                        }
                    }
                }
            }
        }
        Ok(())
    }

    fn ways(&self, role: usize) -> &[Way] {
        let (start, end) = self.view.roles[role];
        &self.view.ways[start..end]
    }

    fn way_cost(&self, way: &Way) -> i64 {
        let more = &self.view.lists[way.more.0..way.more.1];
        way.fixed + self.prices[way.price] + more.iter().map(|&p| self.prices[p]).sum::<i64>()
    }

    /// The bound at the present prices (without what is paid); sets the slope.
    fn evaluate(&mut self, terms: &Terms, model: &Model) -> i64 {
        for role in 0..self.view.roles.len() {
            let (start, end) = self.view.roles[role];
            let mut best = (FAR, NONE);
            for index in start..end {
                let cost = self.way_cost(&self.view.ways[index]);
                if cost < best.0 {
                    best = (cost, index);
                }
            }
            self.view.cheapest[role] = best;
        }
        for slope in &mut self.slope[..terms.first_link] {
            *slope = -1;
        }
        self.slope[terms.first_link..].fill(0);
        let mut value = -self.prices[..terms.first_link].iter().sum::<i64>();
        for index in 0..self.view.groups.len() {
            value += self.choose(index);
        }
        value += self.open(terms);
        debug_assert_eq!(model.alt_device.len(), terms.alt_requests.len());
        value
    }

    /// A group of alike devices takes the cheapest that it can take together.
    fn choose(&mut self, index: usize) -> i64 {
        let (start, end) = self.view.groups[index].choices;
        let number = self.view.groups[index].devices.len();
        let spread = self.view.groups[index].spread;
        let mut order = std::mem::take(&mut self.view.order);
        order.clear();
        for c in start..end {
            let choice = self.view.choices[c];
            let own = &self.view.lists[choice.prices.0..choice.prices.1];
            let own: i64 = own.iter().map(|&p| self.prices[p]).sum();
            let roles = &self.view.cheapest[choice.roles.0..choice.roles.1];
            let cost = own + roles.iter().map(|r| r.0).sum::<i64>();
            self.view.choices[c].cost = cost;
            if spread && !choice.once {
                let (first, last) = self.view.roles[choice.roles.0];
                for way in first..last {
                    order.push((own + self.way_cost(&self.view.ways[way]), c, way));
                }
            } else {
                order.push((cost, c, NONE));
            }
        }
        let mut value = 0;
        let mut margin = FAR;
        if number == 1 {
            if let Some(&(cost, c, way)) = order.iter().min() {
                (value, margin) = (cost, cost);
                self.take(c, way, 1);
            }
        } else {
            if order.len() > number {
                order.select_nth_unstable(number - 1);
                order.truncate(number);
            }
            order.sort_unstable();
            let mut left = number;
            for &(cost, c, way) in &order {
                let choice = self.view.choices[c];
                let times = if spread || choice.once { 1 } else { left };
                value += cost * times as i64;
                margin = cost;
                self.take(c, way, times as i64);
                left -= times;
                if left == 0 {
                    break;
                }
            }
            if left > 0 {
                // Fewer ways than devices: nothing fits.
                value = FAR;
            }
        }
        self.view.margin[index] = margin;
        self.view.order = order;
        value
    }

    /// Books what a choice uses.
    fn take(&mut self, c: usize, way: usize, times: i64) {
        let choice = self.view.choices[c];
        for &price in &self.view.lists[choice.prices.0..choice.prices.1] {
            self.slope[price] += times;
        }
        for role in choice.roles.0..choice.roles.1 {
            let way = if way == NONE { self.view.cheapest[role].1 } else { way };
            self.use_way(way, times);
        }
    }

    fn use_way(&mut self, way: usize, times: i64) {
        if way == NONE {
            return;
        }
        let way = self.view.ways[way];
        self.slope[way.price] += times;
        for &price in &self.view.lists[way.more.0..way.more.1] {
            self.slope[price] += times;
        }
    }

    /// Facilities open where that pays, and as many as their families need.
    fn open(&mut self, terms: &Terms) -> i64 {
        for index in 0..self.view.openings.len() {
            let (facility, roles) =
                (self.view.openings[index].facility, self.view.openings[index].roles);
            let facility = &terms.facilities[facility];
            let mut cost = facility.resource.map_or(0, |r| self.prices[r]);
            cost -= facility.links.iter().map(|&(l, times)| self.prices[l] * times).sum::<i64>();
            cost += self.view.cheapest[roles.0..roles.1].iter().map(|r| r.0).sum::<i64>();
            let opening = &mut self.view.openings[index];
            opening.cost = cost;
            opening.open = opening.forced || cost < 0;
            opening.spares = 0;
        }
        for family in &terms.families {
            let open = |f: &&usize| {
                let index = self.opening_of[**f];
                index != NONE && self.view.openings[index].open
            };
            let mut missing =
                family.need.saturating_sub(family.members.iter().filter(open).count());
            let mut dearest = 0;
            while missing > 0 {
                let shut = family.members.iter().map(|&f| self.opening_of[f]);
                let shut = shut.filter(|&i| i != NONE && !self.view.openings[i].open);
                let Some(next) = shut.min_by_key(|&i| self.view.openings[i].cost) else { break };
                self.view.openings[next].open = true;
                dearest = self.view.openings[next].cost.max(dearest);
                missing -= 1;
            }
            for &member in family.members.iter().filter(|_| dearest > 0) {
                if let Some(opening) = self.view.openings.get_mut(self.opening_of[member]) {
                    opening.spares = dearest;
                }
            }
        }
        let mut value = 0;
        for index in 0..self.view.openings.len() {
            if !self.view.openings[index].open {
                continue;
            }
            let roles = self.view.openings[index].roles;
            let facility = &terms.facilities[self.view.openings[index].facility];
            value += self.view.openings[index].cost;
            if let Some(resource) = facility.resource {
                self.slope[resource] += 1;
            }
            for &(link, times) in &facility.links {
                self.slope[link] -= times;
            }
            for role in roles.0..roles.1 {
                self.use_way(self.view.cheapest[role].1, 1);
            }
        }
        value
    }

    /// Brings the living domains into the view.
    fn build(&mut self, terms: &Terms, model: &Model, state: &State) {
        let view = &mut self.view;
        view.groups.clear();
        view.choices.clear();
        view.roles.clear();
        view.ways.clear();
        view.lists.clear();
        view.openings.clear();
        let mut done = vec![false; model.devices];
        for device in 0..model.devices {
            if done[device] {
                continue;
            }
            let devices: Vec<usize> = (device..model.devices)
                .filter(|&d| {
                    model.class[d] == model.class[device]
                        && (d == device || state.same_domain(model, device, d))
                })
                .collect();
            devices.iter().for_each(|&d| done[d] = true);
            let start = view.choices.len();
            for alt in state.alts(model, device) {
                view.add_choice(terms, model, state, alt);
            }
            let single = view.choices[start..].iter().all(|c| c.roles.1 - c.roles.0 == 1);
            let choices = (start, view.choices.len());
            view.groups.push(Group { spread: single && devices.len() > 1, devices, choices });
        }
        self.opening_of.clear();
        self.opening_of.resize(terms.facilities.len(), NONE);
        for (index, facility) in terms.facilities.iter().enumerate() {
            if facility.alts.iter().any(|&alt| state.alt_on(alt)) {
                self.opening_of[index] = self.view.openings.len();
                self.view.add_opening(model, state, index, facility);
            }
        }
        self.view.cheapest.clear();
        self.view.cheapest.resize(self.view.roles.len(), (0, NONE));
        self.view.margin.clear();
        self.view.margin.resize(self.view.groups.len(), 0);
    }
}

/// The candidate of an alike device that stands where this one does.
fn twin_cand(model: &Model, one: usize, other: usize, id: usize) -> usize {
    let first = |device: usize| {
        let role = model.roles.range(model.alts.range(device).start).start;
        model.cands.range(role).start
    };
    id - first(one) + first(other)
}
