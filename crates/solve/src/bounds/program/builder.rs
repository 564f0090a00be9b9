//! Builds the linear program column by column from groups of devices, facilities and rules.

use super::{Column, Program};
use crate::bounds::dualized::{Dualized, Penalty, Request};
use crate::bounds::lp::{Matrix, Simplex};
use crate::domains::Domains;
use crate::index::{
    AltId, CandId, ColumnId, FacilityId, IdVec, PenaltyId, PriceId, RoleId, RowId, Rows,
};
use crate::model::{Holding, Model};
use crate::problem::DeviceId;
use std::collections::BTreeMap;

/// Costs are perturbed by at most this fraction of a unit, so that hardly any two columns cost the
/// same.
const PERTURBATION: f64 = 2e-5;

type Entries = Vec<(RowId, f64)>;

/// One way to fill a role: its candidates, its cost and its entries.
struct RoleChoice {
    ids: Vec<CandId>,
    cost: u64,
    entries: Entries,
}

pub(super) struct Builder<'a> {
    dualized: &'a Dualized,
    model: &'a Model,
    domains: &'a Domains,
    matrix: Matrix,
    cost: IdVec<ColumnId, f64>,
    /// Bounds of rows.
    bounds: IdVec<RowId, (f64, f64)>,
    price_row: IdVec<PriceId, Option<RowId>>,
    counted: IdVec<AltId, Vec<ColumnId>>,
    alt_column: IdVec<AltId, Column>,
    cand_column: IdVec<CandId, Column>,
    opening: IdVec<FacilityId, Option<ColumnId>>,
    loose: Vec<ColumnId>,
    ceiling: IdVec<ColumnId, f64>,
    /// Ceiling of the columns that are being made.
    ceiling_now: f64,
    /// Rows of the covers that a facility is in.
    cover_rows: IdVec<FacilityId, Vec<RowId>>,
}

impl<'a> Builder<'a> {
    pub(super) fn new(dualized: &'a Dualized, model: &'a Model, domains: &'a Domains) -> Self {
        let (alts, facilities) = (model.alt_device.len(), dualized.facilities.len());
        Self {
            dualized,
            model,
            domains,
            matrix: Matrix::default(),
            cost: IdVec::default(),
            bounds: IdVec::default(),
            price_row: IdVec::same(None, dualized.prices.len()),
            counted: IdVec::same(Vec::new(), alts),
            alt_column: IdVec::same(Column::Absent, alts),
            cand_column: IdVec::same(Column::Absent, model.cand.len()),
            opening: IdVec::same(None, facilities),
            loose: Vec::new(),
            ceiling: IdVec::default(),
            ceiling_now: 2.0,
            cover_rows: IdVec::same(Vec::new(), facilities),
        }
    }

    fn row(&mut self, least: f64, most: f64) -> RowId {
        self.bounds.push((least, most))
    }

    fn column(&mut self, cost: u64, entries: &[(RowId, f64)]) -> ColumnId {
        let column = self.matrix.add(entries);
        // A fixed sequence that looks random.
        let chance = (u64::from(column.0) + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15) >> 32;
        let chance = chance as f64 / (1_u64 << 32) as f64;
        self.ceiling.push(self.ceiling_now);
        let cost = cost as f64 / self.model.weights.cost as f64;
        self.cost.push(cost + PERTURBATION * (0.5 + chance / 2.0));
        column
    }

    /// The entry in the row of a price. The row is made when first needed.
    fn priced(&mut self, price: PriceId, times: f64) -> (RowId, f64) {
        let row = self.price_row[price].unwrap_or_else(|| {
            let most = if self.dualized.is_link(price) { 0.0 } else { 1.0 };
            let row = self.row(f64::NEG_INFINITY, most);
            self.price_row[price] = Some(row);
            row
        });
        (row, times)
    }

    /// The way that these candidates represent. They differ only in the device.
    fn way(&mut self, ids: Vec<CandId>, prices: &[PriceId]) -> Option<RoleChoice> {
        let c = &self.model.cand[*ids.first()?];
        let mut entries = vec![self.priced(Dualized::pin(c.pin), 1.0)];
        entries.extend(prices.iter().map(|&price| self.priced(price, 1.0)));
        Some(RoleChoice { ids, cost: c.extra + self.model.pin_weight[c.pin], entries })
    }

    fn streams(&mut self, requests: &[Request]) -> Vec<Vec<RoleChoice>> {
        let way = |b: &mut Self, &stream: &PriceId| {
            let entries = vec![b.priced(stream, 1.0)];
            RoleChoice { ids: Vec::new(), cost: 0, entries }
        };
        requests.iter().map(|r| r.iter().map(|stream| way(self, stream)).collect()).collect()
    }

    /// The column of something that fills these roles whenever it is taken.
    fn owner(&mut self, mut entries: Entries, roles: Vec<Vec<RoleChoice>>) -> ColumnId {
        let mut cost = 0;
        for mut ways in roles {
            if ways.len() == 1
                && let Some(way) = ways.pop()
            {
                cost += way.cost;
                entries.extend(way.entries);
                self.merge(way.ids);
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

    fn merge(&mut self, ids: Vec<CandId>) {
        ids.into_iter().for_each(|id| self.cand_column[id] = Column::Merged);
    }

    fn fill(&mut self, way: RoleChoice) -> ColumnId {
        let column = self.column(way.cost, &way.entries);
        if way.ids.is_empty() {
            self.loose.push(column);
        }
        way.ids.into_iter().for_each(|id| self.cand_column[id] = Column::Of(column));
        column
    }

    /// Adds a group: interchangeable devices that have the same choices left.
    pub(super) fn group(&mut self, devices: &[DeviceId]) {
        let model = self.model;
        let Some(&leader) = devices.first() else { return };
        let alts = model.alts.of(leader);
        let number = devices.len() as f64;
        let convexity = self.row(number, number);
        let lone = devices.len() == 1 || alts.len() == 1;
        self.ceiling_now = 2.0 * number;
        for alt in alts {
            let twins: Vec<AltId> = devices.iter().map(|&d| model.twin_alt(alt, d)).collect();
            if twins.iter().any(|&twin| self.domains.has_alt(twin)) {
                self.alternative(alt, &twins, convexity, lone);
            }
        }
    }

    /// Adds the same alternative of interchangeable devices; `alt` is that of the first of them.
    fn alternative(&mut self, alt: AltId, twins: &[AltId], convexity: RowId, lone: bool) {
        let (model, dualized) = (self.model, self.dualized);
        let mut roles = Vec::new();
        for role in model.roles.of(alt) {
            match model.holding[role] {
                Holding::Own => roles.push(self.ways(twins, role)),
                // These have no price.
                Holding::Irregular => {
                    let ways = self.ways(twins, role);
                    ways.into_iter().for_each(|way| self.merge(way.ids));
                }
                Holding::Wire(_) => {}
            }
        }
        let mut entries = vec![(convexity, 1.0)];
        let prices = dualized.alt_prices[alt].iter();
        entries.extend(prices.map(|&price| self.priced(price, 1.0)));
        let requests = &dualized.alt_requests[alt];
        if lone && roles.len() == 1 && requests.is_empty() {
            self.alt_column[alt] = Column::Merged;
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
        self.alt_column[alt] = Column::Of(column);
        self.counted[alt].push(column);
    }

    /// The ways of a role that at least one of the interchangeable devices has left.
    fn ways(&mut self, twins: &[AltId], role: RoleId) -> Vec<RoleChoice> {
        let (model, dualized) = (self.model, self.dualized);
        let mut ways = Vec::new();
        for id in model.cands.of(role) {
            let ids: Vec<CandId> = twins.iter().map(|&alt| model.twin_cand(id, alt)).collect();
            if ids.iter().any(|&id| self.domains.has_cand(model, id)) {
                ways.extend(self.way(ids, &dualized.cand_prices[id]));
            }
        }
        ways
    }

    pub(super) fn facility(&mut self, index: FacilityId) {
        let (model, dualized, domains) = (self.model, self.dualized, self.domains);
        let facility = &dualized.facilities[index];
        if !facility.alts.iter().any(|&alt| domains.has_alt(alt)) {
            return;
        }
        let mut entries: Entries = self.cover_rows[index].iter().map(|&row| (row, 1.0)).collect();
        entries.extend(facility.resource.map(|price| self.priced(price, 1.0)));
        let links = facility.links.iter();
        entries.extend(links.map(|&(link, times)| self.priced(link, -(times as f64))));
        let mut roles = Vec::new();
        for &wire in &facility.wires {
            let mut places: BTreeMap<_, Vec<CandId>> = BTreeMap::new();
            for &id in &model.wire_cands[wire] {
                places.entry(model.cand[id].place()).or_default().push(id);
            }
            let living = |ids: &Vec<CandId>| ids.iter().any(|&id| domains.has_cand(model, id));
            let places = places.into_values().filter(living);
            roles.push(places.filter_map(|ids| self.way(ids, &[])).collect());
        }
        roles.extend(self.streams(&facility.requests));
        self.ceiling_now = 2.0;
        let column = self.owner(entries, roles);
        self.ceiling[column] = 1.0;
        self.opening[index] = Some(column);
    }

    /// The column of a rule. Everything that violates the rule is linked to it.
    pub(super) fn penalty(&mut self, penalty: &Penalty) -> ColumnId {
        let links = penalty.links.iter();
        let entries: Entries =
            links.map(|&(link, times)| self.priced(link, -(times as f64))).collect();
        self.ceiling_now = 1.0;
        self.column(self.model.weights.rule, &entries)
    }

    /// Requires that enough facilities of each cover are open.
    pub(super) fn covers(&mut self) {
        for cover in &self.dualized.covers {
            let row = self.row(cover.need as f64, f64::INFINITY);
            cover.members.iter().for_each(|&member| self.cover_rows[member].push(row));
        }
    }

    pub(super) fn finish(
        mut self,
        penalty: IdVec<PenaltyId, ColumnId>,
        group: IdVec<DeviceId, DeviceId>,
    ) -> Program {
        self.matrix.finish(self.bounds.len());
        let mut counted = Rows::default();
        for list in self.counted {
            counted.push(list);
        }
        let columns = self.matrix.columns().iter().map(|_| (0.0, 0.0));
        let (lower, upper): (Vec<f64>, Vec<f64>) = columns.chain(self.bounds).unzip();
        Program {
            simplex: Simplex::new(self.matrix, self.cost, lower.into(), upper.into()),
            group,
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
