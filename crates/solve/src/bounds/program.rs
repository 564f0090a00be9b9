//! The linear program of the price bound: terms and domains in, matrix and meaning of its columns
//! out.
//!
//! Devices that are alike stand in one set of columns that count them, so the program is small,
//! and no branch of the search makes it wrong: where their domains have come to differ it is only
//! less sharp. A role with one way left has no columns; its entries go to who needs it.
#![expect(clippy::indexing_slicing, reason = "all indices are made here or come from the model")]

use crate::bounds::dualized::Dualized;
use crate::bounds::lp::{Matrix, Simplex};
use crate::domains::Domains;
use crate::index::Rows;
use crate::model::{Kind, Model, NONE};
use std::collections::BTreeMap;

/// Costs are moved by at most this part of a unit, so that hardly two columns are alike.
const JITTER: f64 = 2e-5;

/// An alternative or candidate that is there, but has no column of its own.
pub(crate) const MERGED: usize = NONE - 1;

/// The program and what its columns stand for.
#[derive(Clone, Debug)]
pub(crate) struct Program {
    pub(crate) simplex: Simplex,
    pub(crate) columns: usize,
    /// Row of each price.
    pub(crate) price_row: Vec<usize>,
    /// Column of an alternative, by that of the first device that is alike.
    pub(crate) alt_column: Vec<usize>,
    /// Columns whose sum is the number of devices at an alternative, by the same.
    pub(crate) counted: Rows<usize>,
    pub(crate) cand_column: Vec<usize>,
    /// Column of each facility.
    pub(crate) opening: Vec<usize>,
    /// Column of each penalty.
    pub(crate) penalty: Vec<usize>,
    /// The most that each column may be while it lives. The exact bound knows of few of these
    /// limits; the others are never reached, so that no price hides in them.
    pub(crate) ceiling: Vec<f64>,
    /// Columns that no domain bounds.
    pub(crate) loose: Vec<usize>,
}

type Entries = Vec<(usize, f64)>;

/// One way to fill a role: the candidates that mean it, its cost and entries.
struct Way {
    ids: Vec<usize>,
    cost: u64,
    entries: Entries,
}

struct Builder<'a> {
    terms: &'a Dualized,
    model: &'a Model,
    domains: &'a Domains,
    matrix: Matrix,
    cost: Vec<f64>,
    /// Bounds of rows.
    bounds: Vec<(f64, f64)>,
    price_row: Vec<usize>,
    counted: Vec<Vec<usize>>,
    alt_column: Vec<usize>,
    cand_column: Vec<usize>,
    opening: Vec<usize>,
    loose: Vec<usize>,
    ceiling: Vec<f64>,
    /// Of the columns now made.
    present: f64,
    /// Rows of a facility's families.
    family_rows: Vec<Vec<usize>>,
}

impl Program {
    /// The program of what the domains allow now.
    pub(crate) fn new(terms: &Dualized, model: &Model, domains: &Domains) -> Self {
        let mut builder = Builder {
            terms,
            model,
            domains,
            matrix: Matrix::default(),
            cost: Vec::new(),
            bounds: Vec::new(),
            price_row: vec![NONE; terms.prices],
            counted: vec![Vec::new(); model.alt_device.len()],
            alt_column: vec![NONE; model.alt_device.len()],
            cand_column: vec![NONE; model.cand_count()],
            opening: vec![NONE; terms.facilities.len()],
            loose: Vec::new(),
            ceiling: Vec::new(),
            present: 2.0,
            family_rows: vec![Vec::new(); terms.facilities.len()],
        };
        builder.families();
        for device in (0..model.devices).filter(|&d| model.class[d] == d) {
            builder.class(device);
        }
        for facility in 0..terms.facilities.len() {
            builder.facility(facility);
        }
        let penalty = (0..terms.penalties.len()).map(|p| builder.penalty(p)).collect();
        builder.finish(penalty)
    }
}

impl Builder<'_> {
    fn row(&mut self, least: f64, most: f64) -> usize {
        self.bounds.push((least, most));
        self.bounds.len() - 1
    }

    fn column(&mut self, cost: u64, entries: &[(usize, f64)]) -> usize {
        let column = self.matrix.add(entries);
        // A fixed sequence that looks like chance.
        let chance = (column as u64 + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15) >> 32;
        let chance = chance as f64 / (1_u64 << 32) as f64;
        self.ceiling.push(self.present);
        self.cost
            .push(cost as f64 / self.model.weights.cost as f64 + JITTER * (0.5 + chance / 2.0));
        column
    }

    /// Entry in the row of a price, which is made when first needed.
    fn priced(&mut self, price: usize, times: f64) -> (usize, f64) {
        if self.price_row[price] == NONE {
            let most = if price < self.terms.first_link { 1.0 } else { 0.0 };
            self.price_row[price] = self.row(f64::NEG_INFINITY, most);
        }
        (self.price_row[price], times)
    }

    fn way(&mut self, ids: Vec<usize>, prices: &[usize]) -> Way {
        let c = *self.model.cand(ids[0]);
        let mut entries = vec![self.priced(c.pin, 1.0)];
        entries.extend(prices.iter().map(|&price| self.priced(price, 1.0)));
        Way { ids, cost: c.extra + self.model.pin_weight[c.pin], entries }
    }

    fn streams(&mut self, requests: &[Vec<usize>]) -> Vec<Vec<Way>> {
        let way = |b: &mut Self, &stream: &usize| {
            let entries = vec![b.priced(stream, 1.0)];
            Way { ids: Vec::new(), cost: 0, entries }
        };
        requests.iter().map(|r| r.iter().map(|stream| way(self, stream)).collect()).collect()
    }

    /// The column of something that fills these roles whenever it is taken.
    fn owner(&mut self, mut entries: Entries, roles: Vec<Vec<Way>>) -> usize {
        let mut cost = 0;
        for mut ways in roles {
            if ways.len() == 1
                && let Some(way) = ways.pop()
            {
                cost += way.cost;
                entries.extend(way.entries);
                way.ids.into_iter().for_each(|id| self.cand_column[id] = MERGED);
                continue;
            }
            let row = self.row(0.0, 0.0);
            entries.push((row, -1.0));
            for mut way in ways {
                way.entries.push((row, 1.0));
                self.fill(way);
            }
        }
        self.column(cost, &entries)
    }

    fn fill(&mut self, way: Way) -> usize {
        let column = self.column(way.cost, &way.entries);
        if way.ids.is_empty() {
            self.loose.push(column);
        }
        way.ids.into_iter().for_each(|id| self.cand_column[id] = column);
        column
    }

    /// All devices that are alike.
    fn class(&mut self, device: usize) {
        let model = self.model;
        let alike = |d: &usize| model.class[*d] == device;
        let devices: Vec<usize> = (device..model.devices).filter(alike).collect();
        let range = model.alts.range(device);
        let number = devices.len() as f64;
        let convexity = self.row(number, number);
        let lone = devices.len() == 1 || range.len() == 1;
        self.present = 2.0 * number;
        for alt in range.clone() {
            let twins: Vec<usize> =
                devices.iter().map(|&d| model.alts.range(d).start + alt - range.start).collect();
            if twins.iter().any(|&twin| self.domains.alt_on(twin)) {
                self.alternative(&twins, convexity, lone);
            }
        }
    }

    /// The same alternative of devices that are alike.
    fn alternative(&mut self, twins: &[usize], convexity: usize, lone: bool) {
        let (model, terms, alt) = (self.model, self.terms, twins[0]);
        let mut roles = Vec::new();
        for role in model.roles.range(alt) {
            match model.role_kind[role] {
                Kind::Own => roles.push(self.ways(twins, role)),
                // Nobody prices these.
                Kind::Odd => {
                    let ids = self.ways(twins, role).into_iter().flat_map(|way| way.ids);
                    ids.for_each(|id| self.cand_column[id] = MERGED);
                }
                Kind::Wire(_) => {}
            }
        }
        let mut entries = vec![(convexity, 1.0)];
        let prices = terms.alt_prices.at(alt).iter();
        entries.extend(prices.map(|&price| self.priced(price, 1.0)));
        let requests = &terms.alt_requests[alt];
        if lone && roles.len() == 1 && requests.is_empty() {
            self.alt_column[alt] = MERGED;
            for mut way in roles.into_iter().flatten() {
                way.entries.extend(&entries);
                let column = self.fill(way);
                self.counted[alt].push(column);
            }
            return;
        }
        roles.extend(self.streams(requests));
        let column = self.owner(entries, roles);
        self.ceiling[column] = 2.0 * twins.len() as f64;
        self.alt_column[alt] = column;
        self.counted[alt].push(column);
    }

    /// The ways of a role that some device of those alike has left.
    fn ways(&mut self, twins: &[usize], role: usize) -> Vec<Way> {
        let (model, terms) = (self.model, self.terms);
        let first = model.roles.range(twins[0]).start;
        let place = model.cands.range(role).start;
        let mut ways = Vec::new();
        for id in model.cands.range(role) {
            let twin = |&alt: &usize| {
                let role = model.roles.range(alt).start + role - first;
                model.cands.range(role).start + id - place
            };
            let ids: Vec<usize> = twins.iter().map(twin).collect();
            if ids.iter().any(|&id| self.domains.cand_on(model, id)) {
                ways.push(self.way(ids, terms.cand_prices.at(id)));
            }
        }
        ways
    }

    fn facility(&mut self, index: usize) {
        let (model, terms) = (self.model, self.terms);
        let facility = &terms.facilities[index];
        if !facility.alts.iter().any(|&alt| self.domains.alt_on(alt)) {
            return;
        }
        let mut entries: Entries = self.family_rows[index].iter().map(|&row| (row, 1.0)).collect();
        entries.extend(facility.resource.map(|price| self.priced(price, 1.0)));
        let links = facility.links.iter();
        entries.extend(links.map(|&(link, times)| self.priced(link, -(times as f64))));
        let mut roles = Vec::new();
        for &wire in &facility.wires {
            let mut places: BTreeMap<_, Vec<usize>> = BTreeMap::new();
            for &id in model.wire_cands.at(wire) {
                let c = model.cand(id);
                places.entry((c.pin, c.signal, c.holder)).or_default().push(id);
            }
            let living = |ids: &Vec<usize>| ids.iter().any(|&id| self.domains.cand_on(model, id));
            let places: Vec<_> = places.into_values().filter(living).collect();
            roles.push(places.into_iter().map(|ids| self.way(ids, &[])).collect());
        }
        roles.extend(self.streams(&facility.requests));
        self.present = 2.0;
        let column = self.owner(entries, roles);
        self.ceiling[column] = 1.0;
        self.opening[index] = column;
    }

    /// The column of a rule, which whoever violates it is linked to.
    fn penalty(&mut self, index: usize) -> usize {
        let terms = self.terms;
        let links = terms.penalties[index].links.iter();
        let entries: Entries =
            links.map(|&(link, times)| self.priced(link, -(times as f64))).collect();
        self.present = 1.0;
        self.column(self.model.weights.rule, &entries)
    }

    /// So many of some facilities must be open.
    fn families(&mut self) {
        let terms = self.terms;
        for family in &terms.families {
            let row = self.row(family.need as f64, f64::INFINITY);
            family.members.iter().for_each(|&member| self.family_rows[member].push(row));
        }
    }

    fn finish(mut self, penalty: Vec<usize>) -> Program {
        self.matrix.finish(self.bounds.len());
        let columns = self.matrix.columns();
        let mut counted = Rows::default();
        for list in self.counted {
            list.into_iter().for_each(|column| counted.add(column));
            counted.close();
        }
        let bounds = std::iter::repeat_n((0.0, 0.0), columns).chain(self.bounds);
        let (lower, upper) = bounds.unzip();
        Program {
            simplex: Simplex::new(self.matrix, self.cost, lower, upper),
            columns,
            price_row: self.price_row,
            alt_column: self.alt_column,
            counted,
            cand_column: self.cand_column,
            opening: self.opening,
            penalty,
            loose: self.loose,
            ceiling: self.ceiling,
        }
    }
}
