//! The basis as factors: columns in, triangular solves out.
//!
//! A left-looking sparse LU decomposition (J. R. Gilbert and T. Peierls, *Sparse partial pivoting
//! in time proportional to arithmetic operations*, 1988, but without their symbolic step). It takes
//! slack columns and singletons first, which leaves little to eliminate in these problems. Later
//! exchanges of one variable go into an eta file (G. B. Dantzig and W. Orchard-Hays, *The product
//! form for the inverse in the simplex method*, 1954).

use super::matrix::{Matrix, Variable};
use crate::index::{ColumnId, IdVec, RowId, Rows, StepId, VarId};

/// Smaller pivots are rejected.
const TINY: f64 = 1e-9;

/// Smaller entries of a factor are dropped.
const DROPPED: f64 = 1e-13;

/// A vector with an entry for each row.
pub(crate) type Dense = IdVec<RowId, f64>;

/// The variable that has its pivot in each row, as far as the elimination has got.
type Pivots = IdVec<RowId, Option<VarId>>;

/// The factors of one basis.
#[derive(Clone, Debug, Default)]
pub(crate) struct Factor {
    /// Pivot rows in the order of elimination.
    order: IdVec<StepId, RowId>,
    diagonal: IdVec<RowId, f64>,
    /// Columns of L without their pivot rows.
    lower: Rows<StepId, (RowId, f64)>,
    lower_row: IdVec<StepId, RowId>,
    /// Columns of U in the order of elimination, and the rows of U by row.
    upper: Rows<StepId, (RowId, f64)>,
    upper_rows: Rows<RowId, (RowId, f64)>,
    /// Exchanges: pivot row, pivot, column.
    etas: Rows<StepId, (RowId, f64)>,
    eta_row: IdVec<StepId, (RowId, f64)>,
    // Work space of the decomposition.
    pivoted: IdVec<RowId, bool>,
    row_count: IdVec<RowId, usize>,
    column_count: IdVec<ColumnId, usize>,
    waiting: IdVec<ColumnId, bool>,
    work: IdVec<RowId, f64>,
}

impl Factor {
    /// Decomposes the basis. `basic` holds its variables and comes back ordered by pivot row;
    /// linearly dependent variables are replaced by slacks.
    pub(crate) fn decompose(&mut self, matrix: &Matrix, basic: &mut IdVec<RowId, VarId>) {
        self.begin(matrix);
        let mut pivots: Pivots = IdVec::same(None, basic.len());
        let mut columns = Vec::with_capacity(basic.len());
        for &variable in &*basic {
            match matrix.variable(variable) {
                Variable::Slack(row) => {
                    self.pivoted[row] = true;
                    pivots[row] = Some(variable);
                    self.push_pivot(row, -1.0);
                }
                Variable::Column(column) => columns.push(column),
            }
        }
        for &column in &columns {
            self.waiting[column] = true;
            for &(row, _) in matrix.column(column) {
                if !self.pivoted[row] {
                    self.column_count[column] += 1;
                    self.row_count[row] += 1;
                }
            }
        }
        self.singletons(matrix, &columns, &mut pivots);
        self.nucleus(matrix, &columns, &mut pivots);
        for row in pivots.ids() {
            basic[row] = pivots[row].unwrap_or_else(|| {
                self.push_pivot(row, -1.0);
                matrix.slack(row)
            });
        }
        self.transpose(matrix.rows().len());
    }

    fn begin(&mut self, matrix: &Matrix) {
        let (rows, columns) = (matrix.rows().len(), matrix.columns().len());
        self.order.clear();
        self.diagonal.reset(0.0, rows);
        self.lower.clear();
        self.lower_row.clear();
        self.upper.clear();
        self.etas.clear();
        self.eta_row.clear();
        self.pivoted.reset(false, rows);
        self.row_count.reset(0, rows);
        self.column_count.reset(0, columns);
        self.waiting.reset(false, columns);
        self.work.reset(0.0, rows);
    }

    fn push_pivot(&mut self, row: RowId, pivot: f64) {
        self.order.push(row);
        self.diagonal[row] = pivot;
        self.upper.close();
    }

    /// Pivots on columns with one row left, and on rows with one column left, as long as there are
    /// any.
    fn singletons(&mut self, matrix: &Matrix, columns: &[ColumnId], pivots: &mut Pivots) {
        let single = |f: &Self, c: &ColumnId| f.column_count[*c] == 1;
        let mut ready: Vec<ColumnId> =
            columns.iter().copied().filter(|c| single(self, c)).collect();
        let rows = |f: &Self, r: &RowId| !f.pivoted[*r] && f.row_count[*r] == 1;
        let mut alone: Vec<RowId> = matrix.rows().iter().filter(|r| rows(self, r)).collect();
        loop {
            if let Some(column) = ready.pop() {
                if !self.waiting[column] || self.column_count[column] != 1 {
                    continue;
                }
                let here = matrix.column(column).iter().find(|e| !self.pivoted[e.0]);
                let Some(&(row, pivot)) = here else { continue };
                if pivot.abs() < TINY {
                    continue;
                }
                self.settle(matrix, column, row, pivot, pivots, &mut ready, &mut alone);
            } else if let Some(row) = alone.pop() {
                if self.pivoted[row] || self.row_count[row] != 1 {
                    continue;
                }
                let here = matrix.row(row).iter().find(|e| self.waiting[e.0]);
                let Some(&(column, pivot)) = here else { continue };
                let entries = matrix.column(column).iter().filter(|e| !self.pivoted[e.0]);
                if entries.fold(0.0_f64, |a, e| a.max(e.1.abs())) * 0.01 > pivot.abs() {
                    continue;
                }
                self.settle(matrix, column, row, pivot, pivots, &mut ready, &mut alone);
            } else {
                return;
            }
        }
    }

    /// Pivots on an entry of a column that no elimination has touched.
    #[expect(clippy::too_many_arguments, reason = "the parts of one elimination step")]
    fn settle(
        &mut self,
        matrix: &Matrix,
        column: ColumnId,
        row: RowId,
        pivot: f64,
        pivots: &mut Pivots,
        ready: &mut Vec<ColumnId>,
        alone: &mut Vec<RowId>,
    ) {
        self.waiting[column] = false;
        let mut below = false;
        for &(r, value) in matrix.column(column) {
            if self.pivoted[r] {
                self.upper.add((r, value));
            } else {
                self.row_count[r] -= 1;
                if self.row_count[r] == 1 {
                    alone.push(r);
                }
                if r != row {
                    self.lower.add((r, value / pivot));
                    below = true;
                }
            }
        }
        if below {
            self.lower.close();
            self.lower_row.push(row);
        }
        self.pivoted[row] = true;
        pivots[row] = Some(Matrix::of_column(column));
        self.push_pivot(row, pivot);
        for &(c, _) in matrix.row(row) {
            if self.waiting[c] {
                self.column_count[c] -= 1;
                if self.column_count[c] == 1 {
                    ready.push(c);
                }
            }
        }
    }

    /// Eliminates what is left, short columns first.
    fn nucleus(&mut self, matrix: &Matrix, columns: &[ColumnId], pivots: &mut Pivots) {
        let mut left: Vec<ColumnId> =
            columns.iter().copied().filter(|c| self.waiting[*c]).collect();
        left.sort_by_key(|&c| (self.column_count[c], c));
        let mut work = std::mem::take(&mut self.work);
        let mut touched = Vec::new();
        for column in left {
            for &(row, value) in matrix.column(column) {
                work[row] = value;
                touched.push(row);
            }
            for (index, &row) in self.lower_row.enumerate() {
                let factor = work[row];
                if factor != 0.0 {
                    for &(r, l) in &self.lower[index] {
                        if work[r] == 0.0 {
                            touched.push(r);
                        }
                        work[r] -= l * factor;
                    }
                }
            }
            touched.sort_unstable();
            touched.dedup();
            let open = touched.iter().copied().filter(|&r| !self.pivoted[r]);
            let largest = open.clone().map(|r| work[r].abs()).fold(0.0, f64::max);
            let good = open.filter(|&r| work[r].abs() >= 0.1 * largest && largest > TINY);
            if let Some(row) = good.min_by_key(|&r| (self.row_count[r], r)) {
                let pivot = work[row];
                let mut below = false;
                for &r in touched.iter().filter(|&&r| r != row) {
                    let value = work[r];
                    if value.abs() < DROPPED {
                        continue;
                    }
                    if self.pivoted[r] {
                        self.upper.add((r, value));
                    } else {
                        self.lower.add((r, value / pivot));
                        below = true;
                    }
                }
                if below {
                    self.lower.close();
                    self.lower_row.push(row);
                }
                self.pivoted[row] = true;
                pivots[row] = Some(Matrix::of_column(column));
                self.push_pivot(row, pivot);
            }
            touched.drain(..).for_each(|r| work[r] = 0.0);
        }
        self.work = work;
    }

    fn transpose(&mut self, rows: usize) {
        let mut entries = Vec::with_capacity(self.upper.items().len());
        for (step, &pivot_row) in self.order.enumerate() {
            entries.extend(self.upper[step].iter().map(|&(row, a)| (row, (pivot_row, a))));
        }
        self.upper_rows = Rows::collect(rows, &entries);
    }

    /// Number of exchanges since the decomposition.
    pub(crate) fn updates(&self) -> usize {
        self.eta_row.len()
    }

    /// Whether the eta file has grown out of proportion.
    pub(crate) fn worn(&self) -> bool {
        self.etas.items().len() > 3 * (self.upper.items().len() + self.lower.items().len()) + 2000
    }

    /// Replaces the variable in `row` by one whose column in terms of the basis is `column`.
    pub(crate) fn exchange(&mut self, row: RowId, column: &Dense, nonzeros: &[RowId]) {
        for &r in nonzeros {
            if r != row && column[r].abs() > DROPPED {
                self.etas.add((r, column[r]));
            }
        }
        self.etas.close();
        self.eta_row.push((row, column[row]));
    }

    /// Solves B x = v in place; x is by pivot row.
    pub(crate) fn forward(&self, v: &mut Dense) {
        for (index, &row) in self.lower_row.enumerate() {
            let factor = v[row];
            if factor != 0.0 {
                for &(r, l) in &self.lower[index] {
                    v[r] -= l * factor;
                }
            }
        }
        for (index, &row) in self.order.enumerate().rev() {
            if v[row] != 0.0 {
                let x = v[row] / self.diagonal[row];
                v[row] = x;
                for &(r, u) in &self.upper[index] {
                    v[r] -= u * x;
                }
            }
        }
        for (index, &(row, pivot)) in self.eta_row.enumerate() {
            if v[row] != 0.0 {
                let x = v[row] / pivot;
                v[row] = x;
                for &(r, a) in &self.etas[index] {
                    v[r] -= a * x;
                }
            }
        }
    }

    /// Solves B' y = v in place; v is by pivot row.
    pub(crate) fn backward(&self, v: &mut Dense) {
        for (index, &(row, pivot)) in self.eta_row.enumerate().rev() {
            let sum: f64 = self.etas[index].iter().map(|&(r, a)| a * v[r]).sum();
            v[row] = (v[row] - sum) / pivot;
        }
        for &row in &self.order {
            if v[row] != 0.0 {
                let y = v[row] / self.diagonal[row];
                v[row] = y;
                for &(r, u) in &self.upper_rows[row] {
                    v[r] -= u * y;
                }
            }
        }
        for index in self.lower_row.ids().iter().rev() {
            let sum: f64 = self.lower[index].iter().map(|&(r, l)| l * v[r]).sum();
            if sum != 0.0 {
                v[self.lower_row[index]] -= sum;
            }
        }
    }
}
