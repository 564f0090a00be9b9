//! The linear relaxation: the problem of the Lagrangian bound as a linear program, whose row prices
//! are the best possible prices.
//!
//! Dualized constraints and domains in, prices and the number of devices at each alternative out.
//! The program is made once; a node changes bounds of columns and starts from the basis of the node
//! before. Nothing here needs to be exact (see [`super::lp`]): [`super::lagrangian`] judges the
//! prices.

use super::dualized::Dualized;
use super::lagrangian::Lagrangian;
use super::lp::Status;
use super::program::{Column, Program};
use crate::cancel::Cancel;
use crate::domains::{Charge, Domains};
use crate::index::{AltId, CandId, ColumnId, FacilityId, IdVec, PenaltyId, RoleId};
use crate::model::{Holding, Model};
use crate::problem::DeviceId;
use std::collections::BTreeMap;

/// The program, and the bounds of its columns at the present node.
#[derive(Clone, Debug)]
pub(crate) struct Relaxation {
    program: Program,
    most: IdVec<ColumnId, f64>,
    least: IdVec<ColumnId, f64>,
}

/// The program lacks something that is possible now.
struct Outdated;

impl Relaxation {
    /// The program of what the domains allow now.
    pub(crate) fn new(dualized: &Dualized, model: &Model, domains: &Domains) -> Self {
        let program = Program::new(dualized, model, domains);
        let columns = program.simplex.columns().len();
        Self { program, most: IdVec::same(0.0, columns), least: IdVec::same(0.0, columns) }
    }

    /// Brings the bounds of the columns up to date.
    fn update(
        &mut self,
        dualized: &Dualized,
        model: &Model,
        domains: &Domains,
    ) -> Result<(), Outdated> {
        self.most.fill(0.0);
        self.least.fill(0.0);
        for device in model.devices {
            for alt in domains.alts(model, device) {
                let decided = domains.decided(device) == Some(alt);
                self.allow_alt(model, alt, decided)?;
                for role in model.roles.of(alt) {
                    if let Some(id) = domains.chosen(role).filter(|_| decided) {
                        self.require_cand(model, role, id);
                    }
                }
                for role in model.roles.of(alt) {
                    domains.cands(model, role).try_for_each(|id| self.allow_cand(id))?;
                }
            }
        }
        self.update_facilities(dualized, model, domains);
        let Program { alt_column, penalty, loose, ceiling, .. } = &self.program;
        for (&column, penalty) in penalty.iter().zip(&dualized.penalties) {
            let charge = domains.rule[penalty.rule];
            self.most[column] = f64::from(u8::from(charge != Charge::Closed));
            self.least[column] = f64::from(u8::from(charge == Charge::Paid));
        }
        loose.iter().for_each(|&column| self.most[column] = ceiling[column]);
        // All devices of the group may take it: no limit.
        for column in alt_column {
            if let Column::Of(column) = *column
                && self.most[column] * 2.0 == ceiling[column]
            {
                self.most[column] = ceiling[column];
            }
        }
        for (column, least) in self.least.enumerate() {
            self.program.simplex.bound(column, *least, self.most[column]);
        }
        Ok(())
    }

    fn allow_alt(&mut self, model: &Model, alt: AltId, decided: bool) -> Result<(), Outdated> {
        let leader = model.twin_alt(alt, self.program.group[model.alt_device[alt]]);
        match self.program.alt_column[leader] {
            Column::Absent => return Err(Outdated),
            Column::Merged => {}
            Column::Of(column) => {
                self.most[column] += 1.0;
                self.least[column] += f64::from(u8::from(decided));
            }
        }
        Ok(())
    }

    fn allow_cand(&mut self, id: CandId) -> Result<(), Outdated> {
        match self.program.cand_column[id] {
            Column::Absent => return Err(Outdated),
            Column::Merged => {}
            Column::Of(column) => self.most[column] = self.program.ceiling[column],
        }
        Ok(())
    }

    /// A decided device has one candidate left for a role.
    fn require_cand(&mut self, model: &Model, role: RoleId, id: CandId) {
        if let Column::Of(column) = self.program.cand_column[id] {
            let wire = matches!(model.holding[role], Holding::Wire(_));
            self.least[column] = if wire { 1.0 } else { self.least[column] + 1.0 };
        }
    }

    fn update_facilities(&mut self, dualized: &Dualized, model: &Model, domains: &Domains) {
        for (index, column) in self.program.opening.enumerate() {
            let Some(column) = *column else { continue };
            let alts = &dualized.facilities[index].alts;
            let used = |&alt: &AltId| domains.decided(model.alt_device[alt]) == Some(alt);
            let forced = domains.opened.contains(&index) || alts.iter().any(used);
            let possible = alts.iter().any(|&alt| domains.has_alt(alt));
            self.most[column] = f64::from(u8::from(possible));
            self.least[column] = f64::from(u8::from(forced));
        }
    }

    /// Solves the program under the present domains and passes the prices on. Stops once the value
    /// is certainly above `cutoff` (a weight).
    pub(crate) fn run(
        &mut self,
        dualized: &Dualized,
        model: &Model,
        domains: &Domains,
        lagrangian: &mut Lagrangian,
        (cutoff, steps, cancel): (u64, usize, Cancel<'_>),
    ) -> Status {
        if self.update(dualized, model, domains).is_err() {
            *self = Self::new(dualized, model, domains);
            // A program made from these domains contains everything that they allow.
            let _ = self.update(dualized, model, domains);
        }
        let unit = model.weights.cost as f64;
        let status = self.program.simplex.solve(cutoff as f64 / unit + 0.03, steps, cancel);
        let scale = -unit * (1_u64 << dualized.shift) as f64;
        let most = dualized.dearest(model) as f64;
        let price = |row| (self.program.simplex.price(row) * scale).round().clamp(0.0, most) as i64;
        lagrangian.set(self.program.price_row.iter().map(|row| row.map_or(0, price)));
        status
    }

    /// The work of the simplex method since the last call.
    pub(crate) fn take_work(&mut self) -> u64 {
        self.program.simplex.take_work()
    }

    /// Keeps the basis, for [`Self::go_back`].
    pub(crate) fn remember(&mut self) {
        self.program.simplex.remember();
    }

    /// Restores the basis that was kept, unless the program has been made again since.
    pub(crate) fn go_back(&mut self) {
        self.program.simplex.go_back();
    }

    /// The value of the program in units of cost, as far as its prices prove it.
    pub(crate) fn bound(&self) -> f64 {
        self.program.simplex.objective()
    }

    /// The fraction to which a facility is open.
    pub(crate) fn opened(&self, facility: FacilityId) -> f64 {
        let column = self.program.opening[facility];
        column.map_or(0.0, |column| self.program.simplex.value(column))
    }

    /// The fraction to which a rule is violated.
    pub(crate) fn violated(&self, penalty: PenaltyId) -> f64 {
        self.program.simplex.value(self.program.penalty[penalty])
    }

    /// The device that represents this one in the program: the first of those with the same
    /// choices.
    pub(crate) fn group(&self, device: DeviceId) -> DeviceId {
        self.program.group[device]
    }

    /// The groups of devices that share one set of columns.
    pub(crate) fn groups(&self) -> Vec<Vec<DeviceId>> {
        let mut groups: BTreeMap<DeviceId, Vec<DeviceId>> = BTreeMap::new();
        for (device, first) in self.program.group.enumerate() {
            groups.entry(*first).or_default().push(device);
        }
        groups.into_values().collect()
    }

    /// How many devices of a group take this alternative.
    pub(crate) fn value(&self, model: &Model, alt: AltId) -> f64 {
        let leader = model.twin_alt(alt, self.program.group[model.alt_device[alt]]);
        let columns = self.program.counted[leader].iter();
        columns.map(|&column| self.program.simplex.value(column)).sum()
    }
}
