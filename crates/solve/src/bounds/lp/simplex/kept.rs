//! A saved basis, from which several short runs start.

use super::{Basis, Simplex};
use crate::bounds::lp::matrix::Matrix;
use crate::index::{ColumnId, IdVec};

/// A basis without the bounds.
#[derive(Clone, Debug)]
pub(super) struct Kept {
    basis: Basis,
    /// Columns whose reduced costs were up to date.
    is_free: IdVec<ColumnId, bool>,
}

impl Basis {
    /// Copies the other basis and reuses the memory.
    fn copy_from(&mut self, other: &Self) {
        self.basic.copy_from(&other.basic);
        self.place.copy_from(&other.place);
        self.value.copy_from(&other.value);
        self.reduced.copy_from(&other.reduced);
        self.edge.copy_from(&other.edge);
        self.factor.clone_from(&other.factor);
        self.ready = other.ready;
    }
}

impl Simplex {
    /// Keeps the basis.
    pub(crate) fn remember(&mut self) {
        let is_free = self.matrix.columns().iter().map(|c| self.free.is_free(c)).collect();
        self.kept = Some(Box::new(Kept { basis: self.now.clone(), is_free }));
    }

    /// Restores the basis that was kept, if there is one.
    pub(crate) fn go_back(&mut self) {
        let Some(kept) = self.kept.take() else { return };
        self.now.copy_from(&kept.basis);
        for column in self.matrix.columns() {
            if self.free.is_free(column) && !kept.is_free[column] {
                self.price_column(column);
            }
        }
        self.kept = Some(kept);
    }

    /// Computes the reduced cost of a column from the prices of its rows, unless it is basic.
    pub(super) fn price_column(&mut self, column: ColumnId) {
        let variable = Matrix::of_column(column);
        if self.now.place[variable].is_none() {
            let price = |row| self.now.reduced[self.matrix.slack(row)];
            let sum: f64 = self.matrix.column(column).iter().map(|&(r, a)| a * price(r)).sum();
            self.now.reduced[variable] = self.cost[column] - sum;
        }
    }
}
