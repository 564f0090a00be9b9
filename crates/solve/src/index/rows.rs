//! Lists of different lengths in one vector, by typed index: the building blocks of a flat model.
#![expect(clippy::indexing_slicing, reason = "ids are checked once, by `model::validate`")]

use super::{Id, Ids};
use std::marker::PhantomData;
use std::ops::{Index, Range};

/// Maps each id of one type to consecutive ids of another, such as a device to its alternatives.
#[derive(Clone, Debug)]
pub(crate) struct Blocks<I, J> {
    start: Vec<u32>,
    ids: PhantomData<(I, J)>,
}

impl<I, J> Default for Blocks<I, J> {
    fn default() -> Self {
        Self { start: vec![0], ids: PhantomData }
    }
}

impl<I: Id, J: Id> Blocks<I, J> {
    /// Gives the next owner all ids before `end` that have no owner yet.
    pub(crate) fn close(&mut self, end: usize) {
        self.start.push(end as u32);
    }

    pub(crate) fn of(&self, owner: I) -> Ids<J> {
        let owner = owner.index();
        Ids { start: self.start[owner], end: self.start[owner + 1], id: PhantomData }
    }

    /// All ids that belong to consecutive owners.
    pub(crate) fn of_all(&self, owners: Ids<I>) -> Ids<J> {
        let start = self.start[owners.start as usize];
        Ids { start, end: self.start[owners.end as usize], id: PhantomData }
    }

    /// Number of ids that have an owner.
    pub(crate) fn total(&self) -> usize {
        self.start.last().map_or(0, |end| *end as usize)
    }

    /// Whether both ranges have the same number of owners, with the same number of ids each.
    pub(crate) fn same_sizes(&self, one: Ids<I>, other: Ids<I>) -> bool {
        same_sizes(&self.start, one.indices(), other.indices())
    }
}

/// A list for each id, all of them in one vector.
#[derive(Clone, Debug)]
pub(crate) struct Rows<I, T> {
    start: Vec<u32>,
    items: Vec<T>,
    id: PhantomData<I>,
}

impl<I, T> Default for Rows<I, T> {
    fn default() -> Self {
        Self { start: vec![0], items: Vec::new(), id: PhantomData }
    }
}

impl<I: Id, T> Rows<I, T> {
    /// Adds an item to the list that is being filled.
    pub(crate) fn add(&mut self, item: T) {
        self.items.push(item);
    }

    pub(crate) fn extend(&mut self, items: impl IntoIterator<Item = T>) {
        self.items.extend(items);
    }

    /// Ends the list that is being filled and begins the next one.
    pub(crate) fn close(&mut self) {
        self.start.push(self.items.len() as u32);
    }

    /// Adds a whole list.
    pub(crate) fn push(&mut self, items: impl IntoIterator<Item = T>) -> I {
        self.extend(items);
        self.close();
        I::new(self.len() - 1)
    }

    /// The list that is being filled.
    pub(crate) fn open(&mut self) -> &mut [T] {
        let start = self.start.last().map_or(0, |end| *end as usize);
        &mut self.items[start..]
    }

    /// Removes all lists.
    pub(crate) fn clear(&mut self) {
        self.start.truncate(1);
        self.items.clear();
    }

    pub(crate) fn len(&self) -> usize {
        self.start.len() - 1
    }

    pub(crate) fn ids(&self) -> Ids<I> {
        Ids::first(self.len())
    }

    /// The items of all lists.
    pub(crate) fn items(&self) -> &[T] {
        &self.items
    }

    /// Whether both ranges have the same number of lists, with the same lengths.
    fn same_sizes(&self, one: Ids<I>, other: Ids<I>) -> bool {
        same_sizes(&self.start, one.indices(), other.indices())
    }

    fn span(&self, rows: Ids<I>) -> &[T] {
        let Range { start, end } = rows.indices();
        &self.items[self.start[start] as usize..self.start[end] as usize]
    }
}

impl<I: Id, T: PartialEq> Rows<I, T> {
    /// Whether the lists in both ranges are equal.
    pub(crate) fn equal(&self, one: Ids<I>, other: Ids<I>) -> bool {
        self.same_sizes(one, other) && self.span(one) == self.span(other)
    }
}

impl<I: Id, T: Copy> Rows<I, T> {
    /// Groups pairs of id and item into lists, keeping the order within each list.
    pub(crate) fn collect(rows: usize, pairs: &[(I, T)]) -> Self {
        let Some(&(_, any)) = pairs.first() else {
            return Self { start: vec![0; rows + 1], ..Self::default() };
        };
        let mut start = vec![0_u32; rows + 1];
        for (row, _) in pairs {
            start[row.index() + 1] += 1;
        }
        for row in 0..rows {
            start[row + 1] += start[row];
        }
        let mut next = start.clone();
        let mut items = vec![any; pairs.len()];
        for &(row, item) in pairs {
            items[next[row.index()] as usize] = item;
            next[row.index()] += 1;
        }
        Self { start, items, id: PhantomData }
    }
}

impl<I: Id, T> Index<I> for Rows<I, T> {
    type Output = [T];

    #[inline]
    fn index(&self, row: I) -> &[T] {
        let row = row.index();
        &self.items[self.start[row] as usize..self.start[row + 1] as usize]
    }
}

fn same_sizes(start: &[u32], one: Range<usize>, other: Range<usize>) -> bool {
    let ends = |rows: &Range<usize>| {
        let first = start[rows.start];
        start[rows.start..=rows.end].iter().map(move |end| end - first)
    };
    one.len() == other.len() && ends(&one).eq(ends(&other))
}
