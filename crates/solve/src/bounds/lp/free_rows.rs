//! The rows of a matrix without the columns that are fixed at zero.
//!
//! Deep in a search most columns are fixed, and no step of the simplex method needs them. Each row
//! keeps the entries of free columns first, so changing a bound moves only as many entries as the
//! column has.

use super::matrix::Matrix;
use crate::index::{Blocks, ColumnId, EntryId, Id, IdVec, Ids, PlaceId, RowId, Rows};

/// The entries of all rows, and which of them belong to free columns.
#[derive(Clone, Debug, Default)]
pub(crate) struct FreeRows {
    entries: IdVec<PlaceId, Entry>,
    /// The start of each row, and the end of its free columns.
    start: IdVec<RowId, PlaceId>,
    end: IdVec<RowId, PlaceId>,
    /// The place of each entry of a column.
    place: IdVec<EntryId, PlaceId>,
    of_column: Blocks<ColumnId, EntryId>,
    is_free: IdVec<ColumnId, bool>,
}

/// An entry of a row.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Entry {
    pub(crate) column: ColumnId,
    pub(crate) value: f64,
    id: EntryId,
}

impl FreeRows {
    /// Starts with all columns free.
    pub(crate) fn new(matrix: &Matrix) -> Self {
        let (mut of_column, mut pairs) = (Blocks::default(), Vec::new());
        for column in matrix.columns() {
            for &(row, value) in matrix.column(column) {
                pairs.push((row, Entry { column, value, id: EntryId::new(pairs.len()) }));
            }
            of_column.close(pairs.len());
        }
        let rows: Rows<RowId, Entry> = Rows::collect(matrix.rows().len(), &pairs);
        let entries: IdVec<PlaceId, Entry> = rows.items().to_vec().into();
        let mut place = IdVec::same(PlaceId::new(0), entries.len());
        entries.enumerate().for_each(|(at, entry)| place[entry.id] = at);
        let mut total = 0;
        let mut end: IdVec<RowId, PlaceId> = IdVec::default();
        let mut start = end.clone();
        for row in rows.ids() {
            start.push(PlaceId::new(total));
            total += rows[row].len();
            end.push(PlaceId::new(total));
        }
        let is_free = IdVec::same(true, matrix.columns().len());
        Self { entries, start, end, place, of_column, is_free }
    }

    pub(crate) fn is_free(&self, column: ColumnId) -> bool {
        self.is_free[column]
    }

    /// The entries of a row whose columns are free.
    #[inline]
    pub(crate) fn row(&self, row: RowId) -> &[Entry] {
        self.entries.of(Ids::from_to(self.start[row], self.end[row]))
    }

    /// Frees the column, or fixes it at zero.
    pub(crate) fn change(&mut self, matrix: &Matrix, column: ColumnId) {
        let is_free = !self.is_free[column];
        self.is_free[column] = is_free;
        for (entry, &(row, _)) in self.of_column.of(column).iter().zip(matrix.column(column)) {
            let end = self.end[row].index();
            let (to, end) = if is_free { (end, end + 1) } else { (end - 1, end - 1) };
            self.end[row] = PlaceId::new(end);
            self.swap(self.place[entry], PlaceId::new(to));
        }
    }

    fn swap(&mut self, one: PlaceId, other: PlaceId) {
        let (first, second) = (self.entries[one], self.entries[other]);
        self.entries[one] = second;
        self.entries[other] = first;
        self.place[first.id] = other;
        self.place[second.id] = one;
    }
}

#[cfg(feature = "inside")]
#[expect(missing_docs, reason = "the name of a test says what it holds")]
pub(crate) mod tests {
    use super::*;

    pub fn rows_have_the_free_columns_whatever_changed_before() {
        let mut matrix = Matrix::default();
        let row = RowId::new;
        for column in 0..9_usize {
            matrix.add(&[(row(column % 3), 1.0), (row(3 + column % 2), 2.0)]);
        }
        matrix.finish(5);
        let mut rows = FreeRows::new(&matrix);
        for step in 0..200_usize {
            rows.change(&matrix, ColumnId::new(step * step % 9));
            for row in matrix.rows() {
                let free = |e: &&(ColumnId, f64)| rows.is_free(e.0);
                let wanted: Vec<ColumnId> =
                    matrix.row(row).iter().filter(free).map(|e| e.0).collect();
                let mut here: Vec<ColumnId> = rows.row(row).iter().map(|e| e.column).collect();
                here.sort_unstable();
                assert_eq!(here, wanted);
            }
        }
    }
}
