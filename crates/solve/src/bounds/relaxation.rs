//! The linear relaxation: what the price bound prices, as a linear program whose row prices are
//! the best prices there are.
//!
//! Dualized and domains in, prices and the number of devices at each alternative out. The program is
//! made once; a node changes bounds of columns, and the basis of the node before is the start.
//! Nothing here needs to be exact (see [`crate::bounds::lp`]): [`crate::bounds::lagrangian`] judges the prices.
#![expect(clippy::indexing_slicing, reason = "all indices are made here or come from the model")]

use crate::bounds::dualized::Dualized;
use crate::bounds::lagrangian::Lagrangian;
use crate::bounds::lp::Status;
use crate::bounds::program::{MERGED, Program};
use crate::cancel::Cancel;
use crate::domains::{Charge, Domains};
use crate::model::{Kind, Model, NONE};

/// The program, and the bounds of its columns at the present node.
#[derive(Clone, Debug)]
pub(crate) struct Relaxation {
    program: Program,
    most: Vec<f64>,
    least: Vec<f64>,
}

impl Relaxation {
    /// The program of what the domains allow now.
    pub(crate) fn new(terms: &Dualized, model: &Model, domains: &Domains) -> Self {
        let program = Program::new(terms, model, domains);
        let columns = program.columns;
        Self { program, most: vec![0.0; columns], least: vec![0.0; columns] }
    }

    /// Brings the bounds up to date; false when the program lacks something that is possible now.
    fn update(&mut self, terms: &Dualized, model: &Model, domains: &Domains) -> bool {
        let Program { alt_column, cand_column, opening, penalty, loose, ceiling, .. } =
            &self.program;
        self.most.fill(0.0);
        self.least.fill(0.0);
        for device in 0..model.devices {
            let class = model.alts.range(model.class[device]).start;
            let first = model.alts.range(device).start;
            let decided = domains.decided(device);
            for alt in domains.alts(model, device) {
                match alt_column[class + alt - first] {
                    NONE => return false,
                    MERGED => {}
                    column => {
                        self.most[column] += 1.0;
                        self.least[column] += f64::from(u8::from(decided == Some(alt)));
                    }
                }
                for role in model.roles.range(alt).filter(|_| decided == Some(alt)) {
                    if let Some(&column) = domains.pinned(role).map(|id| &cand_column[id])
                        && column < MERGED
                    {
                        let wire = matches!(model.role_kind[role], Kind::Wire(_));
                        self.least[column] = if wire { 1.0 } else { self.least[column] + 1.0 };
                    }
                }
                for id in model.roles.range(alt).flat_map(|role| domains.cands(model, role)) {
                    match cand_column[id] {
                        NONE => return false,
                        MERGED => {}
                        column => self.most[column] = ceiling[column],
                    }
                }
            }
        }
        for (index, &column) in opening.iter().enumerate().filter(|o| *o.1 != NONE) {
            let alts = &terms.facilities[index].alts;
            let used = |a: &usize| domains.decided(model.alt_device[*a]) == Some(*a);
            let forced = domains.opened.contains(&index) || alts.iter().any(used);
            self.most[column] = f64::from(u8::from(alts.iter().any(|&a| domains.alt_on(a))));
            self.least[column] = f64::from(u8::from(forced));
        }
        for (&column, penalty) in penalty.iter().zip(&terms.penalties) {
            let toll = domains.rule[penalty.rule];
            self.most[column] = f64::from(u8::from(toll != Charge::Closed));
            self.least[column] = f64::from(u8::from(toll == Charge::Paid));
        }
        loose.iter().for_each(|&column| self.most[column] = ceiling[column]);
        // All of them may: no limit.
        for &column in alt_column.iter().filter(|c| **c < MERGED) {
            if self.most[column] * 2.0 == ceiling[column] {
                self.most[column] = ceiling[column];
            }
        }
        for (column, (least, most)) in self.least.iter().zip(&self.most).enumerate() {
            self.program.simplex.bound(column, *least, *most);
        }
        true
    }

    /// Solves under the present domains and hands the prices on. A value that is certainly above
    /// `cutoff` (a weight) is enough.
    pub(crate) fn run(
        &mut self,
        terms: &Dualized,
        model: &Model,
        domains: &Domains,
        dual: &mut Lagrangian,
        (cutoff, steps, cancel): (u64, usize, Cancel<'_>),
    ) -> Status {
        if !self.update(terms, model, domains) {
            *self = Self::new(terms, model, domains);
            self.update(terms, model, domains);
        }
        let unit = model.weights.cost as f64;
        let status = self.program.simplex.solve(cutoff as f64 / unit + 0.03, steps, cancel);
        let scale = -unit * (1_u64 << terms.shift) as f64;
        let most = terms.dearest(model) as f64;
        let price = |&row: &usize| match row {
            NONE => 0,
            row => (self.program.simplex.price(row) * scale).round().clamp(0.0, most) as i64,
        };
        dual.set(self.program.price_row.iter().map(price));
        status
    }

    /// The value of the program in units of cost, as far as its prices prove it.
    pub(crate) fn worth(&self) -> f64 {
        self.program.simplex.objective()
    }

    /// How far a facility is open.
    pub(crate) fn opened(&self, facility: usize) -> f64 {
        let column = self.program.opening[facility];
        if column == NONE { 0.0 } else { self.program.simplex.value(column) }
    }

    /// How far a rule is violated.
    pub(crate) fn violated(&self, penalty: usize) -> f64 {
        self.program.simplex.value(self.program.penalty[penalty])
    }

    /// How many devices that are alike take this alternative.
    pub(crate) fn value(&self, model: &Model, alt: usize) -> f64 {
        let device = model.alt_device[alt];
        let offset = alt - model.alts.range(device).start;
        let columns = self.program.counted.at(model.alts.range(model.class[device]).start + offset);
        columns.iter().map(|&column| self.program.simplex.value(column)).sum()
    }
}
