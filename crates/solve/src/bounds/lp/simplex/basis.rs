//! Rebuilds a basis: computes the values and all reduced costs from the choice of basic variables.

use super::{Matrix, Simplex, Variable};

impl Simplex {
    /// Brings the free columns up to date with the bounds.
    pub(super) fn find_free(&mut self) {
        for column in self.matrix.columns() {
            let variable = Matrix::of_column(column);
            let is_free = self.lower[variable] != 0.0 || self.upper[variable] != 0.0;
            if is_free == self.free.is_free(column) {
                continue;
            }
            self.free.change(&self.matrix, column);
            if is_free {
                self.price_column(column);
            }
        }
    }

    /// Puts nonbasic variables on the bound that their reduced cost asks for.
    pub(super) fn place_nonbasic(&mut self) {
        for variable in self.now.value.ids() {
            if self.now.place[variable].is_none() {
                let reduced = self.now.reduced[variable];
                let (lower, upper) = (self.lower[variable], self.upper[variable]);
                let up = if lower == f64::NEG_INFINITY {
                    true
                } else if upper == f64::INFINITY {
                    false
                } else if reduced.abs() < 1e-12 {
                    self.now.value[variable] >= upper
                } else {
                    reduced < 0.0
                };
                self.now.value[variable] = if up { upper } else { lower };
            }
        }
    }

    /// Decomposes the basis and computes everything from it.
    pub(super) fn rebuild(&mut self) {
        self.now.factor.decompose(&self.matrix, &mut self.now.basic);
        for (row, &variable) in self.now.basic.enumerate() {
            if self.now.place[variable].is_none() {
                self.now.edge[variable] = 1.0;
            }
            self.now.place[variable] = Some(row);
        }
        for variable in self.now.place.ids() {
            if self.now.place[variable].is_some_and(|row| self.now.basic[row] != variable) {
                self.now.place[variable] = None;
            }
        }
        self.compute_reduced();
        self.place_nonbasic();
        self.compute_values();
        self.now.ready = true;
    }

    pub(super) fn compute_reduced(&mut self) {
        let mut y = std::mem::take(&mut self.rho);
        for (row, &variable) in self.now.basic.enumerate() {
            y[row] = match self.matrix.variable(variable) {
                Variable::Column(column) => self.cost[column],
                Variable::Slack(_) => 0.0,
            };
        }
        self.now.factor.backward(&mut y);
        for column in self.matrix.columns() {
            let variable = Matrix::of_column(column);
            if self.now.place[variable].is_some() {
                self.now.reduced[variable] = 0.0;
            } else if self.free.is_free(column) {
                let sum: f64 = self.matrix.column(column).iter().map(|&(r, a)| a * y[r]).sum();
                self.now.reduced[variable] = self.cost[column] - sum;
            }
        }
        for (slack, &price) in self.matrix.slacks().iter().zip(&y) {
            self.now.reduced[slack] = if self.now.place[slack].is_none() { price } else { 0.0 };
        }
        // A slack with only one bound cannot move to the other when its reduced cost has the wrong
        // sign.
        for slack in self.matrix.slacks() {
            let wrong = (self.lower[slack] == f64::NEG_INFINITY && self.now.reduced[slack] > 0.0)
                || (self.upper[slack] == f64::INFINITY && self.now.reduced[slack] < 0.0);
            if wrong {
                self.now.reduced[slack] = 0.0;
            }
        }
        self.rho = y;
    }

    pub(super) fn compute_values(&mut self) {
        let mut v = std::mem::take(&mut self.column);
        v.fill(0.0);
        for column in self.matrix.columns() {
            let variable = Matrix::of_column(column);
            let value = self.now.value[variable];
            if self.now.place[variable].is_none() && value != 0.0 {
                self.matrix.column(column).iter().for_each(|&(r, a)| v[r] -= a * value);
            }
        }
        for (slack, sum) in self.matrix.slacks().iter().zip(v.iter_mut()) {
            if self.now.place[slack].is_none() {
                *sum += self.now.value[slack];
            }
        }
        self.now.factor.forward(&mut v);
        for (row, &variable) in self.now.basic.enumerate() {
            self.now.value[variable] = v[row];
        }
        self.column = v;
    }
}
