//! A basis that is kept: where several short runs start, each from the same place.

use super::{Factor, Simplex};
use crate::bounds::lp::matrix::Matrix;
use crate::index::{ColumnId, IdVec, RowId, VarId};

/// A basis and all that is computed from it, but the bounds.
#[derive(Clone, Debug)]
pub(super) struct Kept {
    basic: IdVec<RowId, VarId>,
    place: IdVec<VarId, Option<RowId>>,
    value: IdVec<VarId, f64>,
    reduced: IdVec<VarId, f64>,
    edge: IdVec<VarId, f64>,
    factor: Factor,
    ready: bool,
    /// Columns whose reduced costs were up to date.
    is_free: IdVec<ColumnId, bool>,
}

impl Simplex {
    /// Keeps the basis.
    pub(crate) fn remember(&mut self) {
        let is_free = self.matrix.columns().iter().map(|c| self.free.is_free(c)).collect();
        self.kept = Some(Box::new(Kept {
            basic: self.basic.clone(),
            place: self.place.clone(),
            value: self.value.clone(),
            reduced: self.reduced.clone(),
            edge: self.edge.clone(),
            factor: self.factor.clone(),
            ready: self.ready,
            is_free,
        }));
    }

    /// Takes the basis that was kept, if there is one.
    pub(crate) fn go_back(&mut self) {
        let Some(kept) = self.kept.take() else { return };
        self.basic.copy_from(&kept.basic);
        self.place.copy_from(&kept.place);
        self.value.copy_from(&kept.value);
        self.reduced.copy_from(&kept.reduced);
        self.edge.copy_from(&kept.edge);
        self.factor.clone_from(&kept.factor);
        self.ready = kept.ready;
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
        if self.place[variable].is_none() {
            let price = |row| self.reduced[self.matrix.slack(row)];
            let sum: f64 = self.matrix.column(column).iter().map(|&(r, a)| a * price(r)).sum();
            self.reduced[variable] = self.cost[column] - sum;
        }
    }
}
