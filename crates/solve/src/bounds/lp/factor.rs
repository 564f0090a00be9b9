//! The basis as factors: columns in, triangular solves out.
//!
//! A left-looking sparse LU decomposition that takes slack columns and singletons first, which
//! leaves little to eliminate in these problems, and an eta file for the exchanges since then.
#![expect(clippy::indexing_slicing, reason = "rows and columns are those of the matrix")]

use super::matrix::Matrix;

/// No row, no column.
pub(crate) const NONE: usize = usize::MAX;

/// Smaller pivots count as none.
const TINY: f64 = 1e-9;

/// Sparse vectors, one after another.
#[derive(Clone, Debug, Default)]
struct Vectors {
    start: Vec<usize>,
    items: Vec<(usize, f64)>,
}

impl Vectors {
    fn clear(&mut self) {
        self.start.clear();
        self.start.push(0);
        self.items.clear();
    }

    fn close(&mut self) {
        self.start.push(self.items.len());
    }

    fn at(&self, index: usize) -> &[(usize, f64)] {
        &self.items[self.start[index]..self.start[index + 1]]
    }

    fn len(&self) -> usize {
        self.start.len() - 1
    }
}

/// The factors of one basis.
#[derive(Clone, Debug, Default)]
pub(crate) struct Factor {
    /// Pivot rows in the order of elimination.
    order: Vec<usize>,
    diagonal: Vec<f64>,
    /// Columns of L beside their pivot row.
    lower: Vectors,
    lower_row: Vec<usize>,
    /// Columns of U in the order of elimination, and its rows by row.
    upper: Vectors,
    upper_rows: Vectors,
    /// Exchanges: pivot row, pivot, column.
    etas: Vectors,
    eta_row: Vec<(usize, f64)>,
    // Work space of the decomposition.
    pivoted: Vec<bool>,
    row_count: Vec<usize>,
    column_count: Vec<usize>,
    waiting: Vec<bool>,
    work: Vec<f64>,
}

impl Factor {
    /// Decomposes the basis. `basic` holds its variables (slacks are numbered after the columns)
    /// and comes back ordered by pivot row; what is linearly dependent is replaced by slacks.
    pub(crate) fn decompose(&mut self, matrix: &Matrix, basic: &mut [usize]) {
        let rows = matrix.rows();
        self.begin(rows, matrix.columns());
        let variables: Vec<usize> = basic.to_vec();
        basic.fill(NONE);
        let mut columns = Vec::with_capacity(rows);
        for &variable in &variables {
            if variable >= matrix.columns() {
                let row = variable - matrix.columns();
                self.pivoted[row] = true;
                basic[row] = variable;
                self.push_pivot(row, -1.0);
            } else {
                columns.push(variable);
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
        self.singletons(matrix, &columns, basic);
        self.nucleus(matrix, &columns, basic);
        for (row, variable) in basic.iter_mut().enumerate().filter(|(_, v)| **v == NONE) {
            *variable = matrix.columns() + row;
            self.push_pivot(row, -1.0);
        }
        self.transpose(rows);
    }

    fn begin(&mut self, rows: usize, columns: usize) {
        self.order.clear();
        self.diagonal.clear();
        self.diagonal.resize(rows, 0.0);
        self.lower.clear();
        self.lower_row.clear();
        self.upper.clear();
        self.etas.clear();
        self.eta_row.clear();
        self.pivoted.clear();
        self.pivoted.resize(rows, false);
        self.row_count.clear();
        self.row_count.resize(rows, 0);
        self.column_count.clear();
        self.column_count.resize(columns, 0);
        self.waiting.clear();
        self.waiting.resize(columns, false);
        self.work.clear();
        self.work.resize(rows, 0.0);
    }

    fn push_pivot(&mut self, row: usize, pivot: f64) {
        self.order.push(row);
        self.diagonal[row] = pivot;
        self.upper.close();
    }

    /// Takes columns with one row left, and rows with one column left, as long as there are any.
    fn singletons(&mut self, matrix: &Matrix, columns: &[usize], basic: &mut [usize]) {
        let single = |f: &Self, c: &usize| f.column_count[*c] == 1;
        let mut ready: Vec<usize> = columns.iter().copied().filter(|c| single(self, c)).collect();
        let rows = |f: &Self, r: &usize| !f.pivoted[*r] && f.row_count[*r] == 1;
        let mut alone: Vec<usize> = (0..matrix.rows()).filter(|r| rows(self, r)).collect();
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
                self.settle(matrix, column, row, pivot, basic, &mut ready, &mut alone);
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
                self.settle(matrix, column, row, pivot, basic, &mut ready, &mut alone);
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
        column: usize,
        row: usize,
        pivot: f64,
        basic: &mut [usize],
        ready: &mut Vec<usize>,
        alone: &mut Vec<usize>,
    ) {
        self.waiting[column] = false;
        let mut below = false;
        for &(r, value) in matrix.column(column) {
            if self.pivoted[r] {
                self.upper.items.push((r, value));
            } else {
                self.row_count[r] -= 1;
                if self.row_count[r] == 1 {
                    alone.push(r);
                }
                if r != row {
                    self.lower.items.push((r, value / pivot));
                    below = true;
                }
            }
        }
        if below {
            self.lower.close();
            self.lower_row.push(row);
        }
        self.pivoted[row] = true;
        basic[row] = column;
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
    fn nucleus(&mut self, matrix: &Matrix, columns: &[usize], basic: &mut [usize]) {
        let mut left: Vec<usize> = columns.iter().copied().filter(|c| self.waiting[*c]).collect();
        left.sort_by_key(|&c| (self.column_count[c], c));
        let mut work = std::mem::take(&mut self.work);
        let mut touched = Vec::new();
        for column in left {
            for &(row, value) in matrix.column(column) {
                work[row] = value;
                touched.push(row);
            }
            for (index, &row) in self.lower_row.iter().enumerate() {
                let factor = work[row];
                if factor != 0.0 {
                    for &(r, l) in self.lower.at(index) {
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
                    if value.abs() < 1e-13 {
                        continue;
                    }
                    if self.pivoted[r] {
                        self.upper.items.push((r, value));
                    } else {
                        self.lower.items.push((r, value / pivot));
                        below = true;
                    }
                }
                if below {
                    self.lower.close();
                    self.lower_row.push(row);
                }
                self.pivoted[row] = true;
                basic[row] = column;
                self.push_pivot(row, pivot);
            }
            touched.drain(..).for_each(|r| work[r] = 0.0);
        }
        self.work = work;
    }

    fn transpose(&mut self, rows: usize) {
        let mut count = vec![0; rows + 1];
        for &(row, _) in &self.upper.items {
            count[row + 1] += 1;
        }
        for row in 0..rows {
            count[row + 1] += count[row];
        }
        let mut next = count.clone();
        self.upper_rows.start = count;
        self.upper_rows.items.clear();
        self.upper_rows.items.resize(self.upper.items.len(), (0, 0.0));
        for (index, &pivot_row) in self.order.iter().enumerate() {
            for &(row, value) in self.upper.at(index) {
                self.upper_rows.items[next[row]] = (pivot_row, value);
                next[row] += 1;
            }
        }
    }

    /// Exchanges since the decomposition.
    pub(crate) fn updates(&self) -> usize {
        self.eta_row.len()
    }

    /// Whether the eta file has grown out of proportion.
    pub(crate) fn worn(&self) -> bool {
        self.etas.items.len() > 3 * (self.upper.items.len() + self.lower.items.len()) + 2000
    }

    /// The variable in `row` gives way to one whose column in terms of the basis is `column`.
    pub(crate) fn exchange(&mut self, row: usize, column: &[f64], nonzeros: &[usize]) {
        for &r in nonzeros {
            if r != row && column[r].abs() > 1e-13 {
                self.etas.items.push((r, column[r]));
            }
        }
        self.etas.close();
        self.eta_row.push((row, column[row]));
    }

    /// Solves B x = v in place; x is by pivot row.
    pub(crate) fn forward(&self, v: &mut [f64]) {
        for (index, &row) in self.lower_row.iter().enumerate() {
            let factor = v[row];
            if factor != 0.0 {
                for &(r, l) in self.lower.at(index) {
                    v[r] -= l * factor;
                }
            }
        }
        for (index, &row) in self.order.iter().enumerate().rev() {
            if v[row] != 0.0 {
                let x = v[row] / self.diagonal[row];
                v[row] = x;
                for &(r, u) in self.upper.at(index) {
                    v[r] -= u * x;
                }
            }
        }
        for (index, &(row, pivot)) in self.eta_row.iter().enumerate() {
            if v[row] != 0.0 {
                let x = v[row] / pivot;
                v[row] = x;
                for &(r, a) in self.etas.at(index) {
                    v[r] -= a * x;
                }
            }
        }
    }

    /// Solves B' y = v in place; v is by pivot row.
    pub(crate) fn backward(&self, v: &mut [f64]) {
        for (index, &(row, pivot)) in self.eta_row.iter().enumerate().rev() {
            let sum: f64 = self.etas.at(index).iter().map(|&(r, a)| a * v[r]).sum();
            v[row] = (v[row] - sum) / pivot;
        }
        for &row in &self.order {
            if v[row] != 0.0 {
                let y = v[row] / self.diagonal[row];
                v[row] = y;
                for &(r, u) in self.upper_rows.at(row) {
                    v[r] -= u * y;
                }
            }
        }
        for index in (0..self.lower.len()).rev() {
            let sum: f64 = self.lower.at(index).iter().map(|&(r, l)| l * v[r]).sum();
            if sum != 0.0 {
                v[self.lower_row[index]] -= sum;
            }
        }
    }
}
