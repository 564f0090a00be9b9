//! A sparse matrix, by columns and by rows.
#![expect(clippy::indexing_slicing, reason = "positions are those of the matrix")]

/// The matrix. Columns are added one by one; `finish` makes the rows.
#[derive(Clone, Debug)]
pub(crate) struct Matrix {
    rows: usize,
    column_start: Vec<usize>,
    by_column: Vec<(usize, f64)>,
    row_start: Vec<usize>,
    by_row: Vec<(usize, f64)>,
}

impl Default for Matrix {
    fn default() -> Self {
        Self {
            rows: 0,
            column_start: vec![0],
            by_column: Vec::new(),
            row_start: vec![0],
            by_row: Vec::new(),
        }
    }
}

impl Matrix {
    pub(crate) fn rows(&self) -> usize {
        self.rows
    }

    pub(crate) fn columns(&self) -> usize {
        self.column_start.len() - 1
    }

    /// Adds a column; entries of one row are added up. Returns its number.
    pub(crate) fn add(&mut self, entries: &[(usize, f64)]) -> usize {
        let start = self.by_column.len();
        for &(row, value) in entries {
            match self.by_column[start..].iter_mut().find(|e| e.0 == row) {
                Some(entry) => entry.1 += value,
                None => self.by_column.push((row, value)),
            }
        }
        self.column_start.push(self.by_column.len());
        self.columns() - 1
    }

    /// Makes the rows, of which there are so many.
    pub(crate) fn finish(&mut self, rows: usize) {
        self.rows = rows;
        let mut start = vec![0; rows + 1];
        for &(row, _) in &self.by_column {
            start[row + 1] += 1;
        }
        for row in 0..rows {
            start[row + 1] += start[row];
        }
        let mut next = start.clone();
        self.row_start = start;
        self.by_row = vec![(0, 0.0); self.by_column.len()];
        for column in 0..self.columns() {
            for index in self.column_start[column]..self.column_start[column + 1] {
                let (row, value) = self.by_column[index];
                self.by_row[next[row]] = (column, value);
                next[row] += 1;
            }
        }
    }

    pub(crate) fn column(&self, column: usize) -> &[(usize, f64)] {
        &self.by_column[self.column_start[column]..self.column_start[column + 1]]
    }

    pub(crate) fn row(&self, row: usize) -> &[(usize, f64)] {
        &self.by_row[self.row_start[row]..self.row_start[row + 1]]
    }
}
