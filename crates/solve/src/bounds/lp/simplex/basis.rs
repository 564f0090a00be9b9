//! A basis made anew: which variables are in it in, their values and all reduced costs out.
#![expect(clippy::indexing_slicing, reason = "variables and rows are those of the matrix")]

use super::{NONE, Simplex};

impl Simplex {
    /// Puts nonbasic variables on the bound that their reduced cost asks for.
    pub(super) fn place_nonbasic(&mut self) {
        for variable in 0..self.value.len() {
            if self.place[variable] == NONE {
                let reduced = self.reduced[variable];
                let (lower, upper) = (self.lower[variable], self.upper[variable]);
                let up = if lower == f64::NEG_INFINITY {
                    true
                } else if upper == f64::INFINITY {
                    false
                } else if reduced.abs() < 1e-12 {
                    self.value[variable] >= upper
                } else {
                    reduced < 0.0
                };
                self.value[variable] = if up { upper } else { lower };
            }
        }
    }

    /// Decomposes the basis and computes everything from it.
    pub(super) fn rebuild(&mut self) {
        self.factor.decompose(&self.matrix, &mut self.basic);
        for (row, &variable) in self.basic.iter().enumerate() {
            if self.place[variable] == NONE {
                self.edge[variable] = 1.0;
            }
            self.place[variable] = row;
        }
        for variable in 0..self.place.len() {
            let row = self.place[variable];
            if row != NONE && self.basic[row] != variable {
                self.place[variable] = NONE;
            }
        }
        self.compute_reduced();
        self.place_nonbasic();
        self.compute_values();
        self.ready = true;
    }

    pub(super) fn compute_reduced(&mut self) {
        let columns = self.matrix.columns();
        let mut y = std::mem::take(&mut self.rho);
        for (row, &variable) in self.basic.iter().enumerate() {
            y[row] = if variable < columns { self.cost[variable] } else { 0.0 };
        }
        self.factor.backward(&mut y);
        for column in 0..columns {
            self.reduced[column] = if self.place[column] == NONE {
                let sum: f64 = self.matrix.column(column).iter().map(|&(r, a)| a * y[r]).sum();
                self.cost[column] - sum
            } else {
                0.0
            };
        }
        for (slack, &price) in (columns..).zip(&y) {
            self.reduced[slack] = if self.place[slack] == NONE { price } else { 0.0 };
        }
        // A slack with one bound cannot follow a wrong sign.
        for slack in columns..self.reduced.len() {
            let wrong = (self.lower[slack] == f64::NEG_INFINITY && self.reduced[slack] > 0.0)
                || (self.upper[slack] == f64::INFINITY && self.reduced[slack] < 0.0);
            if wrong {
                self.reduced[slack] = 0.0;
            }
        }
        self.rho = y;
    }

    pub(super) fn compute_values(&mut self) {
        let columns = self.matrix.columns();
        let mut v = std::mem::take(&mut self.column);
        v.fill(0.0);
        for column in 0..columns {
            let value = self.value[column];
            if self.place[column] == NONE && value != 0.0 {
                self.matrix.column(column).iter().for_each(|&(r, a)| v[r] -= a * value);
            }
        }
        for (row, sum) in v.iter_mut().enumerate() {
            if self.place[columns + row] == NONE {
                *sum += self.value[columns + row];
            }
        }
        self.factor.forward(&mut v);
        for (row, &variable) in self.basic.iter().enumerate() {
            self.value[variable] = v[row];
        }
        self.column = v;
    }
}
