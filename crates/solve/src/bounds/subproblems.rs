//! The subproblems of the Lagrangian bound: the domains of one node as flat tables that are quick
//! to price again and again.
//!
//! With prices in place of limits the problem decomposes: each group of interchangeable devices
//! chooses for itself, and each facility is opened or not by itself.

use super::dualized::{Dualized, Facility, Request};
use crate::domains::Domains;
use crate::index::{
    AltId, CandId, FacilityId, GroupId, Id, IdVec, Ids, ListId, OpeningId, OptionId, PenaltyId,
    PriceId, SlotId, WayId,
};
use crate::model::{Holding, Model};
use crate::problem::{DeviceId, Holder};
use std::collections::BTreeSet;

/// One of several ways to fill a slot: a price, more prices, and a fixed cost.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SlotChoice {
    /// The candidate, unless the way is a DMA stream.
    pub(crate) id: Option<CandId>,
    /// Pin or stream.
    pub(crate) price: PriceId,
    pub(crate) fixed: i64,
    pub(crate) more: Ids<ListId>,
}

/// An alternative that a group can choose.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Choosable {
    pub(crate) alt: AltId,
    pub(crate) prices: Ids<ListId>,
    pub(crate) slots: Ids<SlotId>,
    pub(crate) cost: i64,
    /// True if only one device can take it.
    pub(crate) once: bool,
}

/// Devices with the same choices left.
#[derive(Clone, Debug)]
pub(crate) struct Group {
    pub(crate) devices: Vec<DeviceId>,
    pub(crate) options: Ids<OptionId>,
    /// True if every way of the only slot can be taken just once.
    pub(crate) spread: bool,
}

/// A facility that can be opened.
#[derive(Clone, Debug)]
pub(crate) struct Opening {
    pub(crate) facility: FacilityId,
    pub(crate) slots: Ids<SlotId>,
    pub(crate) forced: bool,
    pub(crate) cost: i64,
    pub(crate) open: bool,
    /// The saving from opening it: the cost of another facility that is open only because a cover
    /// needs it.
    pub(crate) saves: i64,
}

/// All subproblems of one node.
#[derive(Clone, Debug, Default)]
pub(crate) struct Subproblems {
    pub(crate) groups: IdVec<GroupId, Group>,
    pub(crate) options: IdVec<OptionId, Choosable>,
    pub(crate) slots: IdVec<SlotId, Ids<WayId>>,
    pub(crate) ways: IdVec<WayId, SlotChoice>,
    pub(crate) lists: IdVec<ListId, PriceId>,
    pub(crate) openings: IdVec<OpeningId, Opening>,
    pub(crate) opening_of: IdVec<FacilityId, Option<OpeningId>>,
    /// Cost of the cheapest way of each slot at the present prices.
    pub(crate) cheapest: IdVec<SlotId, i64>,
    /// Cost of violating each rule at the present prices.
    pub(crate) penalties: IdVec<PenaltyId, i64>,
    /// Cost of the dearest option that a device of the group takes.
    pub(crate) margin: IdVec<GroupId, i64>,
    pub(crate) order: Vec<(i64, OptionId)>,
}

/// The ids from one length to the next.
fn added<I: Id>(from: usize, to: usize) -> Ids<I> {
    Ids::from_to(I::new(from), I::new(to))
}

impl Subproblems {
    /// Builds the tables from the domains.
    pub(crate) fn build(&mut self, dualized: &Dualized, model: &Model, domains: &Domains) {
        self.groups.clear();
        self.options.clear();
        self.slots.clear();
        self.ways.clear();
        self.lists.clear();
        self.openings.clear();
        let mut done = IdVec::same(false, model.devices.len());
        for device in model.devices {
            if !done[device] {
                self.add_group(dualized, model, domains, device, &mut done);
            }
        }
        self.opening_of.reset(None, dualized.facilities.len());
        for (index, facility) in dualized.facilities.enumerate() {
            if facility.alts.iter().any(|&alt| domains.has_alt(alt)) {
                let opening = self.add_opening(dualized, model, domains, index, facility);
                self.opening_of[index] = Some(opening);
            }
        }
        self.cheapest.reset(0, self.slots.len());
        self.margin.reset(0, self.groups.len());
    }

    fn add_group(
        &mut self,
        dualized: &Dualized,
        model: &Model,
        domains: &Domains,
        first: DeviceId,
        done: &mut IdVec<DeviceId, bool>,
    ) {
        let from = Ids::from_to(first, model.devices.at(model.devices.len()));
        let joins = |&d: &DeviceId| {
            model.class[d] == model.class[first]
                && (d == first || domains.same_domain(model, first, d))
        };
        let devices: Vec<DeviceId> = from.iter().filter(joins).collect();
        devices.iter().for_each(|&d| done[d] = true);
        let start = self.options.len();
        for alt in domains.alts(model, first) {
            self.add_option(dualized, model, domains, alt);
        }
        let options = added(start, self.options.len());
        let single = self.options.of(options).iter().all(|o| o.slots.len() == 1);
        self.groups.push(Group { spread: single && devices.len() > 1, devices, options });
    }

    fn add_option(&mut self, dualized: &Dualized, model: &Model, domains: &Domains, alt: AltId) {
        let prices = self.add_list(&dualized.alt_prices[alt]);
        let slots = self.slots.len();
        for role in model.roles.of(alt) {
            if model.holding[role] != Holding::Own {
                continue;
            }
            let start = self.ways.len();
            for id in domains.cands(model, role) {
                self.add_way(dualized, model, &dualized.cand_prices[id], id);
            }
            self.slots.push(added(start, self.ways.len()));
        }
        self.add_requests(&dualized.alt_requests[alt]);
        self.options.push(Choosable {
            alt,
            prices,
            slots: added(slots, self.slots.len()),
            cost: 0,
            once: model.alt_claims[alt].iter().any(|c| c.holder == Holder::Own),
        });
    }

    fn add_opening(
        &mut self,
        dualized: &Dualized,
        model: &Model,
        domains: &Domains,
        index: FacilityId,
        facility: &Facility,
    ) -> OpeningId {
        let slots = self.slots.len();
        let decided = |&&alt: &&AltId| domains.decided(model.alt_device[alt]) == Some(alt);
        let decided = facility.alts.iter().find(decided);
        for &wire in &facility.wires {
            let start = self.ways.len();
            let mut seen = BTreeSet::new();
            for &id in &model.wire_cands[wire] {
                let c = &model.cand[id];
                let here = decided.is_none_or(|&alt| model.role_alt[c.role] == alt);
                if here && domains.has_cand(model, id) && seen.insert(c.place()) {
                    self.add_way(dualized, model, &[], id);
                }
            }
            self.slots.push(added(start, self.ways.len()));
        }
        self.add_requests(&facility.requests);
        self.openings.push(Opening {
            facility: index,
            slots: added(slots, self.slots.len()),
            forced: decided.is_some() || domains.opened.contains(&index),
            cost: 0,
            open: false,
            saves: 0,
        })
    }

    fn add_way(&mut self, dualized: &Dualized, model: &Model, more: &[PriceId], id: CandId) {
        let more = self.add_list(more);
        let c = &model.cand[id];
        self.ways.push(SlotChoice {
            id: Some(id),
            price: Dualized::pin(c.pin),
            fixed: ((c.extra + model.pin_weight[c.pin]) as i64) << dualized.shift,
            more,
        });
    }

    fn add_requests(&mut self, requests: &[Request]) {
        for request in requests {
            let start = self.ways.len();
            for &price in request {
                self.ways.push(SlotChoice { id: None, price, fixed: 0, more: Ids::default() });
            }
            self.slots.push(added(start, self.ways.len()));
        }
    }

    fn add_list(&mut self, prices: &[PriceId]) -> Ids<ListId> {
        let start = self.lists.len();
        for &price in prices {
            self.lists.push(price);
        }
        added(start, self.lists.len())
    }
}
