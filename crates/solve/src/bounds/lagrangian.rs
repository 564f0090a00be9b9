//! The Lagrangian bound: from prices on pins, resources, units and streams, an exact lower bound
//! and the choices that no better answer can contain.
//!
//! Everything that can be held only once gets a price instead of a limit (A. M. Geoffrion,
//! *Lagrangean relaxation for integer programming*, 1974; M. L. Fisher, *The Lagrangian relaxation
//! method for solving integer programming problems*, 1981). Then each group of interchangeable
//! devices, and each shared unit, makes the choice that is cheapest for itself, and the sum minus
//! the prices is a lower bound for any prices. The linear program ([`super::relaxation`]) finds the
//! best prices. Unlike the flow, this bound sees that a device's wires come from one alternative,
//! that a shared unit is opened as a whole and that groups exclude each other.
//!
//! Choices that would cost too much at these prices are removed from the domains: this is
//! reduced-cost fixing (H. Crowder, E. L. Johnson and M. Padberg, *Solving large-scale zero-one
//! linear programming problems*, 1983). All arithmetic is in integers, so the bound is exact
//! although its prices come from floating point (A. Neumaier and O. Shcherbina, *Safe bounds in
//! linear and mixed-integer linear programming*, 2004).

mod fixing;
mod multipliers;

use super::dualized::Dualized;
use super::subproblems::{SlotChoice, Subproblems};
use crate::domains::{Charge, Domains};
use crate::index::{GroupId, IdVec, OpeningId, OptionId, PriceId};
use crate::model::Model;

/// More than any sum of costs ([`crate::answer::Fault::TooLarge`] ensures that).
const FAR: i64 = 1 << 54;

/// Prices, and the subproblems as last assessed.
#[derive(Clone, Debug)]
pub(crate) struct Lagrangian {
    prices: IdVec<PriceId, i64>,
    /// The bound as last assessed, without the charges already paid.
    value: i64,
    subproblems: Subproblems,
}

impl Lagrangian {
    pub(crate) fn new(dualized: &Dualized) -> Self {
        Self {
            prices: IdVec::same(0, dualized.prices.len()),
            value: 0,
            subproblems: Subproblems::default(),
        }
    }

    /// The greatest weight of an answer below the limit, without paid charges other than penalties.
    pub(crate) fn most(
        dualized: &Dualized,
        model: &Model,
        domains: &Domains,
        limit: u64,
    ) -> Option<u64> {
        let unit = model.weights.cost;
        Some((limit - 1).checked_sub(Self::beside(dualized, model, domains))? / unit * unit)
    }

    /// The charges already paid, except penalties.
    fn beside(dualized: &Dualized, model: &Model, domains: &Domains) -> u64 {
        let paid = dualized.penalties.iter().filter(|p| domains.rule[p.rule] == Charge::Paid);
        domains.paid - paid.count() as u64 * model.weights.rule
    }

    /// Sets new prices.
    pub(crate) fn set(&mut self, prices: impl Iterator<Item = i64>) {
        self.prices.iter_mut().zip(prices).for_each(|(price, new)| *price = new);
    }

    /// The complete bound at the present prices.
    pub(crate) fn assess(&mut self, dualized: &Dualized, model: &Model, domains: &Domains) -> u64 {
        self.subproblems.build(dualized, model, domains);
        self.value = self.evaluate(dualized) + self.pay(dualized, model, domains);
        // The weight of pins, moves and rules is a multiple of the unit.
        let unit = model.weights.cost;
        let units = self.value.max(0).unsigned_abs().div_ceil(unit << dualized.shift);
        units * unit + Self::beside(dualized, model, domains)
    }

    #[inline]
    fn way_cost(&self, way: &SlotChoice) -> i64 {
        let more = self.subproblems.lists.of(way.more);
        way.fixed + self.prices[way.price] + more.iter().map(|&p| self.prices[p]).sum::<i64>()
    }

    /// The bound at the present prices (without the charges already paid).
    fn evaluate(&mut self, dualized: &Dualized) -> i64 {
        for slot in self.subproblems.slots.ids() {
            let ways = self.subproblems.ways.of(self.subproblems.slots[slot]);
            let costs = ways.iter().map(|way| self.way_cost(way));
            self.subproblems.cheapest[slot] = costs.min().unwrap_or(FAR);
        }
        let held = self.prices.of(dualized.held).iter().sum::<i64>();
        let groups = self.subproblems.groups.ids();
        let groups: i64 = groups.iter().map(|index| self.choose(index)).sum();
        groups + self.open(dualized) - held
    }

    /// Rules are violated where that pays off, and where it is certain.
    fn pay(&mut self, dualized: &Dualized, model: &Model, domains: &Domains) -> i64 {
        let weight = (model.weights.rule as i64) << dualized.shift;
        self.subproblems.penalties.clear();
        let mut sum = 0;
        for penalty in &dualized.penalties {
            let linked = penalty.links.iter().map(|&(l, times)| self.prices[l] * times);
            let cost = weight - linked.sum::<i64>();
            self.subproblems.penalties.push(cost);
            sum += match domains.rule[penalty.rule] {
                Charge::Open => cost.min(0),
                Charge::Paid => cost,
                Charge::Closed => 0,
            };
        }
        sum
    }

    /// A group of interchangeable devices takes the cheapest options that all of them can have
    /// together.
    fn choose(&mut self, index: GroupId) -> i64 {
        let mut order = std::mem::take(&mut self.subproblems.order);
        self.price_options(index, &mut order);
        let group = &self.subproblems.groups[index];
        let (number, spread) = (group.devices.len(), group.spread);
        let mut value = 0;
        let mut margin = FAR;
        if number == 1 {
            if let Some(&(cost, _)) = order.iter().min() {
                (value, margin) = (cost, cost);
            }
        } else {
            if order.len() > number {
                order.select_nth_unstable(number - 1);
                order.truncate(number);
            }
            order.sort_unstable();
            let mut left = number;
            for &(cost, option) in &order {
                let once = spread || self.subproblems.options[option].once;
                let times = if once { 1 } else { left };
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
        self.subproblems.margin[index] = margin;
        self.subproblems.order = order;
        value
    }

    /// Prices each option of a group, and lists what its devices can take.
    fn price_options(&mut self, index: GroupId, order: &mut Vec<(i64, OptionId)>) {
        let group = &self.subproblems.groups[index];
        let (options, spread) = (group.options, group.spread);
        order.clear();
        for id in options {
            let option = self.subproblems.options[id];
            let own = self.subproblems.lists.of(option.prices);
            let own: i64 = own.iter().map(|&p| self.prices[p]).sum();
            let slots = self.subproblems.cheapest.of(option.slots);
            let cost = own + slots.iter().sum::<i64>();
            self.subproblems.options[id].cost = cost;
            if spread && !option.once {
                let ways = self.subproblems.slots[option.slots.at(0)];
                let ways = self.subproblems.ways.of(ways).iter();
                order.extend(ways.map(|way| (own + self.way_cost(way), id)));
            } else {
                order.push((cost, id));
            }
        }
    }

    /// Opens facilities where that pays off, and as many as their covers need.
    fn open(&mut self, dualized: &Dualized) -> i64 {
        for opening in &mut self.subproblems.openings {
            let facility = &dualized.facilities[opening.facility];
            let links = facility.links.iter().map(|&(l, times)| self.prices[l] * times);
            let resource = facility.resource.map_or(0, |r| self.prices[r]);
            let slots = self.subproblems.cheapest.of(opening.slots);
            opening.cost = resource - links.sum::<i64>() + slots.iter().sum::<i64>();
            opening.open = opening.forced || opening.cost < 0;
            opening.saves = 0;
        }
        for cover in &dualized.covers {
            let members = cover.members.iter().filter_map(|&f| self.subproblems.opening_of[f]);
            let members: Vec<OpeningId> = members.collect();
            let openings = &mut self.subproblems.openings;
            let open = members.iter().filter(|&&opening| openings[opening].open).count();
            let mut dearest = 0;
            for _ in open..cover.need {
                let shut = members.iter().copied().filter(|&opening| !openings[opening].open);
                let Some(next) = shut.min_by_key(|&opening| openings[opening].cost) else { break };
                openings[next].open = true;
                dearest = openings[next].cost.max(dearest);
            }
            for &member in members.iter().filter(|_| dearest > 0) {
                openings[member].saves = openings[member].saves.max(dearest);
            }
        }
        self.subproblems.openings.iter().filter(|o| o.open).map(|o| o.cost).sum()
    }
}
