//! A sparse matrix: built column by column, read by column or by row.
//!
//! Each row has a slack variable that equals the row. Variables are numbered columns first, then
//! slacks.

use crate::index::{ColumnId, Id, Ids, RowId, Rows, VarId};

/// The matrix. Columns are added one by one; `finish` makes the rows.
#[derive(Clone, Debug, Default)]
pub(crate) struct Matrix {
    by_column: Rows<ColumnId, (RowId, f64)>,
    by_row: Rows<RowId, (ColumnId, f64)>,
}

/// The kind of a variable.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Variable {
    Column(ColumnId),
    Slack(RowId),
}

impl Matrix {
    pub(crate) fn rows(&self) -> Ids<RowId> {
        self.by_row.ids()
    }

    pub(crate) fn columns(&self) -> Ids<ColumnId> {
        self.by_column.ids()
    }

    /// Adds a column; entries of one row are added up.
    pub(crate) fn add(&mut self, entries: &[(RowId, f64)]) -> ColumnId {
        for &(row, value) in entries {
            match self.by_column.open().iter_mut().find(|e| e.0 == row) {
                Some(entry) => entry.1 += value,
                None => self.by_column.add((row, value)),
            }
        }
        self.by_column.push([])
    }

    /// Makes the rows; `rows` is their number.
    pub(crate) fn finish(&mut self, rows: usize) {
        let mut entries = Vec::with_capacity(self.by_column.items().len());
        for column in self.columns() {
            entries.extend(self.by_column[column].iter().map(|&(row, a)| (row, (column, a))));
        }
        self.by_row = Rows::collect(rows, &entries);
    }

    pub(crate) fn column(&self, column: ColumnId) -> &[(RowId, f64)] {
        &self.by_column[column]
    }

    pub(crate) fn row(&self, row: RowId) -> &[(ColumnId, f64)] {
        &self.by_row[row]
    }

    /// Number of variables: one for each column and one for each row.
    pub(crate) fn variables(&self) -> usize {
        self.by_column.len() + self.by_row.len()
    }

    /// The variables that are columns.
    pub(crate) fn column_variables(&self) -> Ids<VarId> {
        Ids::first(self.by_column.len())
    }

    /// The variables that are slacks, in the order of their rows.
    pub(crate) fn slacks(&self) -> Ids<VarId> {
        Ids::from_to(VarId::new(self.by_column.len()), VarId::new(self.variables()))
    }

    pub(crate) fn of_column(column: ColumnId) -> VarId {
        VarId(column.0)
    }

    pub(crate) fn slack(&self, row: RowId) -> VarId {
        VarId::new(self.by_column.len() + row.index())
    }

    pub(crate) fn variable(&self, variable: VarId) -> Variable {
        match variable.index().checked_sub(self.by_column.len()) {
            Some(row) => Variable::Slack(RowId::new(row)),
            None => Variable::Column(ColumnId(variable.0)),
        }
    }
}
