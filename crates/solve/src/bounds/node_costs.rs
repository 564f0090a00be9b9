//! The domains of one node in a form that is quick to price, over and over.
#![expect(clippy::indexing_slicing, reason = "all ids come from the model")]

use crate::bounds::dualized::{Dualized, Facility};
use crate::domains::Domains;
use crate::model::{Kind, Model, NONE};
use std::collections::BTreeSet;

/// Several ways to fill a role, or a DMA request: a price each, and a fixed cost.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Way {
    pub(crate) id: usize,
    /// Pin or stream.
    pub(crate) price: usize,
    pub(crate) fixed: i64,
    /// More prices, as a range of `NodeCosts::lists`.
    pub(crate) more: (usize, usize),
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct Choice {
    pub(crate) alt: usize,
    pub(crate) prices: (usize, usize),
    pub(crate) roles: (usize, usize),
    pub(crate) cost: i64,
    pub(crate) once: bool,
}

#[derive(Clone, Debug)]
pub(crate) struct Group {
    pub(crate) devices: Vec<usize>,
    pub(crate) choices: (usize, usize),
    /// Every way of the only role can be taken once.
    pub(crate) spread: bool,
}

#[derive(Clone, Debug)]
pub(crate) struct Opening {
    pub(crate) facility: usize,
    pub(crate) roles: (usize, usize),
    pub(crate) forced: bool,
    pub(crate) cost: i64,
    pub(crate) open: bool,
    /// What its opening would save elsewhere: another one opened only for the number's sake.
    pub(crate) spares: i64,
}

/// The domains of one node in a form that is quick to price.
#[derive(Clone, Debug, Default)]
pub(crate) struct NodeCosts {
    pub(crate) groups: Vec<Group>,
    pub(crate) choices: Vec<Choice>,
    /// Ranges of `ways`.
    pub(crate) roles: Vec<(usize, usize)>,
    pub(crate) ways: Vec<Way>,
    pub(crate) lists: Vec<usize>,
    pub(crate) openings: Vec<Opening>,
    /// Cheapest way of each role at the present prices.
    pub(crate) cheapest: Vec<i64>,
    /// What violating each rule costs at the present prices.
    pub(crate) penalties: Vec<i64>,
    /// Dearest choice that some device of the group takes.
    pub(crate) margin: Vec<i64>,
    pub(crate) order: Vec<(i64, usize)>,
}

impl NodeCosts {
    pub(crate) fn add_way(&mut self, terms: &Dualized, model: &Model, more: &[usize], id: usize) {
        let start = self.lists.len();
        self.lists.extend_from_slice(more);
        let c = model.cand(id);
        self.ways.push(Way {
            id,
            price: c.pin,
            fixed: ((c.extra + model.pin_weight[c.pin]) as i64) << terms.shift,
            more: (start, self.lists.len()),
        });
    }

    pub(crate) fn add_requests(&mut self, requests: &[Vec<usize>]) {
        for request in requests {
            let start = self.ways.len();
            for &price in request {
                self.ways.push(Way { id: NONE, price, fixed: 0, more: (0, 0) });
            }
            self.roles.push((start, self.ways.len()));
        }
    }

    pub(crate) fn add_choice(
        &mut self,
        terms: &Dualized,
        model: &Model,
        domains: &Domains,
        alt: usize,
    ) {
        let prices = self.lists.len();
        self.lists.extend_from_slice(terms.alt_prices.at(alt));
        let prices = (prices, self.lists.len());
        let roles = self.roles.len();
        for role in model.roles.range(alt) {
            if model.role_kind[role] != Kind::Own {
                continue;
            }
            let start = self.ways.len();
            for id in domains.cands(model, role) {
                self.add_way(terms, model, terms.cand_prices.at(id), id);
            }
            self.roles.push((start, self.ways.len()));
        }
        self.add_requests(&terms.alt_requests[alt]);
        self.choices.push(Choice {
            alt,
            prices,
            roles: (roles, self.roles.len()),
            cost: 0,
            once: model.alt_claims.at(alt).iter().any(|c| c.1 == 0),
        });
    }

    pub(crate) fn add_opening(
        &mut self,
        terms: &Dualized,
        model: &Model,
        domains: &Domains,
        index: usize,
        facility: &Facility,
    ) {
        let roles = self.roles.len();
        let decided =
            facility.alts.iter().find(|&&alt| domains.decided(model.alt_device[alt]) == Some(alt));
        for &wire in &facility.wires {
            let start = self.ways.len();
            let mut seen = BTreeSet::new();
            for &id in model.wire_cands.at(wire) {
                let c = model.cand(id);
                let here = decided.is_none_or(|&alt| model.role_alt[c.role] == alt);
                if here && domains.cand_on(model, id) && seen.insert((c.pin, c.signal, c.holder)) {
                    self.add_way(terms, model, &[], id);
                }
            }
            self.roles.push((start, self.ways.len()));
        }
        self.add_requests(&facility.requests);
        self.openings.push(Opening {
            facility: index,
            roles: (roles, self.roles.len()),
            forced: decided.is_some() || domains.opened.contains(&index),
            cost: 0,
            open: false,
            spares: 0,
        });
    }
}
