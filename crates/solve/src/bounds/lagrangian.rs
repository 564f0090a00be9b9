//! The second bound: prices on pins, resources, units and streams.
//!
//! Every thing that can be held once gets a price instead of a limit; then each group of alike
//! devices, and each shared unit, chooses for itself what is cheapest, and the sum less the prices
//! is a lower bound whatever the prices are; the linear program ([`crate::bounds::relaxation`]) finds the best.
//! Unlike the flow, this bound sees that a device's wires come from one alternative, that a shared unit is
//! opened as a whole and that groups exclude each other. What would cost too much at the prices
//! found is struck from the domains. All arithmetic is in integers, so the bound is exact.
#![expect(clippy::indexing_slicing, reason = "all indices are made here or come from the model")]

use crate::bounds::dualized::Dualized;
use crate::bounds::node_costs::{Group, NodeCosts, Way};
use crate::domains::{Charge, Dead, Domains};
use crate::model::{Kind, Model, NONE};

/// More than any sum of costs ([`crate::answer::Fault::TooLarge`] sees to that).
const FAR: i64 = 1 << 54;

/// Prices, and the domains as last assessed.
#[derive(Clone, Debug)]
pub(crate) struct Lagrangian {
    prices: Vec<i64>,
    /// The bound as last assessed, without what is paid.
    value: i64,
    view: NodeCosts,
    opening_of: Vec<usize>,
}

impl Lagrangian {
    pub(crate) fn new(terms: &Dualized) -> Self {
        Self {
            prices: vec![0; terms.prices],
            value: 0,
            view: NodeCosts::default(),
            opening_of: Vec::new(),
        }
    }

    /// The greatest weight, beside what is paid and no penalty, of an answer below the limit.
    pub(crate) fn most(
        terms: &Dualized,
        model: &Model,
        domains: &Domains,
        limit: u64,
    ) -> Option<u64> {
        let unit = model.weights.cost;
        Some((limit - 1).checked_sub(Self::beside(terms, model, domains))? / unit * unit)
    }

    /// What is paid, but for the penalties.
    fn beside(terms: &Dualized, model: &Model, domains: &Domains) -> u64 {
        let paid = terms.penalties.iter().filter(|p| domains.rule[p.rule] == Charge::Paid).count();
        domains.paid - paid as u64 * model.weights.rule
    }

    /// Takes other prices.
    pub(crate) fn set(&mut self, prices: impl Iterator<Item = i64>) {
        self.prices.iter_mut().zip(prices).for_each(|(price, new)| *price = new);
    }

    /// The bound at the present prices, which counts everything.
    pub(crate) fn assess(&mut self, terms: &Dualized, model: &Model, domains: &Domains) -> u64 {
        self.build(terms, model, domains);
        self.value = self.evaluate(terms) + self.pay(terms, model, domains);
        // The weight of pins, moves and rules is a multiple of the unit.
        let unit = model.weights.cost;
        let units = self.value.max(0).unsigned_abs().div_ceil(unit << terms.shift);
        units * unit + Self::beside(terms, model, domains)
    }

    /// Strikes what no answer below the limit can use, as last assessed. Returns whether anything was struck.
    pub(crate) fn strike(
        &mut self,
        terms: &Dualized,
        model: &Model,
        domains: &mut Domains,
        limit: u64,
    ) -> Result<bool, Dead> {
        let Some(most) = Self::most(terms, model, domains, limit) else { return Ok(false) };
        // An answer of weight limit - 1 must survive.
        let room = ((most as i64) << terms.shift) - self.value;
        let mark = domains.mark();
        self.strike_groups(model, domains, room)?;
        self.strike_openings(terms, model, domains, room)?;
        self.strike_penalties(terms, model, domains, room)?;
        Ok(domains.mark() > mark)
    }

    fn strike_groups(&self, model: &Model, domains: &mut Domains, room: i64) -> Result<(), Dead> {
        for (index, group) in self.view.groups.iter().enumerate() {
            let margin = self.view.margin[index];
            for choice in &self.view.choices[group.choices.0..group.choices.1] {
                let over = if group.spread && !choice.once {
                    // Each way stands for itself.
                    choice.cost - self.view.cheapest[choice.roles.0] - margin
                } else {
                    (choice.cost - margin).max(0)
                };
                let first = model.alts.range(group.devices[0]).start;
                if (!group.spread || choice.once) && over > room {
                    for &device in &group.devices {
                        let start = model.alts.range(device).start;
                        domains.kill_alt(model, start + choice.alt - first)?;
                    }
                    continue;
                }
                for role in choice.roles.0..choice.roles.1 {
                    let cheapest = self.view.cheapest[role];
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
                                domains.kill_cand(model, twin)?;
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
        terms: &Dualized,
        model: &Model,
        domains: &mut Domains,
        room: i64,
    ) -> Result<(), Dead> {
        for opening in &self.view.openings {
            let over = if opening.open { 0 } else { (opening.cost - opening.spares).max(0) };
            if over > room {
                for &alt in &terms.facilities[opening.facility].alts {
                    domains.kill_alt(model, alt)?;
                }
                continue;
            }
            for role in opening.roles.0..opening.roles.1 {
                let cheapest = self.view.cheapest[role];
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
                            domains.kill_cand(model, other)?;
                        }
                    }
                }
            }
        }
        Ok(())
    }

    /// Rules that would cost too much are kept, those that save too much are paid.
    fn strike_penalties(
        &self,
        terms: &Dualized,
        model: &Model,
        domains: &mut Domains,
        room: i64,
    ) -> Result<(), Dead> {
        for (penalty, &cost) in terms.penalties.iter().zip(&self.view.penalties) {
            if domains.rule[penalty.rule] != Charge::Open {
                continue;
            }
            if cost > room {
                domains.close_rule(model, penalty.rule)?;
            } else if -cost > room {
                domains.pay_rule(model, penalty.rule)?;
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

    /// The bound at the present prices (without what is paid).
    fn evaluate(&mut self, terms: &Dualized) -> i64 {
        for role in 0..self.view.roles.len() {
            let (start, end) = self.view.roles[role];
            let costs = self.view.ways[start..end].iter().map(|way| self.way_cost(way));
            self.view.cheapest[role] = costs.min().unwrap_or(FAR);
        }
        let held = self.prices[..terms.first_link].iter().sum::<i64>();
        let groups: i64 = (0..self.view.groups.len()).map(|index| self.choose(index)).sum();
        groups + self.open(terms) - held
    }

    /// Rules are violated where that pays, and where it is certain.
    fn pay(&mut self, terms: &Dualized, model: &Model, domains: &Domains) -> i64 {
        let weight = (model.weights.rule as i64) << terms.shift;
        self.view.penalties.clear();
        let mut sum = 0;
        for penalty in &terms.penalties {
            let linked = penalty.links.iter().map(|&(l, times)| self.prices[l] * times);
            let cost = weight - linked.sum::<i64>();
            self.view.penalties.push(cost);
            sum += match domains.rule[penalty.rule] {
                Charge::Open => cost.min(0),
                Charge::Paid => cost,
                Charge::Closed => 0,
            };
        }
        sum
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
            let cost = own + roles.iter().sum::<i64>();
            self.view.choices[c].cost = cost;
            if spread && !choice.once {
                let (first, last) = self.view.roles[choice.roles.0];
                for way in first..last {
                    order.push((own + self.way_cost(&self.view.ways[way]), c));
                }
            } else {
                order.push((cost, c));
            }
        }
        let mut value = 0;
        let mut margin = FAR;
        if number == 1 {
            if let Some(&(cost, ..)) = order.iter().min() {
                (value, margin) = (cost, cost);
            }
        } else {
            if order.len() > number {
                order.select_nth_unstable(number - 1);
                order.truncate(number);
            }
            order.sort_unstable();
            let mut left = number;
            for &(cost, c) in &order {
                let choice = self.view.choices[c];
                let times = if spread || choice.once { 1 } else { left };
                value += cost * times as i64;
                margin = cost;
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

    /// Facilities open where that pays, and as many as their families need.
    fn open(&mut self, terms: &Dualized) -> i64 {
        for index in 0..self.view.openings.len() {
            let (facility, roles) =
                (self.view.openings[index].facility, self.view.openings[index].roles);
            let facility = &terms.facilities[facility];
            let mut cost = facility.resource.map_or(0, |r| self.prices[r]);
            cost -= facility.links.iter().map(|&(l, times)| self.prices[l] * times).sum::<i64>();
            cost += self.view.cheapest[roles.0..roles.1].iter().sum::<i64>();
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
                    opening.spares = opening.spares.max(dearest);
                }
            }
        }
        self.view.openings.iter().filter(|o| o.open).map(|o| o.cost).sum()
    }

    /// Brings the living domains into the view.
    fn build(&mut self, terms: &Dualized, model: &Model, domains: &Domains) {
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
                        && (d == device || domains.same_domain(model, device, d))
                })
                .collect();
            devices.iter().for_each(|&d| done[d] = true);
            let start = view.choices.len();
            for alt in domains.alts(model, device) {
                view.add_choice(terms, model, domains, alt);
            }
            let single = view.choices[start..].iter().all(|c| c.roles.1 - c.roles.0 == 1);
            let choices = (start, view.choices.len());
            view.groups.push(Group { spread: single && devices.len() > 1, devices, choices });
        }
        self.opening_of.clear();
        self.opening_of.resize(terms.facilities.len(), NONE);
        for (index, facility) in terms.facilities.iter().enumerate() {
            if facility.alts.iter().any(|&alt| domains.alt_on(alt)) {
                self.opening_of[index] = self.view.openings.len();
                self.view.add_opening(terms, model, domains, index, facility);
            }
        }
        self.view.cheapest.clear();
        self.view.cheapest.resize(self.view.roles.len(), 0);
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
