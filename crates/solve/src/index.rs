//! Rows of different lengths in one vector: what a flat model is made of.
#![expect(clippy::indexing_slicing, reason = "rows are numbered by whoever filled them")]

use std::ops::Range;

/// Rows of different lengths in one vector.
#[derive(Clone, Debug)]
pub(crate) struct Rows<T> {
    start: Vec<usize>,
    pub(crate) items: Vec<T>,
}

impl<T> Default for Rows<T> {
    fn default() -> Self {
        Self { start: vec![0], items: Vec::new() }
    }
}

impl<T> Rows<T> {
    /// Ends the row that `add` filled.
    pub(crate) fn close(&mut self) {
        self.start.push(self.items.len());
    }

    pub(crate) fn add(&mut self, item: T) {
        self.items.push(item);
    }

    pub(crate) fn range(&self, row: usize) -> Range<usize> {
        self.start[row]..self.start[row + 1]
    }

    pub(crate) fn at(&self, row: usize) -> &[T] {
        &self.items[self.range(row)]
    }

    pub(crate) fn len(&self) -> usize {
        self.start.len() - 1
    }

    /// The items of consecutive rows.
    pub(crate) fn span(&self, rows: &Range<usize>) -> Range<usize> {
        self.start[rows.start]..self.start[rows.end]
    }

    /// Whether as many rows in both places have the same lengths.
    pub(crate) fn alike(&self, one: &Range<usize>, other: &Range<usize>) -> bool {
        let ends = |rows: &Range<usize>| {
            let first = self.start[rows.start];
            self.start[rows.start..=rows.end].iter().map(move |end| end - first)
        };
        one.len() == other.len() && ends(one).eq(ends(other))
    }
}

impl<T: PartialEq> Rows<T> {
    /// Whether the rows in both places are the same.
    pub(crate) fn equal(&self, one: &Range<usize>, other: &Range<usize>) -> bool {
        self.alike(one, other) && self.items[self.span(one)] == self.items[self.span(other)]
    }
}

impl<T: Copy + Default> Rows<T> {
    /// Sorts pairs of row and item into rows, keeping the order within each row.
    pub(crate) fn collect(rows: usize, pairs: &[(usize, T)]) -> Self {
        let mut start = vec![0; rows + 1];
        for (row, _) in pairs {
            start[row + 1] += 1;
        }
        for row in 0..rows {
            start[row + 1] += start[row];
        }
        let mut next = start.clone();
        let mut items = vec![T::default(); pairs.len()];
        for &(row, item) in pairs {
            items[next[row]] = item;
            next[row] += 1;
        }
        Self { start, items }
    }
}
