//! The meaning of the prices: multipliers from which anyone can recompute the bound as last
//! assessed, device by device.

use super::Lagrangian;
use crate::bounds::dualized::{Dualized, Tie};
use crate::index::{GroupId, Id, IdVec, PriceId};
use crate::model::Model;
use crate::problem::{Holder, PinId};
use crate::trace::Multipliers;
use std::collections::BTreeMap;

impl Lagrangian {
    /// The multipliers of the bound as last assessed.
    pub(crate) fn multipliers(
        &self,
        dualized: &Dualized,
        model: &Model,
        limit: u64,
    ) -> Multipliers {
        let mut surcharges = self.prices.clone();
        let mut more: BTreeMap<PriceId, i64> = BTreeMap::new();
        let most = i64::try_from(limit).unwrap_or(i64::MAX >> 20).saturating_add(1);
        for group in self.subproblems.groups.ids() {
            self.surcharges(dualized, model, group, most << dualized.shift, &mut more);
        }
        for (price, rent) in more {
            surcharges[price] += rent;
        }
        let mut by = Multipliers { shift: dualized.shift, ..Multipliers::default() };
        for price in dualized.held.iter().filter(|price| surcharges[*price] > 0) {
            let rent = surcharges[price];
            if price.index() < model.pins.len() {
                by.pins.push((PinId(price.0), rent));
            } else if let Some(stream) = dualized.stream_of(price) {
                by.streams.push((stream, rent));
            } else {
                by.resources.push((dualized.resource_of(price), rent));
            }
        }
        for (price, tie) in &dualized.ties {
            let paid = self.prices[*price];
            if paid == 0 {
                continue;
            }
            let alike = |class| model.class_of(class);
            match *tie {
                Tie::Ticket(facility, resource) => {
                    by.tickets.push((facility.index(), resource, paid));
                }
                Tie::Link(facility, class) => {
                    by.links.extend(alike(class).map(|d| (facility.index(), d, paid)));
                }
                Tie::Rule(rule, class, place) => {
                    by.rules.extend(alike(class).map(|d| (rule, d, place, paid)));
                }
            }
        }
        by.covers = self.savings(dualized);
        by
    }

    /// Interchangeable devices cannot all take the cheapest way: a surcharge makes the cheap ways
    /// dearer until all cost what the last device pays.
    fn surcharges(
        &self,
        dualized: &Dualized,
        model: &Model,
        index: GroupId,
        far: i64,
        more: &mut BTreeMap<PriceId, i64>,
    ) {
        let subproblems = &self.subproblems;
        let group = &subproblems.groups[index];
        if group.devices.len() < 2 {
            return;
        }
        let options = subproblems.options.of(group.options);
        let ways = |option: &crate::bounds::subproblems::Choosable| {
            subproblems.ways.of(subproblems.slots[option.slots.at(0)])
        };
        let places = options.iter().map(|option| match (option.once, group.spread) {
            (true, _) => 1,
            (false, true) => ways(option).len(),
            (false, false) => group.devices.len(),
        });
        let fit = places.sum::<usize>() >= group.devices.len();
        let margin = if fit { subproblems.margin[index] } else { far };
        let mut raise = |price: PriceId, by: i64| {
            let rent = more.entry(price).or_default();
            *rent = by.max(*rent);
        };
        for option in options {
            if option.once {
                let mut claims = model.alt_claims[option.alt].iter();
                if let Some(own) = claims.find(|claim| claim.holder == Holder::Own) {
                    raise(dualized.resource(own.resource), margin - option.cost);
                }
            } else if group.spread {
                let own = option.cost - subproblems.cheapest[option.slots.at(0)];
                for way in ways(option) {
                    raise(way.price, margin - own - self.way_cost(way));
                }
            }
        }
    }

    /// The amount that an open facility saves for each of its covers: the cost of the dearest one
    /// that is open only because the cover needs it. Covers that contain each other are adjacent,
    /// the smallest first.
    fn savings(&self, dualized: &Dualized) -> Vec<(usize, i64)> {
        let openings = &self.subproblems.openings;
        let mut open: IdVec<_, bool> = openings.iter().map(|o| o.forced || o.cost < 0).collect();
        let mut dearest = Vec::new();
        for cover in &dualized.covers {
            let members = cover.members.iter().filter_map(|&f| self.subproblems.opening_of[f]);
            let members: Vec<_> = members.collect();
            let count = members.iter().filter(|&&opening| open[opening]).count();
            let mut most = 0;
            for _ in count..cover.need {
                let shut = members.iter().copied().filter(|&opening| !open[opening]);
                let Some(next) = shut.min_by_key(|&opening| openings[opening].cost) else { break };
                open[next] = true;
                most = openings[next].cost.max(most);
            }
            dearest.push(most);
        }
        let mut savings = Vec::new();
        let mut outer = 0;
        for (place, cover) in dualized.covers.iter().enumerate().rev() {
            let next = dualized.covers.get(place + 1);
            if next.is_none_or(|next| next.members.first() != cover.members.first()) {
                outer = 0;
            }
            let level = dearest.get(place).copied().unwrap_or(0).max(outer);
            if level > outer {
                savings.push((place, level - outer));
            }
            outer = level;
        }
        savings
    }
}
